#pragma once
/// Meets a solid: normal velocity and pressure are the projected ones.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "common/core/failure.hpp"
#include "common/interface/wave_curve.hpp"
#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

struct Interface {
  static constexpr std::array keys{
      schema::Key{.name = "solid",
                  .type = schema::Type::name,
                  .meaning = "the solid on the other side",
                  .required = true},
  };
  static constexpr GasBoundaryFacts facts{
      .meaning = "a solid is on the other side", .keys = keys, .meets_solid = true, .precedence = 0};

  static Interface from(const BoundaryData& /*data*/) { return {}; }

  static void set_points(const GasSide& side) {
    check(side, values_of(side));
    for (int k = 0; k < side.points.n(); ++k) {
      if (!side.points.elsewhere(k)) set_point(side, k);
    }
  }

  /// n.v := v_n^I, p := p_e - w_n^I, and the density that goes with the change of pressure.
  static void set_point(const GasSide& side, int k) {
    const InterfaceValues& values = values_of(side);
    const auto n = static_cast<std::size_t>(side.points.n()), point = static_cast<std::size_t>(k);
    const auto at = side.points.at(k, 0);
    const Vec2 normal(values.n[point], values.n[n + point]);
    StateVector state = load(side.q, at);
    const double p_I = pressure(side, values, point, state[3]);
    const Vec2 v = state.segment<2>(1);
    state.segment<2>(1) = v + (values.v_n[point] - normal.dot(v)) * normal;
    state[0] *= density_ratio(side.options, p_I / state[3]);
    state[3] = p_I;
    store(side.q, at, state);
  }

  static void set_ghosts(const GasSide& side) {
    const InterfaceValues& values = values_of(side);
    set_wall_ghosts(side, side.wall(values.n, values.v, values.a));
  }

 private:
  static const InterfaceValues& values_of(const GasSide& side) {
    if (side.projected != nullptr) return *side.projected;
    throw std::logic_error(fmt::format("no interface values for side \"{}\"", name_of(side.points.side())));
  }

  /// p^I = p_e - w_n^I [pressure]
  static double pressure(const GasSide& side, const InterfaceValues& values, std::size_t point) {
    return side.options.p_e - values.w_n[point];
  }

  /// The same where the gas had the pressure p. Where gas and solid part and a vacuum opens between them, p_e less the pressure
  /// that is left has lost it in round-off.
  static double pressure(const GasSide& side, const InterfaceValues& values, std::size_t point, double p) {
    const double p_I = pressure(side, values, point);
    if (p_I > WaveCurve::least_sound * p || !side.options.wave_curve) return p_I;
    return std::max(p_I, least_pressure_ratio(side.options.gamma) * p);
  }

  /// All ranks look at all points, so that all of them find the same one.
  static void check(const GasSide& side, const InterfaceValues& values) {
    constexpr double round_off = 1e-12;  // of a sum of a few terms, with a margin [-]
    double largest = std::fabs(side.options.p_e);
    for (std::size_t k = 0; k < static_cast<std::size_t>(side.points.n()); ++k)
      largest = std::max(largest, pressure(side, values, k));
    const double lowest = side.options.wave_curve ? -round_off * largest : 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(side.points.n()); ++k) {
      const auto at = side.points.at(static_cast<int>(k), 0);
      const double p_I = pressure(side, values, k);
      if (!(p_I > lowest && std::isfinite(p_I) && std::isfinite(values.v_n[k]))) {
        throw Diverged(
            fmt::format("p^I = {:.3g}, v_n^I = {:.3g}: gas and solid part faster than the gas can follow; {}",
                        p_I, values.v_n[k], remedy(side.options)),
            {.t = side.t,
             .grid = side.grid,
             .point = {at.i, at.j},
             .position = {side.x(0, at.i, at.j), side.x(1, at.i, at.j)}});
      }
    }
  }

  static const char* remedy(const GasOptions& options) {
    if (!options.wave_curve) return "write interface.riemann: exact, for jumps of this size";
    return "let the run end before (time.end), load the solid less, or look at last_state/ for what throws "
           "it";
  }

  /// Of the gas through the wave that changes its pressure so many times.
  static double density_ratio(const GasOptions& options, double pressure_ratio) {
    return options.wave_curve ? fsi::density_ratio(options.gamma, pressure_ratio)
                              : std::pow(pressure_ratio, 1 / options.gamma);
  }
};

}  // namespace fsi::fluid
