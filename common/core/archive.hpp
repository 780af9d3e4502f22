#pragma once
/// The state of a program on its way into a checkpoint or out of it: lists of numbers under names.
///
///     void Solver::archive(Archive& archive) {
///       archive.values("state", state_.values());
///       archive.number("t", t_);
///     }
///
/// One function serves both directions, so what is read is what was written. Everything is kept as doubles,
/// to the bit; whole numbers up to 2^53.

#include <concepts>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace fsi {

class Archive {
 public:
  using Entries = std::map<std::string, std::vector<double>>;

  /// For saving.
  Archive() = default;
  /// For loading what was saved.
  explicit Archive(Entries entries) : entries_(std::move(entries)), loading_(true) {}

  bool loading() const { return loading_; }

  /// Numbers whose count is known beforehand. @throws UserMistake when loading what does not fit
  void values(const std::string& name, std::span<double> values);
  /// Numbers whose count is part of the state.
  void list(const std::string& name, std::vector<double>& values);
  template <class T>
    requires std::is_arithmetic_v<T>
  void number(const std::string& name, T& value) {
    auto as_double = static_cast<double>(value);
    values(name, {&as_double, 1});
    if (loading_) value = static_cast<T>(as_double);
  }

  /// Runs `part` with all names behind "name.".
  void inside(const std::string& name, const std::invocable auto& part) {
    const std::string before = prefix_;
    prefix_ += name + ".";
    part();
    prefix_ = before;
  }

  const Entries& entries() const { return entries_; }
  /// @throws UserMistake when something saved was not asked for: it was written by another program
  void check_all_loaded() const;

 private:
  Entries entries_;
  std::string prefix_;
  bool loading_ = false;
  std::size_t loaded_ = 0;

  const std::vector<double>& take(const std::string& name);
};

}  // namespace fsi
