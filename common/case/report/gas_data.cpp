#include "common/case/report/gas_data.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "common/case/check/given/sample.hpp"

namespace fsi {

void each_state(const FluidSpec& fluid, const std::function<void(double rho, double speed, double p)>& look) {
  const auto look_at = [&](const GasExpressions& state, const std::vector<Vec2>& points) {
    for (const Vec2& at : points) {
      const double x = at[0], y = at[1];
      look(state.rho(x, y, 0), std::hypot(state.v1(x, y, 0), state.v2(x, y, 0)), state.p(x, y, 0));
    }
  };
  if (fluid.initial) look_at(*fluid.initial, sample_points(fluid));
  for (const Side side : all_sides) {
    const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
    if (spec.state) look_at(*spec.state, sample_points(fluid.grid, side));
  }
}

}  // namespace fsi
