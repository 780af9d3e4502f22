#pragma once
/// A number or formula of a case file, compiled once and evaluated often.

#include <map>
#include <memory>
#include <string>

namespace fsi {

/// Formula of x, y, r = |(x, y)|, s and t (for a grid mapping: r and s are its parameters), with the case's
/// parameters and helper definitions already bound. Cheap to move, copies share nothing.
class Expression {
 public:
  Expression();  ///< the constant 0
  explicit Expression(double constant);
  /// `constants` are named numbers, `definitions` named formulas usable in `text`.
  /// @throws std::invalid_argument saying what is wrong with the text
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
  bool uses(const std::string& variable) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fsi
