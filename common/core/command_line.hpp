#pragma once
/// The command line of a program: options with a value, flags, and one word without a name.
///
///     CommandLine line("Watches a run");
///     line.add_option("RUN", run, "identity of the run");           a word in its place
///     line.add_option("--case", file, "case file").required();      --case FILE or --case=FILE
///     line.add_flag("--json", json, "print JSON");
///     if (!line.parse(argc, argv)) return 0;                        help was asked for, and printed

#include <deque>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fsi {

class CommandLine {
 public:
  /// What can be said of one option.
  class Option {
   public:
    void required() { required_ = true; }

   private:
    friend class CommandLine;
    std::string name_, help_;
    std::function<void(const std::string&)> take_;  ///< empty: a flag
    bool* flag_ = nullptr;
    bool required_ = false;
    bool given_ = false;
  };

  explicit CommandLine(std::string about) : about_(std::move(about)) {}

  /// An option with a value; a name without dashes is a word in its place. Given twice, the later one holds.
  Option& add_option(const std::string& name, std::string& value, const std::string& help);
  Option& add_option(const std::string& name, int& value, const std::string& help);
  Option& add_option(const std::string& name, double& value, const std::string& help);
  /// May be given many times.
  Option& add_option(const std::string& name, std::vector<std::string>& values, const std::string& help);
  Option& add_flag(const std::string& name, bool& flag, const std::string& help);

  /// False: --help was there and is answered. @throws UserMistake
  bool parse(int argc, const char* const* argv);
  /// The same, without the name of the program. @throws UserMistake
  bool parse(std::span<const char* const> words);
  std::string help() const;

 private:
  Option& add(const std::string& name, const std::string& help, std::function<void(const std::string&)> take);
  Option& named(std::string_view name);
  Option& in_place(std::string_view word);
  void expect_required() const;

  std::string about_;
  std::deque<Option> options_;  ///< references to them stay valid
};

}  // namespace fsi
