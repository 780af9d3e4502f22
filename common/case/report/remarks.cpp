#include "common/case/report/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/case/check/given/given.hpp"
#include "common/case/check/given/given_states.hpp"
#include "common/case/check/given/sample.hpp"
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

/// Smallest p / rho of what a case says of a gas [pressure volume/mass].
double lowest_temperature(const Case& problem, const FluidSpec& fluid) {
  double lowest = std::numeric_limits<double>::infinity();
  each_state(problem, fluid, [&](double rho, const Vec2&, double p) { lowest = std::min(lowest, p / rho); });
  return lowest;
}

/// Largest Mach number of what a case says of a gas.
double highest_mach(const Case& problem, const FluidSpec& fluid) {
  double highest = 0;
  each_state(problem, fluid, [&](double rho, const Vec2& v, double p) {
    if (p > 0) highest = std::max(highest, v.norm() / std::sqrt(fluid.gamma * p / rho));
  });
  return highest;
}

constexpr double no_wind_has_more = 25;  ///< Mach number

/// In SI units gases that people blow on solids have R T of 6000 (the heaviest, at room temperature) and more.
constexpr double no_gas_has_less = 3000;

/// Does gas go out by a side of an upright rectangle at all times and places, where its state says so?
bool leaves_by(const Case& problem, const FluidSpec& fluid, Side side) {
  const auto& state = fluid.boundary[static_cast<std::size_t>(side)].state;
  if (!state || fluid.grid.kind != GridSpec::Kind::rectangle || fluid.grid.rotation != 0) return false;
  const bool along_x = side == Side::left || side == Side::right;
  const double outward = side == Side::left || side == Side::bottom ? -1 : 1;
  for (int k = 0; k < times_of_known_values(fluid, side, *state); ++k) {
    const double t = looked_at_time(problem, k);
    for (const Vec2& x : sample_points(fluid.grid, side, t)) {
      if (!(outward * (along_x ? state->v1 : state->v2)(x[0], x[1], t) > 0)) return false;
    }
  }
  return true;
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
    for (const Side side : all_sides) {
      const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
      if (spec.kind != BoundaryKind::inflow || !leaves_by(problem, fluid, side)) continue;
      remarks.push_back(fmt::format(
          "{}.boundary.{}: the state of this inflow goes out of the gas; is the sign of its velocity right?",
          fluid.path, name_of(side)));
    }
    if (const double mach = highest_mach(problem, fluid); mach > no_wind_has_more)
      remarks.push_back(fmt::format(
          "{}: the gas goes at Mach {:.3g} in one of its states; is a speed written where the case takes a "
          "Mach number, or p in other units than rho v^2?",
          fluid.path, mach));
    if (const double T = lowest_temperature(problem, fluid); problem.in_si && T > 0 && T < no_gas_has_less)
      remarks.push_back(fmt::format(
          "{}: p / rho is {:.3g} m2/s2 in one of its states, as of no gas (`units: SI`; air at 288 K has "
          "82700); `T` is p / rho and not "
          "kelvin: for air write 287 times the kelvin, and p in Pa",
          fluid.path, T));
    if (!presses_from_all_sides(problem, fluid)) continue;
    remarks.push_back(fmt::format(
        "{}.p_e is 0: elastic bodies are free of stress in a vacuum, and the whole pressure of the gas "
        "presses them from t = 0 on; write the pressure at which they rest, unless this is meant",
        fluid.path));
  }
  return remarks;
}

}  // namespace fsi
