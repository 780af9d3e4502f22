#include "fluid_solver/measures/budget.hpp"

#include <array>
#include <cstddef>

#include "fluid_solver/boundary/side_points.hpp"

namespace fsi::fluid {

namespace {

using Rates = std::array<double, 4>;

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

Budget::Budget(GasSolver& solver) {
  solver.note_edges();
  for (const Side side : all_sides) open_[static_cast<std::size_t>(side)] = solver.lets_pass(side);
  initial_ = solver.totals_without(open_);
}

/// What part of point k's length along a side belongs to the balance: half at a corner, nothing of it where
/// the side it meets there is open.
double Budget::end_weight(Side side, int k, int n) const {
  if (k > 0 && k + 1 < n) return 1;
  const std::size_t first_neighbour = direction_of(side) == 0 ? 2 : 0;
  return open_[first_neighbour + (k > 0 ? 1 : 0)] ? 0 : 0.5;
}

/// Through the faces half a cell before a side, as the last step had them.
void Budget::add_crossed(const GasSolver& solver, Side side) {
  const std::span<const double> edge = solver.edge(side);
  const auto n = static_cast<std::size_t>(SidePoints(solver.state().layout, side).n());
  const double inwards = (at_upper_end(side) ? -1 : 1) * solver.background_cell_area();
  for (std::size_t c = 0; c < crossed_.size(); ++c) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k)
      sum += end_weight(side, static_cast<int>(k), static_cast<int>(n)) * edge[c * n + k];
    crossed_[c] += inwards * sum;
  }
}

/// Pressure of the gas on a wall of the background.
void Budget::add_wall(const GasSolver& solver, Side side, Rates& rates) const {
  const ConstFieldView q = solver.state(), x = solver.grid().x();
  const SidePoints points(q.layout, side);
  const double outward = at_upper_end(side) ? 1 : -1;
  const double spacing = (position(x, points, 1, 0) - position(x, points, 0, 0)).norm();
  const std::size_t momentum = direction_of(side) == 0 ? 1 : 2;
  for (int k = 0; k < points.n(); ++k) {
    const auto [i, j] = points.at(k, 0);
    rates[momentum] -= outward * q(3, i, j) * spacing * end_weight(side, k, points.n());
  }
}

void Budget::add(const GasSolver& solver, std::span<const InterfaceLoad> interfaces, double dt) {
  Rates rates{};
  for (const Side side : all_sides) {
    if (!open_[static_cast<std::size_t>(side)]) add_wall(solver, side, rates);
    if (open_[static_cast<std::size_t>(side)] && dt > 0) add_crossed(solver, side);
  }
  for (const InterfaceLoad& load : interfaces) add_interface(solver, load, rates);
  pushed_.add(rates, dt);
}

Totals Budget::defect(const GasSolver& solver) const {
  const Totals now = solver.totals_without(open_);
  const auto in = [&](std::size_t c) { return pushed_.sum()[c] + crossed_[c]; };
  return {.mass = now.mass - initial_.mass - in(0),
          .momentum1 = now.momentum1 - initial_.momentum1 - in(1),
          .momentum2 = now.momentum2 - initial_.momentum2 - in(2),
          .energy = now.energy - initial_.energy - in(3),
          .angular_momentum = 0};
}

void Budget::archive(Archive& archive) {
  pushed_.archive(archive);
  archive.values("crossed", crossed_);
}

}  // namespace fsi::fluid
