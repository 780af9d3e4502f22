#include "fluid_solver/budget.hpp"

#include <array>
#include <cstddef>

#include "fluid_solver/side_points.hpp"

namespace fsi::fluid {

namespace {

using Rates = std::array<double, 4>;

/// Flux of the Euler equations (31) through a side of the background, into the gas.
void add_side(const GasSolver& solver, Side side, Rates& rates) {
  const ConstFieldView q = solver.state(), x = solver.grid().x();
  const SidePoints points(q.layout, side);
  const double outward = at_upper_end(side) ? 1 : -1;
  const int normal = direction_of(side);
  for (int k = 0; k < points.n(); ++k) {
    const int before = k > 0 ? k - 1 : 0, after = k + 1 < points.n() ? k + 1 : k;
    const double ds = 0.5 * (position(x, points, after, 0) - position(x, points, before, 0)).norm();
    const auto [i, j] = points.at(k, 0);
    const double rho = q(0, i, j), v1 = q(1, i, j), v2 = q(2, i, j), p = q(3, i, j);
    const double through = outward * (normal == 0 ? v1 : v2) * ds;
    const double E = p / (solver.options().gamma - 1) + 0.5 * rho * (v1 * v1 + v2 * v2);
    rates[0] -= rho * through;
    rates[1] -= rho * v1 * through + (normal == 0 ? outward * p * ds : 0);
    rates[2] -= rho * v2 * through + (normal == 1 ? outward * p * ds : 0);
    rates[3] -= (E + p) * through;
  }
}

/// Force and power of a solid on the gas.
void add_interface(const GasSolver& solver, const InterfaceLoad& load, Rates& rates) {
  const SidePoints points(solver.state(load.grid).layout, load.side);
  const ConstFieldView x = solver.grid(load.grid).x();
  const std::size_t n = load.v_n.size();
  for (int k = 0; k < points.n(); ++k) {
    const int before = k > 0 ? k - 1 : 0, after = k + 1 < points.n() ? k + 1 : k;
    const Vec2 here = position(x, points, k, 0);
    const double ds = 0.5 * ((position(x, points, after, 0) - here).norm() +
                             (here - position(x, points, before, 0)).norm());
    const auto at = static_cast<std::size_t>(k);
    const double push = (solver.options().p_e - load.w_n[at]) * ds;
    rates[1] += push * load.n[at];
    rates[2] += push * load.n[n + at];
    rates[3] += push * load.v_n[at];
  }
}

}  // namespace

void Budget::add(const GasSolver& solver, std::span<const InterfaceLoad> interfaces, double dt) {
  Rates rates{};
  for (const Side side : all_sides) add_side(solver, side, rates);
  for (const InterfaceLoad& load : interfaces) add_interface(solver, load, rates);
  inflow_.add(rates, dt);
}

Totals Budget::defect(const GasSolver& solver) const {
  const Totals now = solver.totals();
  const Rates& in = inflow_.sum();
  return {.mass = now.mass - initial_.mass - in[0],
          .momentum1 = now.momentum1 - initial_.momentum1 - in[1],
          .momentum2 = now.momentum2 - initial_.momentum2 - in[2],
          .energy = now.energy - initial_.energy - in[3],
          .angular_momentum = 0};
}

}  // namespace fsi::fluid
