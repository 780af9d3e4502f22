/// The gas solver on several ranks: what a solver does there besides its step.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <utility>

#include "fluid_solver/boundary/boundary_conditions.hpp"
#include "fluid_solver/boundary/side_points.hpp"
#include "fluid_solver/gas_solver.hpp"

namespace fsi::fluid {

void add_side_strips(const Layout& layout, Side side, std::vector<Strip>& strips, int grid) {
  const SidePoints points(layout, side);
  if (direction_of(side) == 1) {
    strips.push_back({grid, points.at(0, 0).j, 0, layout.n1});
    return;
  }
  for (int k = 0; k < points.n(); ++k) strips.push_back({grid, k, points.at(k, 0).i, points.at(k, 0).i + 1});
}

std::span<const CutGrid> GasSolver::cut_grids() {
  cut_grids_.clear();
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const Component& component = components_[k];
    const int level = levels_ ? levels_->level_of(k) : 0;
    cut_grids_.push_back({.layout = component.grid().layout(),
                          .periodic2 = component.grid().periodic(1),
                          .discretised = &component.discretised(),
                          .averaged = level > 0 ? &levels_->averaged(level) : nullptr});
  }
  return cut_grids_;
}

void GasSolver::share(std::shared_ptr<Ranks> ranks, const RecutOptions& options) {
  if (ranks->alone()) return;
  RecutOptions cut = options;
  cut.pieces = levels_ ? Pieces::of_each_grid : Pieces::of_all_grids;
  share_ = Share(std::move(ranks), cut, cut_grids());
  take_rows();
}

void GasSolver::take_rows() {
  for (int k = 0; k < grids(); ++k) components_[static_cast<std::size_t>(k)].take_rows(share_.rows(k));
  if (levels_) levels_->share_out(level_scene());
  share_.plan(cut_grids(), composite());
}

void GasSolver::share_out_anew() {
  if (!share_.recut_is_due(cut_grids())) return;
  std::vector<std::vector<FieldView>> fields;
  for (Component& component : components_) {
    const std::vector<FieldView> of_one = component.moving_fields();
    fields.resize(of_one.size());
    for (std::size_t f = 0; f < of_one.size(); ++f) fields[f].push_back(of_one[f]);
  }
  share_.recut(cut_grids(), fields);
  take_rows();
}

void GasSolver::bring_advanced() {
  if (share_.alone()) return;
  share_.bring(gather_fields());
  for (Component& component : components_) close_periods(component);
}

namespace {

/// A point with its rate and state, as numbers for other ranks.
struct Candidate {
  FastestPoint point;
  State state;

  static constexpr std::size_t size = 8;
  void write(std::vector<double>& to) const {
    to.insert(to.end(), {point.rate, static_cast<double>(point.look), static_cast<double>(point.j),
                         static_cast<double>(point.i), state.rho, state.v1, state.v2, state.p});
  }
  static Candidate read(const double* from) {
    return {.point = {.rate = from[0],
                      .i = static_cast<int>(from[3]),
                      .j = static_cast<int>(from[2]),
                      .look = static_cast<int>(from[1])},
            .state = {.rho = from[4], .v1 = from[5], .v2 = from[6], .p = from[7]}};
  }
  /// Of equal rates, the point that a single rank would have come by first.
  bool before(const Candidate& other) const {
    const auto order = [](const FastestPoint& p) { return std::tuple(-p.rate, p.look, p.j, p.i); };
    return order(point) < order(other.point);
  }
};

/// The candidates of one grid.
struct Candidates {
  double row_rate = -1;
  Candidate inner, rest;

  static constexpr std::size_t size = 1 + 2 * Candidate::size;
  void write(std::vector<double>& to) const {
    to.push_back(row_rate);
    inner.write(to);
    rest.write(to);
  }
  static Candidates read(const double* from) {
    return {.row_rate = from[0],
            .inner = Candidate::read(from + 1),
            .rest = Candidate::read(from + 1 + Candidate::size)};
  }
  /// Ranks come in the order of rows, so of equal rows the first one stays.
  void join(const Candidates& other) {
    if (other.row_rate > row_rate) row_rate = other.row_rate, inner = other.inner;
    if (other.rest.before(rest)) rest = other.rest;
  }
  const Candidate& best() const { return rest.point.rate > inner.point.rate ? rest : inner; }
};

constexpr std::size_t health_numbers = 8;

void write(const Health& health, std::vector<double>& to) {
  to.insert(to.end(),
            {health.min_rho, health.min_p, static_cast<double>(health.first_order_fallbacks),
             static_cast<double>(health.first_order_outside_shocks),
             static_cast<double>(health.positive_fluxes), static_cast<double>(health.positive_values),
             static_cast<double>(health.bounded_side_points), static_cast<double>(health.floors)});
}

void join(Health& health, const double* other) {
  health.min_rho = std::min(health.min_rho, other[0]);
  health.min_p = std::min(health.min_p, other[1]);
  std::uint64_t* const counts[] = {&health.first_order_fallbacks, &health.first_order_outside_shocks,
                                   &health.positive_fluxes,       &health.positive_values,
                                   &health.bounded_side_points,   &health.floors};
  for (std::size_t k = 0; k < std::size(counts); ++k) *counts[k] += static_cast<std::uint64_t>(other[2 + k]);
}

}  // namespace

/// Where all points must be looked at anyhow, their health is seen on the way.
void GasSolver::look_alone() {
  if (std::ranges::none_of(components_, &Component::rates_need_neighbours)) return;
  seen_ = {};
  seen_.health = nothing_seen();
  for (int k = 0; k < grids(); ++k) {
    const Extremes extremes = component(k).extremes();
    raise(seen_, k, extremes.fastest.point());
    add_health(component(k), extremes.smallest, seen_.health);
  }
  looked_ = true;
}

void GasSolver::look() {
  if (share_.alone()) return look_alone();
  Ranks& ranks = share_.ranks();
  if (std::ranges::any_of(components_, &Component::rates_need_neighbours))
    share_.bring_neighbours(gather_fields());
  Health here = nothing_seen();
  std::vector<double> rates;
  std::vector<Strip> strips;
  for (int k = 0; k < grids(); ++k) {
    const Extremes extremes = component(k).extremes();
    add_health(component(k), extremes.smallest, here);
    const FastestPoints& fastest = extremes.fastest;
    const auto with_state = [q = state(k)](const FastestPoint& at) {
      return Candidate{at, {q(0, at.i, at.j), q(1, at.i, at.j), q(2, at.i, at.j), q(3, at.i, at.j)}};
    };
    Candidates{fastest.row_rate, with_state(fastest.inner), with_state(fastest.rest)}.write(rates);
    for (const Side side : all_sides) {
      if (component(k).facts(side).meets_solid) add_side_strips(state(k).layout, side, strips, k);
    }
  }
  share_.to_first(strips, gather_fields());
  std::vector<double> mine;
  write(here, mine);
  mine.insert(mine.end(), rates.begin(), rates.end());
  see(ranks.together(mine), here.min_cell_quality);
}

void GasSolver::see(std::span<const double> of_all, double cell_quality) {
  const std::size_t grid_count = components_.size(), numbers = health_numbers + grid_count * Candidates::size;
  std::vector<Candidates> candidates(grid_count);
  seen_ = {};
  seen_.health = nothing_seen();
  seen_.health.min_cell_quality = cell_quality;
  for (std::size_t at = 0; at < of_all.size(); at += numbers) {
    join(seen_.health, &of_all[at]);
    for (std::size_t k = 0; k < grid_count; ++k)
      candidates[k].join(Candidates::read(&of_all[at + health_numbers + k * Candidates::size]));
  }
  for (std::size_t k = 0; k < grid_count; ++k) {
    const Candidate& best = candidates[k].best();
    if (k > 0 && best.point.rate <= seen_.fastest.rate) continue;
    seen_.fastest = best.point;
    seen_.grid = static_cast<int>(k);
    seen_.state = best.state;
  }
}

void GasSolver::fetch(std::span<const Strip> strips) {
  if (share_.alone()) return;
  share_.to_first(strips, gather_fields());
  gather_edges();
}

/// Faces along a side belong to the rows beside them.
void GasSolver::gather_edges() {
  for (const int k : backgrounds()) {
    Component& background = components_[static_cast<std::size_t>(k)];
    const Layout& layout = background.grid().layout();
    const auto each = [&](const grid::RowRange& rows, const auto& action) {
      for (const Side side : all_sides) {
        const std::span<double> edge = background.edge(side);
        const SidePoints points(layout, side);
        for (std::size_t at = 0; at < edge.size(); ++at) {
          const int line = direction_of(side) == 0 ? 0 : edge_lines(k);
          if (rows.contains(points.at(static_cast<int>(at) % points.n(), line).j)) action(edge[at]);
        }
      }
    };
    std::vector<double> mine;
    each(background.rows().own, [&](double value) { mine.push_back(value); });
    const std::vector<double> all = share_.ranks().together(mine);
    auto next = all.begin();
    for (int rank = 0; rank < share_.ranks().size(); ++rank)
      each(share_.cut().own(k, rank), [&](double& value) { value = *next++; });
  }
}

/// All that anybody looks at: whole rows, or of sparse grids what they keep.
std::vector<Strip> GasSolver::kept_strips() const {
  std::vector<Strip> strips;
  for (int k = 0; k < grids(); ++k) {
    if (is_level(k)) {
      component(k).add_kept_strips(strips, k);
      continue;
    }
    const int n2 = state(k).layout.n2;
    for (int j = -Layout::ghosts; j < n2 + Layout::ghosts; ++j) strips.push_back(share_.whole_row(k, j));
  }
  return strips;
}

void GasSolver::collect() {
  if (!share_.alone()) share_.to_first(kept_strips(), gather_fields());
}

void GasSolver::collect_all() {
  if (share_.alone()) return;
  const std::vector<Strip> strips = kept_strips();
  std::vector<FieldView> fields;
  const std::size_t kinds = components_.front().moving_fields().size();
  for (std::size_t f = 0; f < kinds; ++f) {
    fields.clear();
    for (Component& component : components_) fields.push_back(component.moving_fields()[f]);
    share_.to_first(strips, fields);
  }
  gather_edges();
  for (Component& component : components_) {
    const std::vector<double> all = share_.ranks().together(component.scattered());
    if (share_.ranks().first()) {
      component.gather_scattered(all);
    } else {
      component.forget_counters();
    }
  }
}

void GasSolver::loaded() {
  if (share_.alone()) return;
  if (!share_.ranks().first())
    for (Component& component : components_) component.forget_counters();
  take_rows();
}

}  // namespace fsi::fluid
