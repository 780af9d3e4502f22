#include "common/core/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "common/core/failure.hpp"

namespace fsi {

void CommandLine::Option::required() const {
  option_.required();
}

void CommandLine::Option::needs(const Option& other) const {
  option_.needs(&other.option_);
}

void CommandLine::Option::excludes(const Option& other) const {
  option_.excludes(&other.option_);
}

CommandLine::CommandLine(const std::string& about) : app_(std::make_unique<CLI::App>(about)) {}
CommandLine::~CommandLine() = default;

CommandLine::Option CommandLine::add_option(const std::string& name, std::string& value,
                                            const std::string& help) {
  return Option(*app_->add_option(name, value, help));
}

CommandLine::Option CommandLine::add_option(const std::string& name, int& value, const std::string& help) {
  return Option(*app_->add_option(name, value, help));
}

CommandLine::Option CommandLine::add_option(const std::string& name, double& value, const std::string& help) {
  return Option(*app_->add_option(name, value, help));
}

CommandLine::Option CommandLine::add_option(const std::string& name, std::optional<std::uint64_t>& value,
                                            const std::string& help) {
  return Option(*app_->add_option(name, value, help));
}

CommandLine::Option CommandLine::add_option(const std::string& name, std::vector<std::string>& values,
                                            const std::string& help) {
  return Option(*app_->add_option(name, values, help)->allow_extra_args(false));  // one value each time
}

CommandLine::Option CommandLine::add_flag(const std::string& name, bool& flag, const std::string& help) {
  return Option(*app_->add_flag(name, flag, help));
}

bool CommandLine::parse(int argc, const char* const* argv) {
  return parse(std::span(argv, static_cast<std::size_t>(argc)).subspan(argc > 0 ? 1 : 0));
}

bool CommandLine::parse(std::span<const char* const> words) {
  std::vector<std::string> last_first(words.rbegin(), words.rend());  // as CLI11 wants them
  try {
    app_->parse(last_first);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app_->help());
    return false;
  } catch (const CLI::ParseError& error) {
    throw UserMistake(fmt::format("{}; --help says what there is", error.what()));
  }
  return true;
}

}  // namespace fsi
