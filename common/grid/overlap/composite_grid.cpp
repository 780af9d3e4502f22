#include "common/grid/overlap/composite_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

/// Smallest box around points.
struct Box {
  double x_a, x_b, y_a, y_b;

  explicit Box(ConstFieldView x) : x_a(x(0, 0, 0)), x_b(x_a), y_a(x(1, 0, 0)), y_b(y_a) {
    for (int j = 0; j < x.layout.n2; ++j) {
      const double *x1 = x.row(0, j), *x2 = x.row(1, j);
      double left = x_a, right = x_b, low = y_a, high = y_b;
#pragma omp simd reduction(min : left, low) reduction(max : right, high)
      for (int i = 0; i < x.layout.n1; ++i) {
        left = std::min(left, x1[i]);
        right = std::max(right, x1[i]);
        low = std::min(low, x2[i]);
        high = std::max(high, x2[i]);
      }
      x_a = left, x_b = right, y_a = low, y_b = high;
    }
  }
};

bool inside(const CartesianGrid& grid, double left, double right, double low, double high) {
  const double slack1 = rounding * grid.dx(), slack2 = rounding * grid.dy();
  return left >= grid.x_a - slack1 && right <= grid.x_b + slack1 && low >= grid.y_a - slack2 &&
         high <= grid.y_b + slack2;
}

void check(const BodyFittedGrid& body, int layers) {
  if (body.n1 < 5 || body.n2 < layers + 3) {
    throw UserMistake(fmt::format("grid \"{}\": {} x {} points are too few; write at least 5 x {}", body.name,
                                  body.n1, body.n2, layers + 3));
  }
  if (body.curve != Side::bottom && body.curve != Side::top) {
    throw UserMistake(fmt::format("grid \"{}\": the curve is its {} side; choose bottom or top", body.name,
                                  name_of(body.curve)));
  }
}

}  // namespace

CompositeGrid::CompositeGrid(CartesianGrid background, std::vector<BodyFittedGrid> bodies,
                             OverlapOptions options)
    : background_(std::move(background)),
      bodies_(std::move(bodies)),
      options_(options),
      cuts_(bodies_.size()) {
  if (background_.n1 < 5 || background_.n2 < 5 || !(background_.dx() > 0 && background_.dy() > 0)) {
    throw UserMistake(fmt::format(
        "grid \"{}\": {} x {} points on [{}, {}] x [{}, {}]; write at least 5 x 5 and ends in order",
        background_.name, background_.n1, background_.n2, background_.x_a, background_.x_b, background_.y_a,
        background_.y_b));
  }
  if (options_.layers < 1) throw UserMistake("layers of interpolation points; write 1 or more");
  const auto add = [this](int n1, int n2, bool closed) {
    const RowRange all{0, n2};
    parts_.push_back(
        {.layout = Layout(n1, n2), .rows = {{n1, closed}, n2, all, all}, .now = {}, .before = {}});
  };
  add(background_.n1, background_.n2, false);
  for (const BodyFittedGrid& grid : bodies_) {
    check(grid, options_.layers);
    add(grid.n1, grid.n2, grid.ends == Curve::closed);
  }
  for (std::vector<InterpolationList>* lists : {&interpolation_, &exposed_}) {
    for (int target = 0; target < grids(); ++target) {
      for (int k = 0; k < 4 * grids(); ++k) {
        lists->push_back({.target_grid = target,
                          .donor_grid = k / 4,
                          .width = k % 4 < 2 ? 3 : 2,
                          .implicit = k % 2 == 1,
                          .target = {},
                          .donor = {},
                          .weight = {}});
      }
    }
  }
}

InterpolationList& CompositeGrid::list_for(std::vector<InterpolationList>& lists, int target,
                                           const Stencil& stencil) {
  const int k =
      4 * (target * grids() + stencil.grid) + (stencil.width == 3 ? 0 : 2) + (stencil.implicit ? 1 : 0);
  return lists[static_cast<std::size_t>(k)];
}

PointKind CompositeGrid::kind(int grid, int i, int j) const {
  if (discretised(grid).contains(i, j)) return PointKind::discretised;
  return valid(grid).contains(i, j) ? PointKind::interpolated : PointKind::unused;
}

void CompositeGrid::connect(std::span<const ConstFieldView> x, double t) {
  positions_.clear();
  for (const ConstFieldView& grid : x) positions_.push_back({grid, grid});
  connect_now(t);
  for (InterpolationList& list : exposed_) list.clear();
  // Lists grow and shrink a little from step to step; room
  // for twice as many keeps the time loop from allocating.
  for (InterpolationList& list : interpolation_) list.reserve(2 * list.size() + 64);
}

void CompositeGrid::update(std::span<const GridPositions> x, double t) {
  positions_.assign(x.begin(), x.end());
  for (Part& p : parts_) std::swap(p.now, p.before);
  connect_now(t);
  find_exposed();
  report_orphans(t, "uncovered by a motion of more than a cell");
}

void CompositeGrid::connect_now(double t) {
  for (int grid = 1; grid < grids(); ++grid) {
    cuts_[static_cast<std::size_t>(grid) - 1].cut(background_, curve_of(grid), name(grid), t);
  }
  cut_background();
  for (int grid = 1; grid < grids(); ++grid) cut_body(grid, t);
  constexpr int all_lines = std::numeric_limits<int>::max();
  connect_all(options_.trim, all_lines, Orphaned::stop_at_first);
  if (options_.trim && orphans_.count > 0) connect_all(false, all_lines, Orphaned::stop_at_first);
  if (orphans_.count > 0) connect_with_fewer_lines();
  report_orphans(t, "without a donor in any other grid: the overlap is too small");
  solve_for_implicit(t);
  for (const InterpolationList& list : interpolation_) {
    counts_.interpolated += list.size();
    if (list.width == 2) counts_.width_2 += list.size();
    if (list.implicit) counts_.implicit += list.size();
  }
  note_worst(t);
}

CuttingCurve CompositeGrid::curve_of(int grid) const {
  const ConstFieldView x = positions_[static_cast<std::size_t>(grid) - 1].x;
  const int j = curve_below(grid) ? 0 : body(grid).n2 - 1;
  return {.x = x.row(0, j),
          .y = x.row(1, j),
          .points = body(grid).n1,
          .ends = body(grid).ends,
          .domain_left = curve_below(grid),
          .on_wall = body(grid).wall > 0};
}

void CompositeGrid::cut_background() {
  find_pinched();
  RowSets& holes = part(0).now.holes;
  holes.clear();
  auto pinched = pinched_.begin();
  for (int j = 0; j < background_.n2; ++j) {
    intervals_.clear();
    for (const CurveCut& cut : cuts_) cut.append_holes(j, background_.n1, intervals_);
    const auto first = pinched;
    for (; pinched != pinched_.end() && pinched->j == j; ++pinched)
      intervals_.push_back({pinched->i, pinched->i + 1});
    if (cuts_.size() > 1 || pinched != first) unite(intervals_);
    holes.append(intervals_);
    holes.end_row();
  }
}

/// Points at most half a cell from the middle of a body where nothing else keeps the points on both sides of it apart.
void CompositeGrid::find_pinched() {
  constexpr double half = 0.5 + 1e-6;  // both, where it is between them
  pinched_.clear();
  for (int grid = 1; grid < grids(); ++grid) {
    for (const Pinch& pinch : cuts_[static_cast<std::size_t>(grid) - 1].pinches()) {
      if (is_kept_apart(pinch)) continue;
      const bool along = pinch.direction == 0;
      if (pinch.middle <= half)
        pinched_.push_back(
            {.j = along ? pinch.j : pinch.j - 1, .i = along ? pinch.i - 1 : pinch.i, .grid = grid});
      if (pinch.middle >= 1 - half) pinched_.push_back({.j = pinch.j, .i = pinch.i, .grid = grid});
    }
  }
  std::ranges::sort(pinched_);
}

/// Are all points whose stencils reach across the body interpolated anyway? So it is where a point behind the curve is near, as
/// at the top of a round body.
bool CompositeGrid::is_kept_apart(const Pinch& pinch) {
  for (int k = -options_.layers; k < options_.layers; ++k) {
    const int i = pinch.direction == 0 ? pinch.i + k : pinch.i,
              j = pinch.direction == 0 ? pinch.j : pinch.j + k;
    const bool there = i >= 0 && i < background_.n1 && j >= 0 && j < background_.n2;
    if (there && !is_near_hole(i, j)) return false;
  }
  return true;
}

/// Is a point behind a curve within the reach of the stencil of point (i, j)?
bool CompositeGrid::is_near_hole(int i, int j) {
  const int reach = options_.layers;
  for (int row = std::max(j - reach, 0); row <= std::min(j + reach, background_.n2 - 1); ++row) {
    intervals_.clear();
    for (const CurveCut& cut : cuts_) cut.append_holes(row, background_.n1, intervals_);
    for (const Interval& hole : intervals_) {
      if (hole.begin <= i + reach && hole.end > i - reach) return true;
    }
  }
  return false;
}

/// Is the point of the background that is nearest to a position unused for the thin body of `grid`?
bool CompositeGrid::is_pinched(const Vec2& x, int grid) const {
  const auto i = static_cast<int>(std::lround((x[0] - background_.x_a) / background_.dx())),
             j = static_cast<int>(std::lround((x[1] - background_.y_a) / background_.dy()));
  return std::ranges::binary_search(pinched_, PinchedPoint{.j = j, .i = i, .grid = grid});
}

/// Do background points behind the curve of `other` lie among or near the points of `grid`?
bool CompositeGrid::touches(int grid, int other) {
  const Box box(positions_[static_cast<std::size_t>(grid) - 1].x);
  const CellPosition low = find_cell(background_, {box.x_a, box.y_a}),
                     high = find_cell(background_, {box.x_b, box.y_b});
  constexpr int margin = 2;
  for (int j = std::max(low.j - margin, 0); j < std::min(high.j + 2 + margin, background_.n2); ++j) {
    intervals_.clear();
    cuts_[static_cast<std::size_t>(other) - 1].append_holes(j, background_.n1, intervals_);
    for (const Interval& hole : intervals_) {
      if (hole.begin <= high.i + 1 + margin && hole.end > low.i - margin) return true;
    }
  }
  return std::ranges::any_of(pinched_, [&](const PinchedPoint& point) {
    return point.grid == other && point.j >= low.j - margin && point.j <= high.j + 1 + margin &&
           point.i >= low.i - margin && point.i <= high.i + 1 + margin;
  });
}

/// The curve of a grid bounds the domain: without its points nobody would know that it is there.
void CompositeGrid::expect_curve_inside(int grid, double t) const {
  const CuttingCurve curve = curve_of(grid);
  for (int k = curve.ends == Curve::open ? 1 : 0; k < curve.points - 1; ++k) {
    const Vec2 x(curve.x[k], curve.y[k]);
    if (inside(background_, x[0], x[0], x[1], x[1])) continue;
    throw Diverged(
        fmt::format("the curve of {} has left the rectangle of \"{}\" here; let the run end "
                    "before, or, where it has not gone through a wall, the rectangle reach farther",
                    body(grid).of.empty() ? "this grid" : body(grid).of, background_.name),
        {.t = t, .grid = name(grid), .position = {x[0], x[1]}});
  }
}

/// Holes of a body-fitted grid: points outside the background, or behind the curve of another grid.
void CompositeGrid::cut_body(int grid, double t) {
  const ConstFieldView x = positions_[static_cast<std::size_t>(grid) - 1].x;
  const Box box(x);
  const bool sticks_out = !inside(background_, box.x_a, box.x_b, box.y_a, box.y_b);
  if (sticks_out) expect_curve_inside(grid, t);
  cutters_.clear();
  for (int other = 1; other < grids(); ++other) {
    if (other != grid && touches(grid, other)) cutters_.push_back(other);
  }
  RowSets& holes = part(grid).now.holes;
  holes.clear();
  for (int j = 0; j < x.layout.n2; ++j) {
    if (sticks_out || !cutters_.empty()) {
      intervals_.clear();
      for (int i = 0; i < x.layout.n1; ++i) {
        // The ends stand on their wall, and round-off puts them behind it.
        const bool end = i == 0 || i == x.layout.n1 - 1;
        if (cut_away({x(0, i, j), x(1, i, j)}, end ? body(grid).wall : 0)) intervals_.push_back({i, i + 1});
      }
      unite(intervals_);
      holes.append(intervals_);
    }
    holes.end_row();
  }
}

/// Is a position out of the background, or behind a curve other than that of grid `spared`?
bool CompositeGrid::cut_away(const Vec2& x, int spared) const {
  if (!inside(background_, x[0], x[0], x[1], x[1])) return true;
  return std::ranges::any_of(cutters_, [&](int other) {
    return other != spared &&
           (cuts_[static_cast<std::size_t>(other) - 1].behind(background_, x) || is_pinched(x, other));
  });
}

void CompositeGrid::interpolate(std::span<const FieldView> fields,
                                std::span<const InterpolationList> lists) const {
  for (const InterpolationList& list : lists) {
    if (!list.implicit) apply(list, fields);
  }
  if (implicit_) implicit_->solve(lists, fields);
}

void CompositeGrid::fill_exposed(std::span<const FieldView> fields,
                                 std::span<const InterpolationList> lists) {
  for (const InterpolationList& list : lists) apply(list, fields);
}

}  // namespace fsi::grid
