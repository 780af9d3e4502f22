#pragma once
/// The command line of a program, by CLI11, whose header only command_line.cpp parses.
///
///     CommandLine line("Watches a run");
///     line.add_option("RUN", run, "identity of the run");           a word in its place
///     line.add_option("--case", file, "case file").required();      --case FILE or --case=FILE
///     line.add_flag("--json", json, "print JSON");
///     if (!line.parse(argc, argv)) return 0;                        help was asked for, and printed

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace fsi {

class CommandLine {
 public:
  /// What can be said of one option.
  class Option {
   public:
    void required() const;
    /// Makes sense beside another one only.
    void needs(const Option& other) const;
    /// Makes no sense beside another one.
    void excludes(const Option& other) const;

   private:
    friend class CommandLine;
    explicit Option(CLI::Option& option) : option_(option) {}
    CLI::Option& option_;
  };

  explicit CommandLine(const std::string& about);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// An option with a value; a name without dashes is a word
  /// in its place. Without it `value` stays what it is.
  Option add_option(const std::string& name, std::string& value, const std::string& help);
  Option add_option(const std::string& name, int& value, const std::string& help);
  Option add_option(const std::string& name, double& value, const std::string& help);
  Option add_option(const std::string& name, std::optional<std::uint64_t>& value, const std::string& help);
  /// May be given many times.
  Option add_option(const std::string& name, std::vector<std::string>& values, const std::string& help);
  Option add_flag(const std::string& name, bool& flag, const std::string& help);

  /// False: --help was there and is answered. @throws UserMistake
  bool parse(int argc, const char* const* argv);
  /// The same, without the name of the program. @throws UserMistake
  bool parse(std::span<const char* const> words);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace fsi
