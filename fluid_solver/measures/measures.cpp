/// What one wants to know of a gas: totals, errors, health, values at a point.

#include <algorithm>
#include <cmath>

#include "common/core/raise_to.hpp"
#include "common/grid/geometry/partition.hpp"
#include "common/grid/geometry/quality.hpp"
#include "fluid_solver/boundary/side_points.hpp"
#include "fluid_solver/gas_solver.hpp"
#include "fluid_solver/state_vector.hpp"

namespace fsi::fluid {

namespace {

/// Corner of the control volumes between points i, i + 1 and j, j + 1; outside the grid's boundary it is
/// pulled back onto it.
Vec2 clipped_corner(const grid::MovingGrid& grid, int i, int j) {
  const Layout& shape = grid.layout();
  const auto clip = [&grid](int k, int n, int direction) {
    return grid.periodic(direction) ? k : std::clamp(k, 0, n - 1);
  };
  Vec2 sum = Vec2::Zero();
  for (const int b : {0, 1}) {
    for (const int a : {0, 1}) {
      const int k = clip(i + a, shape.n1, 0), l = clip(j + b, shape.n2, 1);
      sum += Vec2(grid.x()(0, k, l), grid.x()(1, k, l));
    }
  }
  return 0.25 * sum;
}

/// Area of the control volume of a point, cut at the boundary.
double clipped_volume(const grid::MovingGrid& grid, int i, int j) {
  const Vec2 up = clipped_corner(grid, i, j) - clipped_corner(grid, i - 1, j - 1);
  const Vec2 across = clipped_corner(grid, i - 1, j) - clipped_corner(grid, i, j - 1);
  return 0.5 * (up[0] * across[1] - up[1] * across[0]);
}

/// Cell of the grid that holds a point, and where in it.
struct Place {
  int i, j;
  double r, s;
};

/// Parameters of a point in the bilinear cell (i, j), by Newton; they may lie outside [0, 1].
Place place_in_cell(ConstFieldView x, int i, int j, const Vec2& point) {
  const auto vertex = [&](int a, int b) { return Vec2(x(0, i + a, j + b), x(1, i + a, j + b)); };
  const Vec2 o = vertex(0, 0), e = vertex(1, 0) - o, f = vertex(0, 1) - o, d = vertex(1, 1) - o - e - f;
  double r = 0.5, s = 0.5;
  for (int step = 0; step < 12; ++step) {
    const Vec2 miss = point - (o + r * e + s * f + r * s * d), x_r = e + s * d, x_s = f + r * d;
    const double det = x_r[0] * x_s[1] - x_r[1] * x_s[0];
    r = std::clamp(r + (miss[0] * x_s[1] - miss[1] * x_s[0]) / det, -2.0, 3.0);
    s = std::clamp(s + (x_r[0] * miss[1] - x_r[1] * miss[0]) / det, -2.0, 3.0);
  }
  return {i, j, r, s};
}

constexpr double edge_tolerance =
    1e-9;  ///< a point on the edge between two cells, up to round-off, belongs to either

bool inside(const Place& place) {
  return std::min({place.r, place.s, 1 - place.r, 1 - place.s}) > -edge_tolerance;
}

/// Searches all cells whose vertices surround the point; grids may be curved, so no walk can be trusted.
std::optional<Place> find_cell(ConstFieldView x, const Vec2& point) {
  for (int j = 0; j < x.layout.n2 - 1; ++j) {
    for (int i = 0; i < x.layout.n1 - 1; ++i) {
      bool surrounded = true;
      for (const int c : {0, 1}) {
        const auto [low, high] =
            std::minmax({x(c, i, j), x(c, i + 1, j), x(c, i, j + 1), x(c, i + 1, j + 1)});
        const double margin = edge_tolerance * (high - low);
        surrounded = surrounded && point[c] >= low - margin && point[c] <= high + margin;
      }
      if (!surrounded) continue;
      if (const Place place = place_in_cell(x, i, j, point); inside(place)) return place;
    }
  }
  return std::nullopt;
}

/// Adds what a point of a given area holds.
void add_point(const GasSolver& solver, int grid, SidePoints::Index at, double area, Totals& totals) {
  const ConstFieldView q = solver.state(grid), x = solver.grid(grid).x();
  const auto [i, j] = at;
  const double mass = area * q(0, i, j), v1 = q(1, i, j), v2 = q(2, i, j);
  const double internal = area * q(3, i, j) / (solver.options().gamma - 1);
  totals.mass += mass;
  totals.momentum1 += mass * v1;
  totals.momentum2 += mass * v2;
  totals.energy += internal + 0.5 * mass * (v1 * v1 + v2 * v2);
  totals.angular_momentum += mass * (x(0, i, j) * v2 - x(1, i, j) * v1);
}

/// Lies a point of the background on one of the sides, or on one of so many lines beside it?
bool on_any(const std::array<bool, 4>& sides, const Layout& shape, int lines, SidePoints::Index at) {
  return (sides[0] && at.i <= lines) || (sides[1] && at.i >= shape.n1 - 1 - lines) ||
         (sides[2] && at.j <= lines) || (sides[3] && at.j >= shape.n2 - 1 - lines);
}

/// Control volumes of the points of a level that no finer one covers.
void add_level(const GasSolver& solver, int level, const std::array<bool, 4>& without, Totals& totals) {
  const int k = static_cast<int>(solver.levels()->component(level));
  const grid::MovingGrid& grid = solver.grid(k);
  const grid::RowSets& owned = solver.levels()->owned(level);
  const Layout& shape = grid.layout();
  for (int j = 0; j < shape.n2 - (grid.periodic(1) ? 1 : 0); ++j) {
    for (const grid::Interval& run : owned.row(j)) {
      for (int i = run.begin; i < std::min(run.end, shape.n1 - (grid.periodic(0) ? 1 : 0)); ++i)
        if (!on_any(without, shape, solver.edge_lines(k), {i, j}))
          add_point(solver, k, {i, j}, clipped_volume(grid, i, j), totals);
    }
  }
}

void add_coarse_levels(const GasSolver& solver, const std::array<bool, 4>& without, Totals& totals) {
  for (int level = 1; level < solver.levels()->levels(); ++level) add_level(solver, level, without, totals);
}

/// Control volumes of a grid of its own: the same sums that the scheme conserves.
Totals totals_of_one(const GasSolver& solver, const std::array<bool, 4>& without) {
  const grid::MovingGrid& grid = solver.grid();
  const GasLevels* levels = solver.levels();
  Totals totals;
  if (levels != nullptr) {
    add_level(solver, 0, without, totals);
    add_coarse_levels(solver, without, totals);
    return totals;
  }
  for (int j = 0; j < grid.layout().n2 - (grid.periodic(1) ? 1 : 0); ++j) {
    for (int i = 0; i < grid.layout().n1 - (grid.periodic(0) ? 1 : 0); ++i)
      if (!on_any(without, grid.layout(), 0, {i, j}))
        add_point(solver, 0, {i, j}, clipped_volume(grid, i, j), totals);
  }
  return totals;
}

/// A smooth partition of the areas of overlapping grids.
Totals totals_of_all(const GasSolver& solver, const std::array<bool, 4>& without) {
  std::vector<ConstFieldView> x;
  for (int k = 0; k < solver.composite()->grids(); ++k) x.push_back(solver.grid(k).x());
  const std::vector<Field> areas = grid::area_weights(*solver.composite(), x);
  const GasLevels* levels = solver.levels();
  Totals totals;
  if (levels != nullptr) add_coarse_levels(solver, without, totals);
  for (int k = 0; k < solver.composite()->grids(); ++k) {
    const ConstFieldView area = areas[static_cast<std::size_t>(k)].view();
    for (int j = 0; j < area.layout.n2; ++j) {
      for (const grid::Interval& run : solver.valid(k).row(j)) {
        for (int i = run.begin; i < run.end; ++i) {
          if (k == 0 && on_any(without, area.layout, solver.edge_lines(0), {i, j})) continue;
          if (k == 0 && levels != nullptr && !levels->owned(0).contains(i, j)) continue;
          add_point(solver, k, {i, j}, area(0, i, j), totals);
        }
      }
    }
  }
  return totals;
}

}  // namespace

Totals GasSolver::totals_without(const std::array<bool, 4>& sides) const {
  return composite() == nullptr ? totals_of_one(*this, sides) : totals_of_all(*this, sides);
}

std::vector<int> GasSolver::backgrounds() const {
  std::vector<int> grids{0};
  for (int l = 1; levels_ && l < levels_->levels(); ++l)
    grids.push_back(static_cast<int>(levels_->component(l)));
  return grids;
}

void GasSolver::note_edges() {
  for (const int k : backgrounds()) components_[static_cast<std::size_t>(k)].note_edges(edge_lines(k));
}

/// A face of the coarsest level is one of each finer level too.
int GasSolver::edge_lines(int background) const {
  if (!levels_) return 0;
  int spacings = 1;  // of the coarsest level
  for (int l = levels_->level_of(static_cast<std::size_t>(background)); l + 1 < levels_->levels(); ++l)
    spacings *= refinement_ratio;
  return spacings / 2;
}

bool GasSolver::lets_pass(Side side) const {
  return component(0).facts(side).is_open;
}

Health GasSolver::health() const {
  if (!share_.alone() || looked_) return seen_.health;
  Health health = nothing_seen();
  for (const Component& component : components_) add_health(component, component.smallest(), health);
  return health;
}

Health GasSolver::nothing_seen() {
  const Smallest none;
  return {.min_rho = none.rho, .min_p = none.p};
}

void GasSolver::add_health(const Component& component, const Smallest& smallest, Health& health) {
  health.min_rho = std::min(health.min_rho, smallest.rho);
  health.min_p = std::min(health.min_p, smallest.p);
  if (component.grid().moves())
    health.min_cell_quality = std::min(health.min_cell_quality, grid::cell_quality(component.grid().x()));
  const Counters& counters = component.counters();
  health.first_order_fallbacks += static_cast<std::uint64_t>(counters.first_order);
  health.first_order_outside_shocks += static_cast<std::uint64_t>(counters.first_order_outside_shocks);
  health.positive_fluxes += static_cast<std::uint64_t>(counters.positive_fluxes);
  health.positive_values += static_cast<std::uint64_t>(counters.positive_values);
  health.bounded_side_points += static_cast<std::uint64_t>(counters.bounded_side_points);
  health.floors += static_cast<std::uint64_t>(counters.floors);
}

GasErrors GasSolver::errors(const StateField& exact, double t) const {
  GasErrors errors;
  for (const Component& component : components_) {
    const ConstFieldView q = component.state(), x = component.grid().x();
    for (int j = 0; j < q.layout.n2; ++j) {
      for (const grid::Interval& run : component.valid().row(j)) {
        for (int i = run.begin; i < run.end; ++i) {
          const State s = exact(x(0, i, j), x(1, i, j), t);
          raise_to(errors.rho, std::fabs(q(0, i, j) - s.rho));
          raise_to(errors.v1, std::fabs(q(1, i, j) - s.v1));
          raise_to(errors.v2, std::fabs(q(2, i, j) - s.v2));
          raise_to(errors.T, std::fabs(q(3, i, j) / q(0, i, j) - s.p / s.rho));
        }
      }
    }
  }
  return errors;
}

std::vector<Strip> GasSolver::probe_strips(double x, double y) const {
  std::vector<Strip> strips;
  for (int k = 0; k < grids(); ++k) {
    const std::optional<Place> place = find_cell(grid(k).x(), Vec2(x, y));
    if (!place) continue;
    for (const int j : {place->j, place->j + 1}) strips.push_back({k, j, place->i, place->i + 2});
  }
  return strips;
}

std::vector<std::uint8_t> GasSolver::kinds(int grid) const {
  const Layout shape = state(grid).layout;
  std::vector<std::uint8_t> kinds(shape.points(), 0);
  for (int j = 0; j < shape.n2; ++j) {
    const auto row = kinds.begin() + static_cast<std::ptrdiff_t>(j) * shape.n1;
    for (const grid::Interval& run : valid(grid).row(j))
      std::fill(row + run.begin, row + run.end, std::uint8_t{2});
    for (const grid::Interval& run : discretised(grid).row(j))
      std::fill(row + run.begin, row + run.end, std::uint8_t{1});
  }
  const auto k = static_cast<std::size_t>(grid);
  if (levels_ && levels_->has(k)) levels_->show_once(levels_->level_of(k), kinds);
  return kinds;
}

/// Body-fitted grids, the background, its coarser levels.
std::vector<int> GasSolver::from_finest() const {
  const int fitted = composite() == nullptr ? 1 : composite()->grids();
  std::vector<int> order;
  for (int k = fitted - 1; k >= 0; --k) order.push_back(k);
  for (int k = fitted; k < grids(); ++k) order.push_back(k);
  return order;
}

std::optional<State> GasSolver::probe(double x, double y) const {
  for (const int k : from_finest()) {
    const std::optional<Place> place = find_cell(grid(k).x(), Vec2(x, y));
    if (!place) continue;
    const auto [i, j, r, s] = *place;
    const grid::Interval both{i, i + 2};
    if (!valid(k).contains(both, j) || !valid(k).contains(both, j + 1)) continue;
    const ConstFieldView q = state(k);
    const auto value = [&, i = i, j = j, r = r, s = s](int plane) {
      return (1 - s) * ((1 - r) * q(plane, i, j) + r * q(plane, i + 1, j)) +
             s * ((1 - r) * q(plane, i, j + 1) + r * q(plane, i + 1, j + 1));
    };
    return State{.rho = value(0), .v1 = value(1), .v2 = value(2), .p = value(3)};
  }
  return std::nullopt;
}

Field GasSolver::conserved() const {
  const ConstFieldView q = state();
  Field conserved(q.layout, 4);
  for (int j = -Layout::ghosts; j < q.layout.n2 + Layout::ghosts; ++j) {
    for (int i = -Layout::ghosts; i < q.layout.n1 + Layout::ghosts; ++i) {
      const SidePoints::Index at{i, j};
      store(conserved.view(), at, fluid::conserved(load(q, at), options_.gamma));
    }
  }
  return conserved;
}

}  // namespace fsi::fluid
