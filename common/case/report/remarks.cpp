#include "common/case/report/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/case/check/given/given_states.hpp"
#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

/// Largest |p - p_e| of a gas, or with rho v^2 added to it [pressure].
double largest_load(const Case& problem, const FluidSpec& fluid, bool brought_to_rest) {
  double load = 0;
  each_state(problem, fluid, [&](double rho, const Vec2& v, double p) {
    load = std::max(load, std::abs(p - fluid.p_e) + (brought_to_rest ? rho * v.squaredNorm() : 0));
  });
  return load;
}

double over_stiffness(const Case& problem, const SolidSpec& solid, bool brought_to_rest) {
  if (!is_continuum(solid.law)) return 0;
  double load = 0;
  for (const FluidSpec& fluid : problem.fluids)
    load = std::max(load, largest_load(problem, fluid, brought_to_rest));
  return load / (solid.lambda + 2 * solid.mu);
}

/// A gas whose p_e was left out beside bodies that it presses.
bool presses_from_all_sides(const Case& problem, const FluidSpec& fluid) {
  const auto is_elastic = [](const SolidSpec& solid) { return is_continuum(solid.law) || solid.beam; };
  if (fluid.p_e != 0 || !fluid.initial || std::ranges::none_of(problem.solids, is_elastic)) return false;
  bool everywhere = true;
  each_state(problem, fluid, [&](double, const Vec2&, double p) { everywhere &= p > 0; });
  return everywhere;
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
  for (const FluidSpec& fluid : problem.fluids) {
    if (!presses_from_all_sides(problem, fluid)) continue;
    remarks.push_back(fmt::format(
        "{}.p_e is 0: elastic bodies are free of stress in a vacuum, and the whole pressure of the gas "
        "presses them from t = 0 on; write the pressure at which they rest, unless this is meant",
        fluid.path));
  }
  return remarks;
}

}  // namespace fsi
