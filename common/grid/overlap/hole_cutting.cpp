#include "common/grid/overlap/hole_cutting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <ranges>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

/// Crossings that are nearer to each other are one touch [cells].
constexpr double touch = 1e-9;

Vec2 point(const CuttingCurve& curve, int k) {
  return {curve.x[k], curve.y[k]};
}

/// Unit normal of a segment of the curve, into the region behind it.
Vec2 normal_of(const CuttingCurve& curve, int segment) {
  const Vec2 way = (point(curve, segment + 1) - point(curve, segment)).normalized();
  return curve.domain_left ? Vec2(way[1], -way[0]) : Vec2(-way[1], way[0]);
}

/// First index k in [0, n] with a + k d >= value. Never inlined: the same value must give the same index
/// wherever it is asked for, and a compiler may round a + k d differently from place to place.
[[gnu::noinline]] int first_not_below(double value, double a, double d, int n) {
  int k = static_cast<int>(std::clamp(std::ceil((value - a) / d), 0.0, static_cast<double>(n)));
  while (k > 0 && a + (k - 1) * d >= value) --k;
  while (k < n && a + k * d < value) ++k;
  return k;
}

/// First index k in [0, n] with a + k d > value.
int first_above(double value, double a, double d, int n) {
  int k = first_not_below(value, a, d, n);
  while (k < n && a + k * d <= value) ++k;
  return k;
}

/// Where an open curve is led on, out of the grid: straight through the side its end lies on.
Vec2 beyond(const CartesianGrid& grid, const Vec2& end, const std::string& name, double t) {
  const double h = std::max(grid.dx(), grid.dy());
  const std::array<double, 4> distance{std::abs(end[0] - grid.x_a), std::abs(end[0] - grid.x_b),
                                       std::abs(end[1] - grid.y_a), std::abs(end[1] - grid.y_b)};
  const auto side = static_cast<int>(std::ranges::min_element(distance) - distance.begin());
  if (!(distance[static_cast<std::size_t>(side)] < 1e-3 * h)) {
    throw Diverged(fmt::format("its curve ends here, off the boundary of grid \"{}\"", grid.name),
                   {.t = t, .grid = name, .position = {end[0], end[1]}});
  }
  const double step = (side % 2 == 0 ? -2 : 2) * h;
  return end + (side < 2 ? Vec2(step, 0) : Vec2(0, step));
}

/// From the ends of a curve that stands on a wall a little way behind that wall, so that the points of the
/// wall between the ends are behind the curve.
Vec2 into_wall(const CartesianGrid& grid, const CuttingCurve& curve) {
  const Vec2 chord = point(curve, 0) - point(curve, curve.points - 1);
  const double part = 0.1 * std::min(grid.dx(), grid.dy()) / chord.norm();
  // The body is to the left of the way along the curve and
  // back over the chord, if the domain is to the right.
  return (curve.domain_left ? -part : part) * Vec2(chord[1], -chord[0]);
}

/// Twice the area inside a closed curve, positive if it runs counter-clockwise.
double area_of(const CuttingCurve& curve) {
  double area = 0;
  for (int k = 0; k + 1 < curve.points; ++k) {
    area += (curve.x[k] - curve.x[0]) * (curve.y[k + 1] - curve.y[0]) -
            (curve.x[k + 1] - curve.x[0]) * (curve.y[k] - curve.y[0]);
  }
  return area;
}

}  // namespace

void CurveCut::cut(const CartesianGrid& grid, const CuttingCurve& curve, const std::string& name, double t) {
  collect(grid, curve, name, t);
  sort_by_rows(grid.n2);
  drop_touches(touch * grid.dx());
  find_pinches(grid);
  find_hidden(grid, curve);
  find_starts(grid, curve, name, t);
}

/// Points on the curve, but for round-off, belong to the domain in every direction, so that a straight curve along a
/// row or column cuts it cleanly: what cuts is the curve moved by a billionth of a cell into the region behind it.
void CurveCut::withdraw(const CartesianGrid& grid, const CuttingCurve& curve) {
  const double farthest =
      std::max({std::abs(grid.x_a), std::abs(grid.x_b), std::abs(grid.y_a), std::abs(grid.y_b)});
  const double way =
      std::max(1e-9 * std::min(grid.dx(), grid.dy()), 4 * std::numeric_limits<double>::epsilon() * farthest);
  const int last = curve.points - 1;
  cutting_.clear();
  for (int k = 0; k <= last; ++k) {
    int before = k - 1, after = k;
    if (curve.ends == Curve::closed && (k == 0 || k == last)) before = last - 1, after = 0;
    const Vec2 sum = normal_of(curve, std::max(before, 0)) + normal_of(curve, std::min(after, last - 1));
    cutting_.emplace_back(point(curve, k) + way * sum.normalized());
  }
}

void CurveCut::collect(const CartesianGrid& grid, const CuttingCurve& curve, const std::string& name,
                       double t) {
  domain_left_ = curve.domain_left;
  segments_.clear();
  crossings_.clear();
  flips_.clear();
  withdraw(grid, curve);
  const Vec2 first = cutting_.front(), end = cutting_.back();
  const int last = curve.points - 1;
  const bool open = curve.ends == Curve::open && !curve.on_wall;
  if (open) add_segment(grid, beyond(grid, first, name, t), first, 0);
  for (std::size_t k = 0; k + 1 < cutting_.size(); ++k)
    add_segment(grid, cutting_[k], cutting_[k + 1], static_cast<int>(k));
  if (curve.on_wall) {
    const Vec2 dip = into_wall(grid, curve);
    add_segment(grid, end, end + dip, last - 1);
    add_segment(grid, end + dip, first + dip, last - 1);
    add_segment(grid, first + dip, first, 0);
  }
  if (open) add_segment(grid, end, beyond(grid, end, name, t), last - 1);
}

/// A row (and the left boundary) meets a segment where its ends lie on different sides, a point on it
/// counting as before it: what one segment of a curve misses at a common point, the next one has.
void CurveCut::add_segment(const CartesianGrid& grid, const Vec2& a, const Vec2& b, int segment) {
  segments_.push_back({a, b});
  const double low = std::min(a[1], b[1]), high = std::max(a[1], b[1]);
  const bool upward = b[1] > a[1];
  const int end = first_not_below(high, grid.y_a, grid.dy(), grid.n2);
  for (int j = first_not_below(low, grid.y_a, grid.dy(), grid.n2); j < end; ++j) {
    const double x = a[0] + (grid.y(j) - a[1]) * ((b[0] - a[0]) / (b[1] - a[1]));
    crossings_.push_back({.row = j,
                          .column = first_above(x, grid.x_a, grid.dx(), grid.n1),
                          .segment = segment,
                          .x = x,
                          .into_hole = upward == domain_left_});
  }
  if ((a[0] <= grid.x_a) == (b[0] <= grid.x_a)) return;
  const double y = a[1] + (grid.x_a - a[0]) * ((b[1] - a[1]) / (b[0] - a[0]));
  const bool rightward = b[0] > a[0];
  flips_.push_back(
      {.row = first_above(y, grid.y_a, grid.dy(), grid.n2), .y = y, .into_hole = rightward != domain_left_});
}

void CurveCut::sort_by_rows(int rows) {
  first_.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (const Crossing& crossing : crossings_) ++first_[static_cast<std::size_t>(crossing.row) + 1];
  for (std::size_t j = 1; j < first_.size(); ++j) first_[j] += first_[j - 1];
  sorted_.resize(crossings_.size());
  for (const Crossing& crossing : crossings_)
    sorted_[first_[static_cast<std::size_t>(crossing.row)]++] = crossing;
  std::shift_right(first_.begin(), first_.end(), 1);
  first_[0] = 0;
  for (int j = 0; j < rows; ++j) {
    const auto k = static_cast<std::size_t>(j);
    std::sort(sorted_.begin() + static_cast<std::ptrdiff_t>(first_[k]),
              sorted_.begin() + static_cast<std::ptrdiff_t>(first_[k + 1]),
              [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
  }
  std::ranges::sort(flips_, {}, &Flip::y);
}

/// Where a curve only touches a row, it crosses it twice at one place; which crossing comes first is decided
/// by round-off. Both go, there is nothing between them.
void CurveCut::drop_touches(double tolerance) {
  std::size_t kept = 0;
  for (std::size_t j = 0; j + 1 < first_.size(); ++j) {
    const std::size_t begin = first_[j], end = first_[j + 1], row = kept;
    for (std::size_t k = begin; k < end; ++k) {
      const Crossing& crossing = sorted_[k];
      const bool touches = kept > row && crossing.into_hole != sorted_[kept - 1].into_hole &&
                           crossing.x - sorted_[kept - 1].x < tolerance;
      if (touches) {
        --kept;
      } else {
        sorted_[kept++] = crossing;
      }
    }
    first_[j] = row;
  }
  first_.back() = kept;
  sorted_.resize(kept);
}

/// Two crossings, into a hole and out of it, without a point between them: of a row, then of a column.
void CurveCut::find_pinches(const CartesianGrid& grid) {
  pinches_.clear();
  for (int j = 0; j < grid.n2; ++j) {
    const std::span<const Crossing> row = crossings(j);
    for (std::size_t k = 1; k < row.size(); ++k) {
      const Crossing &in = row[k - 1], &out = row[k];
      if (!in.into_hole || out.into_hole || in.column != out.column) continue;
      if (in.column == 0 || in.column == grid.n1) continue;
      pinches_.push_back({.direction = 0,
                          .i = in.column,
                          .j = j,
                          .middle = (0.5 * (in.x + out.x) - grid.x(in.column - 1)) / grid.dx()});
    }
  }
  cross_columns(grid);
  for (std::size_t k = 1; k < of_columns_.size(); ++k) {
    const ColumnCrossing &in = of_columns_[k - 1], &out = of_columns_[k];
    if (in.column != out.column || !in.into_hole || out.into_hole) continue;
    const int row = first_above(in.y, grid.y_a, grid.dy(), grid.n2);
    if (row == 0 || row == grid.n2 || row != first_above(out.y, grid.y_a, grid.dy(), grid.n2)) continue;
    if (out.y - in.y < touch * grid.dy()) continue;
    pinches_.push_back({.direction = 1,
                        .i = in.column,
                        .j = row,
                        .middle = (0.5 * (in.y + out.y) - grid.y(row - 1)) / grid.dy()});
  }
}

/// A body that lies within a cell, so that no row or column meets it, counts as one between the points beside it.
void CurveCut::find_hidden(const CartesianGrid& grid, const CuttingCurve& curve) {
  if (!crossings_.empty() || !of_columns_.empty() || curve.ends == Curve::open) return;
  const bool body_inside = (area_of(curve) > 0) != curve.domain_left;
  const Vec2 cell((curve.x[0] - grid.x_a) / grid.dx(), (curve.y[0] - grid.y_a) / grid.dy());
  const int i = static_cast<int>(std::floor(cell[0])), j = static_cast<int>(std::lround(cell[1]));
  if (!body_inside || i < 0 || i + 1 >= grid.n1 || j < 0 || j >= grid.n2) return;
  pinches_.push_back({.direction = 0, .i = i + 1, .j = j, .middle = cell[0] - i});
}

/// As add_segment does for rows.
void CurveCut::cross_columns(const CartesianGrid& grid) {
  of_columns_.clear();
  for (const auto& [a, b] : segments_) {
    const bool rightward = b[0] > a[0];
    const int end = first_not_below(std::max(a[0], b[0]), grid.x_a, grid.dx(), grid.n1);
    for (int i = first_not_below(std::min(a[0], b[0]), grid.x_a, grid.dx(), grid.n1); i < end; ++i) {
      const double y = a[1] + (grid.x(i) - a[0]) * ((b[1] - a[1]) / (b[0] - a[0]));
      of_columns_.push_back({.column = i, .y = y, .into_hole = rightward != domain_left_});
    }
  }
  std::ranges::sort(of_columns_, [](const ColumnCrossing& a, const ColumnCrossing& b) {
    return a.column != b.column ? a.column < b.column : a.y < b.y;
  });
}

/// Does the body pass between points of the cell above and right of (i, j), or of one beside it?
bool CurveCut::is_pinched_near(int i, int j) const {
  return std::ranges::any_of(
      pinches_, [=](const Pinch& pinch) { return std::abs(pinch.i - i) <= 2 && std::abs(pinch.j - j) <= 2; });
}

/// Rows with crossings know what is before the first one; along the left boundary the side changes by flips only.
void CurveCut::find_starts(const CartesianGrid& grid, const CuttingCurve& curve, const std::string& name,
                           double t) {
  constexpr unsigned char unknown = 2;
  const int rows = grid.n2;
  starts_behind_.assign(static_cast<std::size_t>(rows), unknown);
  const auto start = [this](int j) -> unsigned char& { return starts_behind_[static_cast<std::size_t>(j)]; };
  for (int j = 0; j < rows; ++j) {
    if (!crossings(j).empty()) start(j) = crossings(j).front().into_hole ? 0 : 1;
  }
  // The first flip above a row and the last one below it say how it starts.
  for (const Flip& flip : flips_)
    if (flip.row > 0 && start(flip.row - 1) == unknown) start(flip.row - 1) = flip.into_hole ? 0 : 1;
  for (const Flip& flip : flips_ | std::views::reverse)
    if (flip.row < rows && start(flip.row) == unknown) start(flip.row) = flip.into_hole ? 1 : 0;
  // Between flips nothing changes: spread upwards, then downwards. Rows beside a flip are known already.
  for (int j = 1; j < rows; ++j) {
    if (start(j) == unknown && start(j - 1) != unknown) start(j) = depth(0, j - 1) > 0 ? 1 : 0;
  }
  for (int j = rows - 2; j >= 0; --j) {
    if (start(j) == unknown && start(j + 1) != unknown) start(j) = depth(0, j + 1) > 0 ? 1 : 0;
  }
  if (start(0) == unknown)
    std::ranges::fill(starts_behind_,
                      static_cast<unsigned char>(are_rows_behind(grid, curve, name, t) ? 1 : 0));
}

/// Are all rows behind a curve that meets none of them? The lowest crossing of a column tells, or which way it runs.
bool CurveCut::are_rows_behind(const CartesianGrid& grid, const CuttingCurve& curve, const std::string& name,
                               double t) const {
  for (std::size_t k = 0; k < of_columns_.size(); k += 2) {
    const ColumnCrossing& low = of_columns_[k];
    const bool touches = k + 1 < of_columns_.size() && of_columns_[k + 1].column == low.column &&
                         of_columns_[k + 1].y - low.y < touch * grid.dy();
    if (!touches) return !low.into_hole;
  }
  if (curve.ends == Curve::open && !curve.on_wall)
    throw Diverged("its curve meets no line of the background", {.t = t, .grid = name});
  return (area_of(curve) > 0) == curve.domain_left;
}

void CurveCut::append_holes(int row, int n1, std::vector<Interval>& parts) const {
  int behind = starts_behind_[static_cast<std::size_t>(row)], begin = 0;
  for (const Crossing& crossing : crossings(row)) {
    if (behind > 0 && crossing.column > begin) parts.push_back({begin, crossing.column});
    behind += crossing.into_hole ? 1 : -1;
    begin = crossing.column;
  }
  if (behind > 0 && begin < n1) parts.push_back({begin, n1});
}

const Crossing* CurveCut::nearest(int i, int j, int reach) const {
  const Crossing* best = nullptr;
  int best_distance = std::numeric_limits<int>::max();
  const int rows = static_cast<int>(first_.size()) - 1;
  for (int row = std::max(j - reach, 0); row <= std::min(j + reach, rows - 1); ++row) {
    for (const Crossing& crossing : crossings(row)) {
      const int distance = std::abs(2 * (crossing.column - i) - 1) + 2 * std::abs(row - j);
      if (distance < best_distance) best = &crossing, best_distance = distance;
    }
  }
  return best;
}

/// Crossings into the region behind the curve less those out of it, from outside up to column i of a row.
int CurveCut::depth(int i, int row) const {
  int sum = starts_behind_[static_cast<std::size_t>(row)];
  for (const Crossing& crossing : crossings(row)) {
    if (crossing.column <= i) sum += crossing.into_hole ? 1 : -1;
  }
  return sum;
}

bool CurveCut::behind(const CartesianGrid& grid, const Vec2& position) const {
  const int i = std::clamp(static_cast<int>((position[0] - grid.x_a) / grid.dx()), 0, grid.n1 - 1);
  const int j = std::clamp(first_above(position[1], grid.y_a, grid.dy(), grid.n2) - 1, 0, grid.n2 - 1);
  const int above = std::min(j + 1, grid.n2 - 1), right = std::min(i + 1, grid.n1 - 1);
  const bool corner = depth(i, j) > 0;
  const bool uniform = (depth(right, j) > 0) == corner && (depth(i, above) > 0) == corner &&
                       (depth(right, above) > 0) == corner;
  const Crossing* near = nearest(i, j, 2);
  const bool far = near == nullptr || std::abs(near->column - i) > 3;
  if (uniform && far && !is_pinched_near(i, j)) return corner;
  int sum = depth(0, j);
  for (const Flip& flip : flips_) {
    if (flip.y > grid.y(j) && flip.y <= position[1]) sum += flip.into_hole ? 1 : -1;
  }
  for (const auto& [a, b] : segments_) {
    const double low = std::min(a[1], b[1]), high = std::max(a[1], b[1]);
    if (!(low <= position[1] && position[1] < high)) continue;
    const double x = a[0] + (position[1] - a[1]) * ((b[0] - a[0]) / (b[1] - a[1]));
    if (x > grid.x_a && x <= position[0]) sum += (b[1] > a[1]) == domain_left_ ? 1 : -1;
  }
  return sum > 0;
}

}  // namespace fsi::grid
