#pragma once
/// A solution by choice at the points of a grid: conditions on the sides hold for the difference to it.

#include <cstddef>

#include "common/core/field.hpp"
#include "solid_solver/options.hpp"

namespace fsi::solid {

/// Zero where no solution is chosen. Points are said by their address.
class ChosenValues {
 public:
  /// @param x reference positions  @param time_scale over which the solution hardly changes [time]
  ChosenValues(ConstFieldView x, double time_scale) : x_(x), time_scale_(time_scale) {}

  void choose(const ChosenSolution* solution) { solution_ = solution; }
  explicit operator bool() const { return solution_ != nullptr; }
  SolidState state(std::ptrdiff_t at, double t) const;
  /// P - P(F(u)).
  Tensor2 offset(std::ptrdiff_t at, double t) const {
    if (solution_ == nullptr) return {};
    const Vec2 x = position(at);
    return solution_->offset(x.x(), x.y(), t);
  }
  /// Of the stress.
  Tensor2 source(std::ptrdiff_t at, double t) const;
  /// K grad v of the chosen solution: what its source leaves of dP/dt.
  Tensor2 strain_rate(std::ptrdiff_t at, double t) const;

 private:
  Vec2 position(std::ptrdiff_t at) const { return {x_.plane(0)[at], x_.plane(1)[at]}; }

  ConstFieldView x_;
  double time_scale_;
  const ChosenSolution* solution_ = nullptr;
};

}  // namespace fsi::solid
