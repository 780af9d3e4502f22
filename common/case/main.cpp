/// fsi_case: what the launcher and a person ask about case files; no solver is started.

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <span>
#include <string_view>

#include "common/case/case.hpp"
#include "common/case/document/document.hpp"
#include "common/case/read/restart.hpp"
#include "common/case/report/cost.hpp"
#include "common/case/report/memory.hpp"
#include "common/case/report/remarks.hpp"
#include "common/case/report/summary.hpp"
#include "common/case/schema/json_schema.hpp"
#include "common/core/command_line.hpp"
#include "common/core/failure.hpp"

namespace {

struct Options {
  std::string name, out;
  std::vector<std::string> overrides, laws;
  std::string folder, former;
  bool as_json = false;

  std::vector<std::string> folders() const {
    if (!folder.empty()) return {folder};
    return {"configs", fsi::configs_folder()};
  }
};

fsi::Case load(const Options& options) {
  return fsi::load_case_within(fsi::available_memory(), fsi::find_case(options.name, options.folders()),
                               options.overrides, options.laws);
}

void check(const Options& options) {
  const fsi::Case problem = load(options);
  const fsi::RunCost cost = fsi::cost_of(problem);
  fsi::refuse_endless(cost);
  if (options.as_json) {
    fmt::print("{}\n", fsi::summary_as_json(problem));
    return;
  }
  fmt::print("{}\n", fsi::summary_line(problem));
  for (const std::string& line : problem.chosen) fmt::print("  chosen: {}\n", line);
  for (const std::string& name : problem.unused)
    fmt::print("  unused: parameters.{}, which no other value of the case needs\n", name);
  for (const std::string& line : fsi::remarks_on(problem)) fmt::print("  note: {}\n", line);
  if (const std::string text = fsi::cost_text(cost); !text.empty()) fmt::print("{}\n", text);
}

void resolve(const Options& options) {
  const fsi::Case problem = load(options);
  if (!options.former.empty()) fsi::check_restart(problem.resolved, options.former);
  if (options.out.empty()) {
    fmt::print("{}\n", fsi::summary_as_json(problem));
    return;
  }
  std::ofstream file(options.out);
  file << problem.resolved;
  file.close();
  if (!file) throw fsi::OutputFailed(options.out + ": cannot be written");
  if (options.as_json) fmt::print("{}\n", fsi::summary_as_json(problem));
}

void list(const Options& options) {
  for (const auto& [name, title] :
       fsi::list_cases(options.folder.empty() ? fsi::configs_folder() : options.folder)) {
    fmt::print("{:24} {}\n", name, title);
  }
}

void add_case_options(fsi::CommandLine& line, Options& options) {
  line.add_option("CASE", options.name, "a path, or a name in configs/").required();
  line.add_option("--set", options.overrides, "KEY=VALUE, in place of what the file says (repeatable)");
  line.add_option("--solid", options.laws, "NAME=LAW, the law of a solid (repeatable)");
  line.add_option("--configs", options.folder, "folder of the cases that have a name");
  line.add_flag("--json", options.as_json, "print what the launcher needs to know, as JSON");
}

constexpr std::string_view usage = R"(fsi_case COMMAND ..: checks, resolves and documents case files

  check CASE      exit 0 with one line, or 2 with one line that says what to write
  resolve CASE    the case with parameters and overrides filled in, as JSON or into a file
  list            names and titles of the cases
  document        docs/case_file.md
  schema          JSON Schema of case files, for editors

fsi_case COMMAND --help lists the options.
)";

int run(std::string_view command, std::span<const char* const> words) {
  fsi::CommandLine line(fmt::format("fsi_case {}", command));
  Options options;
  if (command == "check") {
    add_case_options(line, options);
    if (line.parse(words)) check(options);
  } else if (command == "resolve") {
    add_case_options(line, options);
    line.add_option("--out", options.out, "write the resolved YAML to this file");
    line.add_option("--restart", options.former,
                    "case of a former run: exit 2 where a restart of that run would be another one");
    if (line.parse(words)) resolve(options);
  } else if (command == "list") {
    line.add_option("--configs", options.folder, "folder of the cases");
    if (line.parse(words)) list(options);
  } else if (command == "document") {
    if (line.parse(words)) fmt::print("{}", fsi::case_file_document());
  } else if (command == "schema") {
    if (line.parse(words)) fmt::print("{}", fsi::case_file_json_schema());
  } else if (command == "--help" || command == "-h") {
    fmt::print("{}", usage);
  } else {
    fmt::print(stderr, "{}", usage);
    return static_cast<int>(fsi::ExitCode::user_mistake);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::span<const char* const> words(argv, static_cast<std::size_t>(argc));
    return argc < 2 ? run("", {}) : run(words[1], words.subspan(2));
  } catch (const fsi::Failure& failure) {
    fmt::print(stderr, "{}\n", failure.what());
    return static_cast<int>(failure.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return static_cast<int>(fsi::ExitCode::internal_error);
  }
}
