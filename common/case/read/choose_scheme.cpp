#include "common/case/read/choose_scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/case/check/given/given_states.hpp"
#include "common/case/check/given/sample.hpp"
#include "common/case/document/fluid_sections.hpp"
#include "common/case/grids/node_tools.hpp"

namespace fsi {

namespace {

constexpr double strong_shock = GasScheme::strong_shock;
constexpr double usual_viscosity = 0.5;  // of the published runs [-]
constexpr double rounding = 1 - 1e-9;    // of what a case computes: a shock of just that Mach number counts
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Of a shock, over the pressure before it [-].
double pressure_ratio(double gamma, double mach) {
  return 1 + 2 * gamma / (gamma + 1) * (mach * mach - 1);
}

/// Speed of a piston that drives such a shock, over the speed of sound before it [-].
double piston_speed(double gamma, double mach) {
  return 2 / (gamma + 1) * (mach - 1 / mach);
}

/// Between which all bodies that start with a velocity have theirs [velocity].
struct Velocities {
  Vec2 low{infinite, infinite}, high{-infinite, -infinite};
};

Velocities starts_of(const std::vector<SolidSpec>& solids) {
  Velocities found;
  for (const SolidSpec& solid : solids) {
    if (!solid.initial_v) continue;
    for (const Vec2& x : sample_points(solid)) {
      const Vec2 v(solid.initial_v->c1(x[0], x[1], 0), solid.initial_v->c2(x[0], x[1], 0));
      found = {.low = found.low.cwiseMin(v), .high = found.high.cwiseMax(v)};
    }
  }
  return found;
}

/// Of the states of a gas.
struct Extremes {
  double mach = 0;                      ///< [-]
  double approach = 0;                  ///< of bodies, over the speed of sound [-]
  double p_low = infinite, p_high = 0;  ///< [pressure]
};

/// States of no gas are refused elsewhere.
Extremes extremes_of(const Case& problem, const FluidSpec& fluid, const Velocities& bodies) {
  Extremes found;
  const bool moving = bodies.low[0] <= bodies.high[0];
  each_state(problem, fluid, [&](double rho, const Vec2& v, double p) {
    if (!(rho > 0 && p > 0 && std::isfinite(rho + p) && v.allFinite())) return;
    const double a = std::sqrt(fluid.gamma * p / rho);
    found.mach = std::max(found.mach, v.norm() / a);
    found.p_low = std::min(found.p_low, p);
    found.p_high = std::max(found.p_high, p);
    if (!moving) return;
    const Vec2 apart = (v - bodies.low).cwiseAbs().cwiseMax((v - bodies.high).cwiseAbs());
    found.approach = std::max(found.approach, apart.norm() / a);
  });
  return found;
}

/// May a gas have shocks of that Mach number and more?
bool has_strong_shocks(const Case& problem, const FluidSpec& fluid) {
  const Velocities bodies = starts_of(problem.solids);
  const Extremes here = extremes_of(problem, fluid, bodies);
  double p_high = here.p_high;
  for (const FluidSpec& gas : problem.fluids) {
    if (gas.name != fluid.name) p_high = std::max(p_high, extremes_of(problem, gas, bodies).p_high);
  }
  return here.mach >= rounding * strong_shock ||
         here.approach >= rounding * piston_speed(fluid.gamma, strong_shock) ||
         p_high >= rounding * pressure_ratio(fluid.gamma, strong_shock) * here.p_low;
}

}  // namespace

std::vector<std::string> choose_schemes(config::Node& root, Case& problem) {
  std::vector<std::string> chosen;
  for (const auto& section : fluid_sections(root)) {
    const config::Node* given = section.node->find("scheme");
    const auto fluid = std::ranges::find(problem.fluids, section.name, &FluidSpec::name);
    if (!config::lacks(given, {"shock_viscosity"}) || fluid == problem.fluids.end()) continue;
    if (fluid->scheme.limiter == GasLimiter::none || !has_strong_shocks(problem, *fluid)) continue;
    fluid->scheme.shock_viscosity = usual_viscosity;
    config::put(config::section_of(*section.node, "scheme"), "shock_viscosity",
                config::number_node(usual_viscosity, section.node->place));
    chosen.push_back(fmt::format("{}.scheme: shock_viscosity {}, for shocks of Mach {} and more",
                                 section.path, usual_viscosity, strong_shock));
  }
  return chosen;
}

}  // namespace fsi
