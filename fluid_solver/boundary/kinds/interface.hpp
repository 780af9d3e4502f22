#pragma once
/// Meets a solid: normal velocity and pressure are the projected ones.

#include <fmt/format.h>

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
    const double p_I = side.options.p_e - values.w_n[point];
    StateVector state = load(side.q, at);
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

  /// All ranks look at all points, so that all of them find the same one.
  static void check(const GasSide& side, const InterfaceValues& values) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(side.points.n()); ++k) {
      const auto at = side.points.at(static_cast<int>(k), 0);
      const double p_I = side.options.p_e - values.w_n[k];
      if (!(p_I > 0 && std::isfinite(p_I) && std::isfinite(values.v_n[k]))) {
        throw Diverged(
            fmt::format(
                "p^I = {:.3g}, v_n^I = {:.3g}: the solid leaves the gas faster than it can follow; {}", p_I,
                values.v_n[k], remedy(side.options)),
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
