#pragma once
/// A number or formula of a case file, compiled once and evaluated often.

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace fsi {

/// Formula of x, y, r = |(x, y)|, s and t (for a grid mapping: r and s are its parameters), with the case's
/// parameters and helper definitions already bound. Cheap to
/// move, copies share nothing: threads take a copy each.
class Expression {
 public:
  Expression();  ///< the constant 0
  explicit Expression(double constant);
  /// `constants` are named numbers (pi is always there), `definitions` named formulas usable in `text`.
  /// @throws std::invalid_argument saying what is wrong with the text, and at which character (from 1)
  Expression(const std::string& text, const std::map<std::string, double>& constants,
             const std::map<std::string, std::string>& definitions = {});
  Expression(const Expression& other);
  Expression(Expression&&) noexcept;
  Expression& operator=(const Expression& other);
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  /// Value at (x, y) and t, with r = sqrt(x^2 + y^2).
  double operator()(double x, double y, double t) const;
  /// Value for a grid mapping: r, s in [0, 1] are the parameters.
  double at_parameters(double r, double s, double t) const;
  const std::string& text() const;
  /// True where the value depends on the variable (x, y, r, s or t), through definitions too.
  bool uses(const std::string& variable) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The names an expression contains, numbers such as 1e-3 left out. Includes names of functions.
std::set<std::string> names_in(const std::string& text);

/// Parameters, or definitions, that need each other one after the other: more than any case has.
inline constexpr std::size_t longest_chain = 100;

/// "a -> b -> c" of names that need each other, without the middle of many.
std::string chain_text(const std::vector<std::string>& names);

/// Names with a meaning of their own in every expression: variables, pi, functions.
const std::vector<std::string>& reserved_names();

}  // namespace fsi
