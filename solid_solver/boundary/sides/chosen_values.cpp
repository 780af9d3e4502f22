#include "solid_solver/boundary/sides/chosen_values.hpp"

#include "solid_solver/boundary/ghost_lines.hpp"
#include "solid_solver/boundary/traction_ghost.hpp"

namespace fsi::solid {

SolidState ChosenValues::state(std::ptrdiff_t at, double t) const {
  if (solution_ == nullptr) return {};
  const Vec2 x = position(at);
  return solution_->state(x.x(), x.y(), t);
}

Tensor2 ChosenValues::source(std::ptrdiff_t at, double t) const {
  if (solution_ == nullptr) return {};
  const Vec2 x = position(at);
  return solution_->source(x.x(), x.y(), t).P;
}

Tensor2 ChosenValues::strain_rate(std::ptrdiff_t at, double t) const {
  if (solution_ == nullptr) return {};
  const double delta = 1e-3 * time_scale_;
  const SolidState change = sum_of(state(at, t + delta), -1.0, state(at, t - delta));
  return minus(sum_of(SolidState{}, 0.5 / delta, change).P, source(at, t));
}

}  // namespace fsi::solid
