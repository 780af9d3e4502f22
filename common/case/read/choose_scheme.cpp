#include "common/case/read/choose_scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/case/check/given/sample.hpp"
#include "common/case/document/fluid_sections.hpp"
#include "common/case/grids/node_tools.hpp"
#include "common/case/report/gas_data.hpp"

namespace fsi {

namespace {

constexpr double usual_viscosity = 0.5;  // of the published runs [-]
constexpr double rounding = 1 - 1e-9;    // of what a case computes: a shock of just that Mach number counts

/// Of a shock, over the pressure before it [-].
double pressure_ratio(double gamma, double mach) {
  return 1 + 2 * gamma / (gamma + 1) * (mach * mach - 1);
}

/// Speed of a piston that drives such a shock, over the speed of sound before it [-].
double piston_speed(double gamma, double mach) {
  return 2 / (gamma + 1) * (mach - 1 / mach);
}

double fastest_start(const SolidSpec& solid) {
  double most = 0;
  if (!solid.initial_v) return most;
  for (const Vec2& x : sample_points(solid))
    most = std::max(most, std::hypot(solid.initial_v->c1(x[0], x[1], 0), solid.initial_v->c2(x[0], x[1], 0)));
  return most;
}

/// Of the states of a gas.
struct Extremes {
  double mach = 0;                                         ///< largest [-]
  double sound = std::numeric_limits<double>::infinity();  ///< least [velocity]
  double p_low = std::numeric_limits<double>::infinity();  ///< [pressure]
  double p_high = 0;                                       ///< [pressure]
};

/// States of no gas are refused elsewhere.
Extremes extremes_of(const FluidSpec& fluid) {
  Extremes found;
  each_state(fluid, [&](double rho, double speed, double p) {
    if (!(rho > 0 && p > 0 && std::isfinite(rho + speed + p))) return;
    const double a = std::sqrt(fluid.gamma * p / rho);
    found = {.mach = std::max(found.mach, speed / a),
             .sound = std::min(found.sound, a),
             .p_low = std::min(found.p_low, p),
             .p_high = std::max(found.p_high, p)};
  });
  return found;
}

}  // namespace

bool has_strong_shocks(const Case& problem, const FluidSpec& fluid) {
  const double gamma = fluid.gamma;
  const Extremes here = extremes_of(fluid);
  double p_high = here.p_high, body = 0;
  for (const FluidSpec& gas : problem.fluids) {
    if (&gas != &fluid) p_high = std::max(p_high, extremes_of(gas).p_high);
  }
  for (const SolidSpec& solid : problem.solids) body = std::max(body, fastest_start(solid));
  return here.mach >= rounding * strong_shock ||
         p_high >= rounding * pressure_ratio(gamma, strong_shock) * here.p_low ||
         body >= rounding * piston_speed(gamma, strong_shock) * here.sound;
}

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
