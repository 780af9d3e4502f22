#pragma once
/// A gas around a body that drifts, turns and beats.

#include <cmath>
#include <utility>
#include <vector>

#include "common/grid/marching/hyperbolic.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid::test {

/// Units in which a problem is written down: factors of lengths, times and densities.
struct Units {
  double length = 1, time = 1, density = 1;
  double speed() const { return length / time; }
  double pressure() const { return density * speed() * speed(); }
};

/// The same state in other units.
inline StateField in(const Units& units, const StateField& state) {
  return [units, state](double x, double y, double t) {
    const State q = state(x / units.length, y / units.length, t / units.time);
    return State{.rho = units.density * q.rho,
                 .v1 = units.speed() * q.v1,
                 .v2 = units.speed() * q.v2,
                 .p = units.pressure() * q.p};
  };
}

inline constexpr int body_points = 64, body_lines = 8;

/// Outline of the body: not a circle after the start.
inline std::vector<double> body_outline(double time, const Units& units = {}) {
  const double t = time / units.time;
  std::vector<double> x(std::size_t{2} * body_points);
  for (int k = 0; k < body_points; ++k) {
    const double angle = 2 * pi * (k % (body_points - 1)) / (body_points - 1);
    const double radius = 1 + 0.1 * std::sin(2 * t) * std::cos(3 * angle);
    const auto i = static_cast<std::size_t>(k);
    x[i] = units.length * (0.2 + 0.3 * t + radius * std::cos(angle + 0.4 * t));
    x[body_points + i] = units.length * (-0.1 - 0.2 * t + radius * std::sin(angle + 0.4 * t));
  }
  return x;
}

/// [-3, 3]^2 around the body, which is a wall; `far` holds on the outer boundary. `points` of a line of the background.
inline GasSolver around_moving_body(const GasOptions& options, const Boundary& far, const Units& units = {},
                                    int points = 61) {
  const double size = 3 * units.length;
  const grid::HyperbolicGrid ring{.name = "ring",
                                  .points = body_points,
                                  .lines = body_lines,
                                  .curve = Side::top,
                                  .spacing = 0.1 * units.length};
  std::vector<GasPart> parts;
  parts.push_back(
      {grid::MovingGrid(rectangle(points, points, {-size, -size}, {size, size}), 0), {far, far, far, far}});
  parts.push_back({grid::MovingGrid(grid::marched_from(ring, body_outline(0, units)), 0),
                   {Periodic{}, Periodic{}, Idle{}, SlipWall{}}});
  return {std::move(parts),
          {{.name = "ring", .n1 = body_points, .n2 = body_lines, .curve = Side::top}},
          options,
          0};
}

/// A step that is as long as the gas can take; the body goes where it belongs.
inline double step_with_body(GasSolver& gas, double t, const Units& units = {}) {
  gas.look();
  const double dt = gas.compute_time_step().dt;
  std::vector<double> x;
  std::vector<grid::SideCommand> commands;
  if (gas.grids() > 1) {
    x = body_outline(t + dt, units);
    commands.push_back({Side::top, x, 1});
  }
  gas.move_grids(t + dt, dt, commands);
  gas.advance_fluid(t + dt, dt);
  gas.apply_fluid_bcs(t + dt);
  return t + dt;
}

}  // namespace fsi::fluid::test
