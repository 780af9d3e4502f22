#include "common/core/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <system_error>
#include <utility>

#include "common/core/failure.hpp"
#include "common/core/suggest.hpp"

namespace fsi {

namespace {

/// The whole text as a number. @throws UserMistake
template <class Number>
Number number_from(const std::string& option, const std::string& text, const char* kind) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || read != end || text.empty())
    throw UserMistake(fmt::format("{}: {} is no {}", option, in_ticks(text), kind));
  return value;
}

bool has_dashes(std::string_view word) {
  return word.starts_with("--");
}

}  // namespace

CommandLine::Option& CommandLine::add(const std::string& name, const std::string& help,
                                      std::function<void(const std::string&)> take) {
  Option& option = options_.emplace_back();
  option.name_ = name;
  option.help_ = help;
  option.take_ = std::move(take);
  return option;
}

CommandLine::Option& CommandLine::add_option(const std::string& name, std::string& value,
                                             const std::string& help) {
  return add(name, help, [&value](const std::string& text) { value = text; });
}

CommandLine::Option& CommandLine::add_option(const std::string& name, int& value, const std::string& help) {
  return add(name, help, [&value, name](const std::string& text) {
    value = number_from<int>(name, text, "whole number");
  });
}

CommandLine::Option& CommandLine::add_option(const std::string& name, double& value,
                                             const std::string& help) {
  return add(name, help,
             [&value, name](const std::string& text) { value = number_from<double>(name, text, "number"); });
}

CommandLine::Option& CommandLine::add_option(const std::string& name, std::vector<std::string>& values,
                                             const std::string& help) {
  return add(name, help, [&values](const std::string& text) { values.push_back(text); });
}

CommandLine::Option& CommandLine::add_flag(const std::string& name, bool& flag, const std::string& help) {
  Option& option = add(name, help, {});
  option.flag_ = &flag;
  return option;
}

CommandLine::Option& CommandLine::named(std::string_view name) {
  const auto found = std::ranges::find(options_, name, &Option::name_);
  if (found != options_.end()) return *found;
  std::vector<std::string> known;
  for (const Option& option : options_) known.push_back(option.name_);
  const std::string meant = did_you_mean(name, known);
  throw UserMistake(
      fmt::format("there is no option {}{}", in_ticks(name), meant.empty() ? "; --help lists them" : meant));
}

CommandLine::Option& CommandLine::in_place(std::string_view word) {
  const auto free = std::ranges::find_if(
      options_, [](const Option& option) { return !has_dashes(option.name_) && !option.given_; });
  if (free != options_.end()) return *free;
  throw UserMistake(fmt::format("nothing is known of {}; --help says what may stand here", in_ticks(word)));
}

void CommandLine::expect_required() const {
  for (const Option& option : options_) {
    if (option.required_ && !option.given_)
      throw UserMistake(fmt::format("{} is missing: {}", option.name_, option.help_));
  }
}

bool CommandLine::parse(int argc, const char* const* argv) {
  return parse(std::span(argv, static_cast<std::size_t>(argc)).subspan(argc > 0 ? 1 : 0));
}

bool CommandLine::parse(std::span<const char* const> words) {
  bool only_words = false;  // after a bare --
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string word = words[k];
    if (!only_words && word == "--") {
      only_words = true;
      continue;
    }
    if (!only_words && (word == "--help" || word == "-h")) {
      fmt::print("{}", help());
      return false;
    }
    const bool is_word = only_words || !has_dashes(word);
    const std::size_t equals = is_word ? std::string::npos : word.find('=');
    Option& option = is_word ? in_place(word) : named(std::string_view(word).substr(0, equals));
    option.given_ = true;
    if (option.flag_ != nullptr) {
      if (equals != std::string::npos) throw UserMistake(fmt::format("{} takes no value", option.name_));
      *option.flag_ = true;
    } else if (is_word) {
      option.take_(word);
    } else if (equals != std::string::npos) {
      option.take_(word.substr(equals + 1));
    } else if (++k < words.size()) {
      option.take_(words[k]);
    } else {
      throw UserMistake(fmt::format("{} needs a value: {}", option.name_, option.help_));
    }
  }
  expect_required();
  return true;
}

std::string CommandLine::help() const {
  std::string text = about_ + "\n\n";
  for (const Option& option : options_) {
    const std::string shape =
        option.flag_ != nullptr || !has_dashes(option.name_) ? option.name_ : option.name_ + " VALUE";
    text += fmt::format("  {:20} {}{}\n", shape, option.help_, option.required_ ? " (must be given)" : "");
  }
  return text + fmt::format("  {:20} {}\n", "--help", "print this");
}

}  // namespace fsi
