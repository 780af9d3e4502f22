/// fsi_case: what the launcher asks about case files before any solver starts.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/case/case.hpp"
#include "common/core/failure.hpp"

namespace {

using nlohmann::json;

struct Options {
  std::string name, out;
  std::vector<std::string> overrides, laws;
  std::vector<std::string> folders{"configs", fsi::configs_folder()};
  bool as_json = false;
};

fsi::Case load(const Options& options) {
  return fsi::load_case(fsi::find_case(options.name, options.folders), options.overrides, options.laws);
}

void resolve(const Options& options) {
  const fsi::Case problem = load(options);
  std::ofstream file(options.out);
  file << problem.resolved;
  file.close();
  if (!file) throw fsi::OutputFailed(options.out + ": cannot be written");
}

void add_case_options(CLI::App& command, Options& options) {
  command.add_option("case", options.name, "a path, or a name in configs/")->required();
  command.add_option("--set", options.overrides, "KEY=VALUE, in place of what the file says")
      ->allow_extra_args(false);
  command.add_option("--solid", options.laws, "NAME=LAW")->allow_extra_args(false);
  command.add_option("--configs", options.folders, "folders of cases");
}

int run(int argc, char** argv) {
  CLI::App app("fsi_case: checks and resolves case files");
  Options options;
  CLI::App* check = app.add_subcommand("check", "exit 0, or 2 with one line that says what to write");
  CLI::App* resolve_command =
      app.add_subcommand("resolve", "writes the case with parameters and overrides filled in");
  app.require_subcommand(1);
  add_case_options(*check, options);
  add_case_options(*resolve_command, options);
  resolve_command->add_option("--out", options.out, "file to write")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(fsi::ExitCode::user_mistake);
  }
  if (check->parsed()) load(options);
  if (resolve_command->parsed()) resolve(options);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const fsi::Failure& failure) {
    fmt::print(stderr, "{}\n", failure.what());
    return static_cast<int>(failure.code());
  }
}
