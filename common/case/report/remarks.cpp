#include "common/case/report/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/case/check/given/sample.hpp"
#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

/// Largest of value(rho, |v|, p) that a gas has at t = 0 and outside its sides, and no less than 0.
template <class Value>
double largest(const FluidSpec& fluid, const Value& value) {
  double most = 0;
  const auto look = [&](const GasExpressions& state, const std::vector<Vec2>& points) {
    for (const Vec2& at : points) {
      const double x = at[0], y = at[1];
      most = std::max(most, value(state.rho(x, y, 0), std::hypot(state.v1(x, y, 0), state.v2(x, y, 0)),
                                  state.p(x, y, 0)));
    }
  };
  if (fluid.initial) look(*fluid.initial, sample_points(fluid));
  for (const Side side : all_sides) {
    const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
    if (spec.state) look(*spec.state, sample_points(fluid.grid, side));
  }
  return most;
}

/// Largest |p - p_e| of a gas, or with rho v^2 added to it [pressure].
double largest_load(const FluidSpec& fluid, bool brought_to_rest) {
  return largest(fluid, [&](double rho, double speed, double p) {
    return std::abs(p - fluid.p_e) + (brought_to_rest ? rho * speed * speed : 0);
  });
}

double over_stiffness(const Case& problem, const SolidSpec& solid, bool brought_to_rest) {
  if (!is_continuum(solid.law)) return 0;
  double load = 0;
  for (const FluidSpec& fluid : problem.fluids) load = std::max(load, largest_load(fluid, brought_to_rest));
  return load / (solid.lambda + 2 * solid.mu);
}

}  // namespace

double largest_mach(const FluidSpec& fluid) {
  return largest(fluid, [&](double rho, double speed, double p) {
    return rho > 0 && p > 0 ? speed / std::sqrt(fluid.gamma * p / rho) : 0;
  });
}

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
  for (const FluidSpec& fluid : problem.fluids) {
    if (fluid.body_fitted.empty() || fluid.scheme.shock_viscosity > 0) continue;
    if (const double mach = largest_mach(fluid); mach > blunt)
      remarks.push_back(fmt::format(
          "{}: the gas streams with Mach {:.3g}; before a blunt body its shock lies along grid lines and is "
          "noisy "
          "there without {}.scheme.shock_viscosity: 0.5 (docs/theory_fluid.md, shocks along grid lines)",
          fluid.path, mach, fluid.path));
  }
  return remarks;
}

}  // namespace fsi
