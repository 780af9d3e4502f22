/// fsi_case: what the launcher and a person ask about case files; no solver is started.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "common/case/case.hpp"
#include "common/case/document.hpp"
#include "common/case/memory.hpp"
#include "common/case/restart.hpp"
#include "common/case/summary.hpp"
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
  fmt::print("{}\n", options.as_json ? fsi::summary_as_json(problem) : fsi::summary_line(problem));
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

void add_case_options(CLI::App& command, Options& options) {
  command.add_option("case", options.name, "a path, or a name in configs/")->required();
  command.add_option("--set", options.overrides, "KEY=VALUE, in place of what the file says (repeatable)")
      ->allow_extra_args(false);
  command.add_option("--solid", options.laws, "NAME=LAW, the law of a solid (repeatable)")
      ->allow_extra_args(false);
  command.add_option("--configs", options.folder, "folder of the cases that have a name");
  command.add_flag("--json", options.as_json, "print what the launcher needs to know, as JSON");
}

int run(int argc, char** argv) {
  CLI::App app("fsi_case: checks, resolves and documents case files");
  Options options;
  CLI::App* check_command =
      app.add_subcommand("check", "exit 0 with one line, or 2 with one line that says what to write");
  CLI::App* resolve_command = app.add_subcommand(
      "resolve", "the case with parameters and overrides filled in, as JSON or into a file");
  CLI::App* list_command = app.add_subcommand("list", "names and titles of the cases");
  CLI::App* document_command = app.add_subcommand("document", "docs/case_file.md");
  app.require_subcommand(1);
  add_case_options(*check_command, options);
  add_case_options(*resolve_command, options);
  resolve_command->add_option("--out", options.out, "write the resolved YAML to this file");
  resolve_command->add_option(
      "--restart", options.former,
      "case of a former run: exit 2 where a restart of that run would be another one");
  list_command->add_option("--configs", options.folder, "folder of the cases");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(fsi::ExitCode::user_mistake);
  }
  if (check_command->parsed()) check(options);
  if (resolve_command->parsed()) resolve(options);
  if (list_command->parsed()) list(options);
  if (document_command->parsed()) fmt::print("{}", fsi::case_file_document());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const fsi::Failure& failure) {
    fmt::print(stderr, "{}\n", failure.what());
    return static_cast<int>(failure.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return static_cast<int>(fsi::ExitCode::expectation_missed);
  }
}
