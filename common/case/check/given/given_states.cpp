#include "common/case/check/given/given_states.hpp"

#include <cstddef>
#include <vector>

#include "common/case/check/given/given.hpp"
#include "common/case/check/given/sample.hpp"

namespace fsi {

void each_state(const Case& problem, const FluidSpec& fluid,
                const std::function<void(double rho, const Vec2& v, double p)>& look) {
  const auto look_at = [&](const GasExpressions& state, const std::vector<Vec2>& points, double t) {
    for (const Vec2& at : points) {
      const double x = at[0], y = at[1];
      look(state.rho(x, y, t), {state.v1(x, y, t), state.v2(x, y, t)}, state.p(x, y, t));
    }
  };
  if (fluid.initial) look_at(*fluid.initial, sample_points(fluid), 0);
  for (const Side side : all_sides) {
    const auto& state = fluid.boundary[static_cast<std::size_t>(side)].state;
    if (!state) continue;
    for (int k = 0; k < times_of_known_values(fluid, side, *state); ++k) {
      const double t = looked_at_time(problem, k);
      look_at(*state, sample_points(fluid.grid, side, t), t);
    }
  }
  for (std::size_t c = 0; c < fluid.body_fitted.size(); ++c) {
    const BodyFittedSpec& fitted = fluid.body_fitted[c];
    const auto& state = fitted.boundary[static_cast<std::size_t>(fitted.side)].state;
    if (!state) continue;
    for (int k = 0; k < looked_at_times; ++k)
      look_at(*state, curve_points(fluid, c), looked_at_time(problem, k));
  }
}

}  // namespace fsi
