#pragma once
/// Gas runs of the tests: grids, solutions and a time loop without coupler.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "fluid_solver/gas_solver.hpp"

namespace fsi::fluid::test {

inline constexpr double pi = std::numbers::pi;

inline const std::array<Boundary, 4> open_sides{Outflow{}, Outflow{}, Outflow{}, Outflow{}};

/// Rectangle [x_a, x_b] x [y_a, y_b], at rest.
inline grid::GridDescription rectangle(int n1, int n2, const Vec2& low, const Vec2& high) {
  return {.n1 = n1, .n2 = n2, .mapping = [low, high](double r, double s, double) {
            return Vec2(low[0] + r * (high[0] - low[0]), low[1] + s * (high[1] - low[1]));
          }};
}

/// The same rectangle with interior lines that bend and swing; its outline stays where it is.
inline grid::GridDescription wavy(int n1, int n2, const Vec2& low, const Vec2& high) {
  return {.n1 = n1,
          .n2 = n2,
          .mapping =
              [low, high](double r, double s, double t) {
                const Vec2 size = high - low;
                const double swing = 0.04 * std::sin(2 * pi * r) * std::sin(2 * pi * s);
                return Vec2(low[0] + size[0] * (r + swing * std::cos(3 * t)),
                            low[1] + size[1] * (s + swing * std::sin(2 * t + 1)));
              },
          .moving = true};
}

/// Projected values of one interface side, owned.
struct OwnedInterface {
  Side side = Side::left;
  std::vector<double> n, v_n, w_n, v, a;
  int grid = 0;
  InterfaceValues view() const { return {side, n, v_n, w_n, v, a, grid}; }
};

/// Called after each predicted step with the time: interface values, or none.
using Projection = std::function<std::vector<OwnedInterface>(const GasSolver&, double t)>;

inline void apply(GasSolver& gas, double t, const Projection& project) {
  std::vector<OwnedInterface> owned;
  if (project) owned = project(gas, t);
  std::vector<InterfaceValues> views;
  for (const OwnedInterface& side : owned) views.push_back(side.view());
  gas.apply_fluid_bcs(t, views);
}

/// Positions of the points of the commanded side at a time, component-major.
using Command = std::function<std::vector<double>(double t)>;

/// The side that is commanded.
struct CommandedSide {
  Side side = Side::left;
  int grid = 0;
};

/// Runs from gas.time() to t_end, the commanded side going where it is told; returns the number of steps.
inline int run_commanded(GasSolver& gas, double t_end, const Projection& project, const Command& command,
                         const CommandedSide& commanded = {}) {
  double t = gas.time();
  int steps = 0;
  apply(gas, t, project);
  while (t < t_end * (1 - 1e-14)) {
    const double left = std::ceil((t_end - t) / gas.compute_time_step().dt - 1e-9);
    const double dt = (t_end - t) / left, t_new = left < 1.5 ? t_end : t + dt;
    std::vector<double> x;
    std::vector<grid::SideCommand> commands;
    if (command) {
      x = command(t_new);
      commands.push_back({commanded.side, x, commanded.grid});
    }
    gas.move_grids(t_new, dt, commands);
    gas.advance_fluid(t_new, dt);
    apply(gas, t_new, project);
    t = t_new;
    ++steps;
  }
  return steps;
}

inline int run(GasSolver& gas, double t_end, const Projection& project = {}) {
  return run_commanded(gas, t_end, project, {});
}

inline GasSolver solver(grid::GridDescription description, const GasOptions& options,
                        std::array<Boundary, 4> boundaries, const StateField& initial) {
  GasSolver gas(grid::MovingGrid(std::move(description), 0), options, std::move(boundaries), 0);
  gas.assign_initial_conditions(initial);
  return gas;
}

inline double largest_error(const GasErrors& errors) {
  return std::max({errors.rho, errors.v1, errors.v2, errors.T});
}

/// Rate of convergence from errors on grids whose spacing halves each time: least squares on logarithms.
inline double rate(const std::vector<double>& errors) {
  const auto n = static_cast<double>(errors.size());
  double sum_k = 0, sum_e = 0, sum_kk = 0, sum_ke = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double k = static_cast<double>(i), e = -std::log2(errors[i]);
    sum_k += k, sum_e += e, sum_kk += k * k, sum_ke += k * e;
  }
  return (n * sum_ke - sum_k * sum_e) / (n * sum_kk - sum_k * sum_k);
}

/// Isentropic vortex carried by a uniform stream (C.-W. Shu), around (x_0 + u t, y_0 + v t).
struct Vortex {
  double gamma = 1.4, strength = 3, u = 0.5, v = 0.3, x_0 = 0, y_0 = 0;
  State operator()(double x, double y, double t) const {
    const double a = x - x_0 - u * t, b = y - y_0 - v * t;
    const double swirl = strength / (2 * pi) * std::exp(0.5 * (1 - a * a - b * b));
    const double T = 1 - (gamma - 1) / (2 * gamma) * swirl * swirl;
    const double rho = std::pow(T, 1 / (gamma - 1));
    return {.rho = rho, .v1 = u - swirl * b, .v2 = v + swirl * a, .p = rho * T};
  }
};

}  // namespace fsi::fluid::test
