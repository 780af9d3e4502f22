#include "common/case/report/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/case/check/given/sample.hpp"
#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

/// Largest |p - p_e| of a gas at t = 0 and outside its sides, or with rho v^2 added to it [pressure].
double largest_load(const FluidSpec& fluid, bool brought_to_rest) {
  double load = 0;
  const auto look = [&](const GasExpressions& state, const std::vector<Vec2>& points) {
    for (const Vec2& at : points) {
      const double x = at[0], y = at[1];
      const double v1 = state.v1(x, y, 0), v2 = state.v2(x, y, 0);
      const double ram = brought_to_rest ? state.rho(x, y, 0) * (v1 * v1 + v2 * v2) : 0;
      load = std::max(load, std::abs(state.p(x, y, 0) - fluid.p_e) + ram);
    }
  };
  if (fluid.initial) look(*fluid.initial, sample_points(fluid));
  for (const Side side : all_sides) {
    const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
    if (spec.state) look(*spec.state, sample_points(fluid.grid, side));
  }
  return load;
}

double over_stiffness(const Case& problem, const SolidSpec& solid, bool brought_to_rest) {
  if (!is_continuum(solid.law)) return 0;
  double load = 0;
  for (const FluidSpec& fluid : problem.fluids) load = std::max(load, largest_load(fluid, brought_to_rest));
  return load / (solid.lambda + 2 * solid.mu);
}

}  // namespace

double pressure_over_stiffness(const Case& problem, const SolidSpec& solid) {
  return over_stiffness(problem, solid, false);
}

double stagnation_over_stiffness(const Case& problem, const SolidSpec& solid) {
  return over_stiffness(problem, solid, true);
}

std::vector<std::string> remarks_on(const Case& problem) {
  std::vector<std::string> remarks;
  for (const SolidSpec& solid : problem.solids) {
    if (const double pressed = pressure_over_stiffness(problem, solid); pressed > crushing)
      remarks.push_back(
          fmt::format("solids.{}: the pressure of the gas differs from p_e by up to {:.3g} times its lambda "
                      "+ 2 mu = {:.3g}, which leaves nothing of it; "
                      "are both in the same units?",
                      solid.name, pressed, solid.lambda + 2 * solid.mu));
    if (solid.beam && solid.beam->closed)
      remarks.push_back(
          fmt::format("solids.{}: no gas is computed inside this ring, whatever `initial` says there "
                      "(docs/troubleshooting.md has how two "
                      "gases meet)",
                      solid.name));
  }
  return remarks;
}

}  // namespace fsi
