#include "fluid_solver/measures/budget.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include "common/interface/point_lengths.hpp"
#include "fluid_solver/boundary/side_points.hpp"

namespace fsi::fluid {

namespace {

using Rates = std::array<double, 4>;

/// Force and power of a solid on the gas.
void add_interface(const GasSolver& solver, const InterfaceLoad& load, Rates& rates) {
  const SidePoints points(solver.state(load.grid).layout, load.side);
  const ConstFieldView x = solver.grid(load.grid).x();
  const std::size_t n = load.v_n.size();
  std::vector<double> places(2 * n), ds(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 place = position(x, points, static_cast<int>(k), 0);
    places[k] = place.x();
    places[n + k] = place.y();
  }
  point_lengths(places, load.n, ds);
  for (std::size_t k = 0; k < n; ++k) {
    const double push = (solver.options().p_e - load.w_n[k]) * ds[k];
    rates[1] += push * load.n[k];
    rates[2] += push * load.n[n + k];
    rates[3] += push * load.v_n[k];
  }
}

/// Whether the area around a point of a background is that point's, and not another level's.
bool owns(const GasSolver& solver, int grid, SidePoints::Index at) {
  const GasLevels* levels = solver.levels();
  return levels == nullptr ||
         levels->owned(levels->level_of(static_cast<std::size_t>(grid))).contains(at.i, at.j);
}

}  // namespace

Budget::Budget(GasSolver& solver) {
  solver.note_edges();
  for (const Side side : all_sides) open_[static_cast<std::size_t>(side)] = solver.lets_pass(side);
  initial_ = solver.totals_without(open_);
}

/// What part of point k's length along a side belongs to the balance: half at a corner, nothing of it where
/// the side it meets there is open.
double Budget::end_weight(const Along& along, int k) const {
  const std::size_t first_neighbour = direction_of(along.side) == 0 ? 2 : 0;
  for (const bool upper : {false, true}) {
    const int from_end = upper ? along.n - 1 - k : k;
    const bool open = open_[first_neighbour + (upper ? 1 : 0)];
    if (open && from_end <= along.lines) return 0;
    if (from_end == 0) return 0.5;
  }
  return 1;
}

/// Through the faces half a cell before a side, as the last step had them.
void Budget::add_crossed(const GasSolver& solver, const Along& along) {
  const std::span<const double> edge = solver.edge(along.side, along.grid);
  const auto n = static_cast<std::size_t>(along.n);
  const double inwards = (at_upper_end(along.side) ? -1 : 1) * solver.cell_area(along.grid);
  for (std::size_t c = 0; c < crossed_.size(); ++c) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double flux = edge[c * n + k];
      if (flux != 0) sum += end_weight(along, static_cast<int>(k)) * flux;
    }
    crossed_[c] += inwards * sum;
  }
}

/// Pressure of the gas on a wall of the background.
void Budget::add_wall(const GasSolver& solver, const Along& along, Rates& rates) const {
  const ConstFieldView q = solver.state(along.grid), x = solver.grid(along.grid).x();
  const SidePoints points(q.layout, along.side);
  const double outward = at_upper_end(along.side) ? 1 : -1;
  const double spacing = (position(x, points, 1, 0) - position(x, points, 0, 0)).norm();
  const std::size_t momentum = direction_of(along.side) == 0 ? 1 : 2;
  for (int k = 0; k < points.n(); ++k) {
    const auto [i, j] = points.at(k, 0);
    if (owns(solver, along.grid, {i, j}))
      rates[momentum] -= outward * q(3, i, j) * spacing * end_weight(along, k);
  }
}

void Budget::add(const GasSolver& solver, std::span<const InterfaceLoad> interfaces, double dt) {
  Rates rates{};
  for (const Side side : all_sides) {
    const bool open = open_[static_cast<std::size_t>(side)];
    for (const int grid : solver.backgrounds()) {
      const Along along{.side = side,
                        .grid = grid,
                        .n = SidePoints(solver.state(grid).layout, side).n(),
                        .lines = solver.edge_lines(grid)};
      if (!open) add_wall(solver, along, rates);
      if (open && dt > 0) add_crossed(solver, along);
    }
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
