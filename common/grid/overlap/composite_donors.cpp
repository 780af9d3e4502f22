/// Donors of a composite grid's interpolation points and exposed points.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/overlap/composite_grid.hpp"

namespace fsi::grid {

namespace {

std::string name_of_body(const BodyFittedGrid& body) {
  return body.of.empty() ? fmt::format("the curve of grid \"{}\"", body.name) : body.of;
}

/// What to do where grids no longer overlap that did; where they never did the case's check has its own words.
std::string while_moving(double t) {
  return t > 0 ? "; write a larger grid.factor, whose grids are thinner, or let the run end before" : "";
}

constexpr const char* grid_along_a_wall =
    "if that side is a wall, give it a grid along it in fluid.body_fitted (docs/troubleshooting.md)";

/// In cells, for people; rounded down: where it is too small it must not look large enough.
double to_a_tenth(double cells) {
  return std::floor(10 * cells) / 10;
}

/// How a curve is related to the side of a rectangle that is nearest to a position.
struct Standing {
  bool on_rim = false;  ///< one of its ends is on that side
  double foot = 0;      ///< distance of the nearest of these ends to the position [length]
};

Standing standing_of(const std::vector<double>& curve, const CartesianGrid& rim, const Vec2& x) {
  const std::size_t n = curve.size() / 2;
  const std::array distances{x[0] - rim.x_a, rim.x_b - x[0], x[1] - rim.y_a, rim.y_b - x[1]};
  const auto side = std::ranges::min_element(distances) - distances.begin();
  constexpr double close = 1e-6;
  const double tolerance = close * std::max(rim.dx(), rim.dy());
  Standing standing;
  for (const std::size_t k : {std::size_t{0}, n - 1}) {
    const std::array of_end{curve[k] - rim.x_a, rim.x_b - curve[k], curve[n + k] - rim.y_a,
                            rim.y_b - curve[n + k]};
    if (std::abs(of_end[static_cast<std::size_t>(side)]) >= tolerance) continue;
    const double distance = std::hypot(curve[k] - x[0], curve[n + k] - x[1]);
    standing.foot = standing.on_rim ? std::min(standing.foot, distance) : distance;
    standing.on_rim = true;
  }
  return standing;
}

/// What to do where a body that stands on a side comes near that side.
std::string remedy_at_foot(const Standing& standing, double cell) {
  constexpr double close = 6;  // cells
  if (standing.foot < close * cell)
    return "it stands on that side and folds over at its foot, the sooner the finer the grid is: a stiffer "
           "body, a weaker "
           "load or a foot that widens towards its wall keeps it up; or let the run end before";
  return "it stands on that side: let the run end before, or write a larger grid.factor, with which it may "
         "come nearer";
}

/// Smaller is better.
int rank_of(const std::optional<Stencil>& stencil) {
  if (!stencil) return 4;
  return (stencil->width == 3 ? 0 : 2) + (stencil->implicit ? 1 : 0);
}

}  // namespace

CellMap CompositeGrid::cells_of(int grid, const Level& level) const {
  const GridPositions& positions = positions_[static_cast<std::size_t>(grid) - 1];
  return {.x = level.before ? positions.x_old : positions.x, .closed = body(grid).ends == Curve::closed};
}

Donors CompositeGrid::donors_of(int grid, const Level& level) const {
  const PointSets& sets = level.before ? part(grid).before : part(grid).now;
  return {.discretised = sets.discretised, .valid = sets.valid, .widest = level.widest};
}

Vec2 CompositeGrid::position_of(int grid, int i, int j, const Level& level) const {
  if (grid == 0) return background_.point(i, j);
  const ConstFieldView x = cells_of(grid, level).x;
  return {x(0, i, j), x(1, i, j)};
}

/// Lines from the curve on that are in use; all others are unused.
void CompositeGrid::limit_lines(int grid, int lines) {
  GridRows& rows = part(grid).rows;
  const int n2 = rows.n2, discretised = lines - options_.layers;
  rows.used = curve_below(grid) ? RowRange{0, lines} : RowRange{n2 - lines, n2};
  rows.inner = curve_below(grid) ? RowRange{0, discretised} : RowRange{n2 - discretised, n2};
  classify(part(grid).now, rows, options_.layers, intervals_);
}

void CompositeGrid::connect_all(bool trim, int most_lines, Orphaned points) {
  counts_ = {};
  orphans_ = {};
  for (InterpolationList& list : interpolation_) list.clear();
  classify(part(0).now, part(0).rows, options_.layers, intervals_);
  for (int grid = 1; grid < grids(); ++grid) {
    const int lines = std::min(most_lines, body(grid).n2);
    limit_lines(grid, lines);
    counts_.lines_left_out += static_cast<std::size_t>(body(grid).n2 - lines);
  }
  connect_grid(0, points);
  if (trim) trim_lines();
  for (int grid = 1; grid < grids(); ++grid) connect_grid(grid, points);
}

/// Where curves come near each other, lines that reach behind another curve have holes, and the points around
/// them find no donors; fewer lines from the curves do. All
/// lines once more where they do not, for the message.
void CompositeGrid::connect_with_fewer_lines() {
  int most = 0;
  for (const BodyFittedGrid& grid : bodies_) most = std::max(most, grid.n2);
  for (int lines = most - 1; lines >= options_.layers + 3; --lines) {
    connect_all(false, lines, Orphaned::stop_at_first);
    if (orphans_.count == 0) return;
  }
  connect_all(false, most, Orphaned::count_all);
}

/// Leaves as many lines as the background's donors need, and the interpolation points around them.
void CompositeGrid::trim_lines() {
  for (int grid = 1; grid < grids(); ++grid) {
    int needed = 3;
    for (const InterpolationList& list : interpolation_) {
      if (list.target_grid != 0 || list.donor_grid != grid) continue;
      const Layout& layout = part(grid).layout;
      for (const std::int32_t donor : list.donor) {
        const int j = (donor - Layout::lead) / layout.stride - Layout::ghosts;
        needed = std::max(needed, curve_below(grid) ? j + list.width : layout.n2 - j);
      }
    }
    limit_lines(grid, std::min(needed + options_.layers, body(grid).n2));
  }
}

void CompositeGrid::connect_grid(int grid, Orphaned points) {
  const PointSets& sets = part(grid).now;
  for (int j = 0; j < part(grid).layout.n2; ++j) {
    if (points == Orphaned::stop_at_first && orphans_.count > 0) return;
    if (sets.valid.row(j).size() == sets.discretised.row(j).size() &&
        std::ranges::equal(sets.valid.row(j), sets.discretised.row(j))) {
      continue;
    }
    runs_.clear();
    subtract(sets.valid.row(j), sets.discretised.row(j), runs_);
    for (const Interval& run : runs_) connect_run(grid, j, run, present(3), interpolation_);
  }
}

void CompositeGrid::find_exposed() {
  constexpr Level past{.before = true, .behind_curve = 2, .outside = 1, .widest = 3};
  for (InterpolationList& list : exposed_) list.clear();
  for (int grid = 0; grid < grids(); ++grid) {
    for (int j = 0; j < part(grid).layout.n2; ++j) {
      runs_.clear();
      subtract(part(grid).now.valid.row(j), part(grid).before.valid.row(j), runs_);
      for (const Interval& run : runs_) connect_run(grid, j, run, past, exposed_);
    }
  }
}

/// Donors for the points of a run. The search of a point starts where its neighbour was found, that of the
/// first one at the crossing of a curve nearby.
void CompositeGrid::connect_run(int grid, int j, Interval run, const Level& level,
                                std::vector<InterpolationList>& lists) {
  Start start;
  for (int i = run.begin; i < run.end; ++i) {
    const Vec2 x = position_of(grid, i, j, level);
    if (grid == 0 && start.grid == 0) start = nearest_start(i, j);
    const std::optional<Stencil> stencil = stencil_for(grid, x, start, level);
    if (!stencil) {
      orphan(grid, i, j, x);
      continue;
    }
    list_for(lists, grid, *stencil)
        .append(part(grid).layout.at(i, j), part(stencil->grid).layout.at(stencil->i, stencil->j), *stencil,
                {x[0], x[1]});
    if (level.before) count_exposed(*stencil);
  }
}

/// The best donors of a point; the search among body-fitted grids
/// starts from `start`, which moves to the cell found.
std::optional<Stencil> CompositeGrid::stencil_for(int grid, const Vec2& x, Start& start,
                                                  const Level& level) const {
  std::optional<Stencil> stencil;
  if (grid > 0) {
    stencil = find_stencil(background_, donors_of(0, level), x, level.outside);
    if (stencil) stencil->grid = 0;
  } else {
    if (start.grid != 0) stencil = donor_in(start, x, level);
    if (!stencil) start = {};
  }
  if (rank_of(stencil) > 0 && (!stencil || bodies_.size() > 1)) {
    const std::optional<Stencil> other = donor_anywhere(grid, x, level);
    if (rank_of(other) < rank_of(stencil)) stencil = other;
  }
  return stencil;
}

void CompositeGrid::count_exposed(const Stencil& stencil) {
  const double last = stencil.width - 1;
  const bool within = stencil.r >= 0 && stencil.r <= last && stencil.s >= 0 && stencil.s <= last;
  ++counts_.exposed;
  if (!within) ++counts_.extrapolated;
}

/// The cell at the crossing of a curve nearest to a background point.
CompositeGrid::Start CompositeGrid::nearest_start(int i, int j) const {
  Start start;
  int best = std::numeric_limits<int>::max();
  for (int grid = 1; grid < grids(); ++grid) {
    const Crossing* crossing = cuts_[static_cast<std::size_t>(grid) - 1].nearest(i, j, options_.layers + 2);
    if (crossing == nullptr) continue;
    const int distance = std::abs(2 * (crossing->column - i) - 1) + 2 * std::abs(crossing->row - j);
    if (distance >= best) continue;
    best = distance;
    start = {.grid = grid, .i = crossing->segment, .j = curve_below(grid) ? 0 : body(grid).n2 - 2};
  }
  return start;
}

/// Searches a body-fitted grid from a start, which moves to the cell found.
std::optional<Stencil> CompositeGrid::donor_in(Start& start, const Vec2& x, const Level& level) const {
  const CellMap cells = cells_of(start.grid, level);
  const std::optional<CellPosition> cell = cells.find(x, start.i, start.j);
  if (!cell) return {};
  start.i = cell->i;
  start.j = cell->j;
  const bool below = curve_below(start.grid);
  const Reach reach{.low = below ? level.behind_curve : 0, .high = below ? 0 : level.behind_curve};
  std::optional<Stencil> stencil = find_stencil(cells, donors_of(start.grid, level), x, *cell, reach);
  if (stencil) stencil->grid = start.grid;
  return stencil;
}

/// Searches all body-fitted grids but the point's own, each from its line's nearest points.
std::optional<Stencil> CompositeGrid::donor_anywhere(int target, const Vec2& x, const Level& level) const {
  std::optional<Stencil> best;
  for (int grid = 1; grid < grids(); ++grid) {
    if (grid == target) continue;
    const ConstFieldView points = cells_of(grid, level).x;
    for (const int j : {0, points.layout.n2 / 2, points.layout.n2 - 1}) {
      Start start{.grid = grid, .i = 0, .j = j};
      double smallest = std::numeric_limits<double>::infinity();
      for (int i = 0; i < points.layout.n1; ++i) {
        const double d1 = points(0, i, j) - x[0], d2 = points(1, i, j) - x[1];
        if (d1 * d1 + d2 * d2 < smallest) smallest = d1 * d1 + d2 * d2, start.i = i;
      }
      const std::optional<Stencil> found = donor_in(start, x, level);
      if (rank_of(found) < rank_of(best)) best = found;
      if (rank_of(best) == 0) return best;
    }
  }
  return best;
}

void CompositeGrid::orphan(int grid, int i, int j, const Vec2& x) {
  if (orphans_.count++ == 0) orphans_ = {.count = 1, .grid = grid, .i = i, .j = j, .x = x};
}

/// "; the curves of grids "a" and "b" are 0.04 (0.8 cells)
/// apart at (0.5, 0)": what makes it narrow at a place.
std::string CompositeGrid::nearest_curves(const Vec2& x, double t) const {
  const double cell = std::max(background_.dx(), background_.dy());
  std::vector<std::vector<double>> curves;
  std::vector<std::pair<double, std::size_t>> order;
  for (int grid = 1; grid < grids(); ++grid) {
    const CuttingCurve curve = curve_of(grid);
    std::vector<double>& points = curves.emplace_back(curve.x, curve.x + curve.points);
    points.insert(points.end(), curve.y, curve.y + curve.points);
    order.emplace_back(distance_to(points, x), curves.size() - 1);
  }
  std::ranges::sort(order);
  if (order.empty()) return "";
  const std::size_t a = order[0].second;
  const double to_rim = std::min(
      {x[0] - background_.x_a, background_.x_b - x[0], x[1] - background_.y_a, background_.y_b - x[1]});
  if (order.size() < 2 || to_rim < order[1].first) {
    constexpr double fewest_cells = 3;  // between a curve and a side without a grid along it
    if (t > 0 && order[0].first + to_rim < fewest_cells * cell) {
      const std::string what = fmt::format(
          "; {} has come within {:g} cells of the rim of \"{}\" there, less than the {} that gas between "
          "them takes; ",
          name_of_body(bodies_[a]), to_a_tenth((order[0].first + std::max(to_rim, 0.0)) / cell),
          background_.name, fewest_cells);
      if (const Standing standing = standing_of(curves[a], background_, x); standing.on_rim)
        return what + remedy_at_foot(standing, cell);
      return fmt::format("{}let the rectangle reach farther; {}; or let the run end before", what,
                         grid_along_a_wall);
    }
    if (t > 0 && to_rim < order[0].first)
      return fmt::format(
          "; {} comes to the rim of \"{}\": let the run end before, or the rectangle reach farther (with a "
          "larger grid.factor it may come nearer); {}",
          name_of_body(bodies_[a]), background_.name, grid_along_a_wall);
    const bool comes = t > 0 && !standing_of(curves[a], background_, x).on_rim;
    return fmt::format(
        "; the curve of grid \"{}\" is {:.3g} ({:.2g} cells) from there, the rim of \"{}\" {:.3g}{}{}{}",
        bodies_[a].name, order[0].first, order[0].first / cell, background_.name, std::max(to_rim, 0.0),
        while_moving(t), comes ? "; " : "", comes ? grid_along_a_wall : "");
  }
  const std::size_t b = order[1].second;
  const Gap gap = gap_between(curves[a], curves[b]);
  return fmt::format(
      "; the curves of grids \"{}\" and \"{}\" are {:.3g} ({:.2g} cells) apart at ({:.6g}, {:.6g}){}",
      bodies_[a].name, bodies_[b].name, gap.distance, gap.distance / cell, gap.x[0], gap.x[1],
      while_moving(t));
}

void CompositeGrid::report_orphans(double t, const char* what) const {
  if (orphans_.count == 0) return;
  throw Diverged(fmt::format("{} ({} such points){}", what, orphans_.count, nearest_curves(orphans_.x, t)),
                 {.t = t,
                  .grid = name(orphans_.grid),
                  .point = {orphans_.i, orphans_.j},
                  .position = {orphans_.x[0], orphans_.x[1]}});
}

}  // namespace fsi::grid
