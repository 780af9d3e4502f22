#include "common/grid/marching/hyperbolic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "common/core/component_major.hpp"
#include "common/core/failure.hpp"
#include "common/grid/geometry/quality.hpp"
#include "common/grid/marching/ghost_points.hpp"

namespace fsi::grid {

namespace {

std::size_t unknowns_of(const HyperbolicGrid& grid) {
  if (grid.points < 5 || grid.lines < 3) {
    throw UserMistake(fmt::format("grid \"{}\": {} points by {} lines are too few; write at least 5 by 3",
                                  grid.name, grid.points, grid.lines));
  }
  return static_cast<std::size_t>(grid.ends == Curve::closed ? grid.points - 1 : grid.points);
}

/// From 1, where a normal goes along the wall by half the square of what the foot's does or more, to 0, where it does not; with its
/// derivative. The square: beyond the shallow foot of a ramp normals are as shallow, and have nothing to turn away from.
double share_of_wall(double along, double foot) {
  const double full = 0.5 * foot * foot;
  if (along >= full) return 1;
  const double z = std::max(0.0, along / full);
  return z * z * (3 - 2 * z);
}

}  // namespace

HyperbolicMarch::HyperbolicMarch(HyperbolicGrid grid)
    : grid_(std::move(grid)),
      solver_(unknowns_of(grid_)),
      line_(solver_.rows().size()),
      arc_(line_.size()),
      smooth_(line_.size() + 2),
      concave_(line_.size() + 2),
      before_(line_.size() + 2) {
  if (!(grid_.spacing > 0 && grid_.growth > 0)) {
    throw UserMistake(fmt::format("grid \"{}\": spacing {} and growth {}; write positive numbers", grid_.name,
                                  grid_.spacing, grid_.growth));
  }
  if (grid_.curve != Side::bottom && grid_.curve != Side::top) {
    throw UserMistake(fmt::format("grid \"{}\": the curve is its {} side; choose bottom or top", grid_.name,
                                  name_of(grid_.curve)));
  }
  if (!(grid_.smoothing >= 0 && grid_.end_smoothing >= 0 && grid_.concave_smoothing >= 0 &&
        grid_.concave_onset >= 0) ||
      grid_.sweeps < 0 || grid_.blend < 0) {
    throw UserMistake(
        fmt::format("grid \"{}\": smoothing, sweeps and blend must not be negative", grid_.name));
  }
  if (!grid_.part.empty() && grid_.part.size() != static_cast<std::size_t>(grid_.points)) {
    throw std::logic_error(fmt::format("grid \"{}\": parts of the depth at {} places for {} points",
                                       grid_.name, grid_.part.size(), grid_.points));
  }
  for (std::optional<Vec2>& wall : grid_.walls) {
    if (wall && !(wall->norm() > 0)) {
      throw UserMistake(fmt::format("grid \"{}\": the direction of a wall has no length", grid_.name));
    }
    if (wall) wall->normalize();
  }
}

double HyperbolicMarch::depth() const {
  double depth = 0, d = grid_.spacing;
  for (int line = 1; line < grid_.lines; ++line, d *= grid_.growth) depth += d;
  return depth;
}

void HyperbolicMarch::march(std::span<const double> curve, FieldView x, double t) {
  const auto n = static_cast<std::size_t>(grid_.points);
  if (curve.size() != 2 * n || x.layout != layout()) {
    throw std::logic_error(fmt::format("grid \"{}\": a curve of {} numbers for {} points, a field of {} x {}",
                                       grid_.name, curve.size(), n, x.layout.n1, x.layout.n2));
  }
  for (int c = 0; c < 2; ++c) {
    std::copy_n(curve.begin() + (c == 0 ? 0 : grid_.points), grid_.points, x.row(c, row_of(0)));
    if (closed()) x(c, grid_.points - 1, row_of(0)) = x(c, 0, row_of(0));
  }
  concave_share_ = share_of_concave_points(x);
  double d = grid_.spacing;
  for (int line = 0; line + 1 < grid_.lines; ++line, d *= grid_.growth) {
    const int steps = steps_from(x, line, d);
    for (int k = 0; k < steps; ++k) step(x, row_of(line + (k > 0 ? 1 : 0)), row_of(line + 1), d / steps);
  }
  fill_ghosts(x, grid_.ends);
  try {
    check_cells(x, grid_.name, t);
  } catch (const Diverged& folded) {
    throw Diverged(folded.cause() + flat_on_wall(x, t), folded.place());
  }
}

/// Where the curve has come down to a wall on which it ends, or is as flat in the beginning, so that lines between
/// them have no room; where it has not, what to do once it has moved.
std::string HyperbolicMarch::flat_on_wall(ConstFieldView x, double t) const {
  for (std::size_t end = 0; end < 2; ++end) {
    if (closed() || !grid_.walls[end]) continue;
    const auto at = [&](int k) { return vector_at(x, end == 0 ? k : grid_.points - 1 - k, row_of(0)); };
    const Vec2 across((*grid_.walls[end])[1], -(*grid_.walls[end])[0]);
    double lowest = 0.1;  // height over way
    Vec2 there = at(0);
    for (int k = 1; k < grid_.points / 2; ++k) {
      const Vec2 way = at(k) - at(0);
      const double height = std::abs(across.dot(way)) / way.norm();
      if (height < lowest) lowest = height, there = at(k);
    }
    if (there == at(0)) continue;
    if (t == 0) {
      constexpr double degree = std::numbers::pi / 180;
      return fmt::format(": the curve up to ({:.6g}, {:.6g}) is only {:.2g} degrees above its wall", there[0],
                         there[1], std::asin(lowest) / degree);
    }
    return fmt::format(
        ": at ({:.6g}, {:.6g}) the curve has come down to the wall it stands on; let the body be stiffer, or "
        "the run end before",
        there[0], there[1]);
  }
  return t > 0 ? ": its curve bends too sharply there; a larger grid.factor holds sharper bends, a stiffer "
                 "body bends less"
               : "";
}

/// Steps in which the line after this one is reached, a distance d away; the first march decides. Where lines are farther
/// apart than the curve's points, these are close for the sake of a bend, and beside it they come closer from line to
/// line: there a step is no longer than about half of what the closest two are apart, for the curve may bend.
int HyperbolicMarch::steps_from(ConstFieldView x, int line, double d) {
  const auto at = static_cast<std::size_t>(line);
  if (at < steps_.size()) return steps_[at];
  double steps = std::max(1.0, std::round(d / mean_distance(x, row_of(0))));
  if (steps > 1) {
    measure_distances(x, row_of(line));
    steps *= std::max(1.0, std::round(2 * d / steps * longest_step()));
  }
  steps_.push_back(static_cast<int>(steps));
  return steps_.back();
}

/// Of a step of length 1 from the present line: the largest part of it in distances between points.
double HyperbolicMarch::longest_step() const {
  double longest = 0;
  for (std::size_t k = 0; k < arc_.size(); ++k)
    longest = std::max(longest, part(k) * smooth_[k + 1] / (arc_[k] * arc_[k]));
  return longest;
}

/// Mean distance of the points along row j.
double HyperbolicMarch::mean_distance(ConstFieldView x, int j) const {
  double sum = 0;
  for (int k = 1; k < grid_.points; ++k) sum += (vector_at(x, k, j) - vector_at(x, k - 1, j)).norm();
  return sum / (grid_.points - 1);
}

/// From row j to row j_next, which may be the same one.
void HyperbolicMarch::step(FieldView x, int j, int j_next, double d) {
  measure_distances(x, j);
  if (concave_share_ > 0) find_concave_places(x, j);
  if (!closed()) {
    keep_off_walls(x, j);
    blend_into_walls();
  }
  fill_rows(x, j, d);
  place(x, j, j_next);
}

/// Tangents, normals and distances along row j, by central differences, one-sided at open ends.
void HyperbolicMarch::measure(ConstFieldView x, int j) {
  const double towards = grid_.curve == Side::bottom ? 1.0 : -1.0;
  const int n = static_cast<int>(line_.size());
  for (int k = 0; k < n; ++k) {
    int before = k - 1, after = k + 1;
    if (closed() && k == 0) before = n - 1;
    if (!closed()) before = std::max(before, 0), after = std::min(after, n - 1);
    const Vec2 forward = vector_at(x, after, j) - vector_at(x, k, j),
               backward = vector_at(x, k, j) - vector_at(x, before, j);
    LinePoint& here = line_[static_cast<std::size_t>(k)];
    here.tangent = (forward + backward).normalized();
    here.normal = towards * Vec2(-here.tangent[1], here.tangent[0]);
    here.blend = 0;
    arc_[static_cast<std::size_t>(k)] = (forward.norm() + backward.norm()) / (after - before == 1 ? 1 : 2);
  }
}

/// The same, and the distances smoothed.
void HyperbolicMarch::measure_distances(ConstFieldView x, int j) {
  measure(x, j);
  std::ranges::copy(arc_, smooth_.begin() + 1);
  relax(smooth_);
}

/// Jacobi sweeps towards the mean of the neighbours.
void HyperbolicMarch::relax(std::vector<double>& line) {
  const std::size_t n = line_.size();
  for (int sweep = 0; sweep < grid_.sweeps; ++sweep) {
    line.front() = closed() ? line[n] : line[2];
    line.back() = closed() ? line[1] : line[n - 1];
    std::swap(line, before_);
    const double* from = before_.data();
    double* to = line.data();
#pragma omp simd
    for (std::size_t k = 1; k <= n; ++k) to[k] = 0.25 * (from[k - 1] + 2 * from[k] + from[k + 1]);
  }
}

/// The grid's depth over the radius of row j, smoothed as the
/// distances are: single points that stick out say little.
void HyperbolicMarch::find_concave_places(ConstFieldView x, int j) {
  const int n = static_cast<int>(line_.size());
  const double whole = depth();
  for (int k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    concave_[at + 1] = 0;
    if (!closed() && (k == 0 || k == n - 1)) continue;
    const Vec2 here = vector_at(x, k, j), before = vector_at(x, k == 0 ? n - 1 : k - 1, j);
    const Vec2 turn = (vector_at(x, k + 1, j) - here) - (here - before);
    concave_[at + 1] = whole * turn.dot(line_[at].normal) / (arc_[at] * arc_[at]);
  }
  relax(concave_);
}

/// From nothing at the onset to 1 where the depth is many times the radius; with the square of the excess
/// first, so that grid velocities do not jump.
double HyperbolicMarch::excess(std::size_t k) const {
  const double over = std::max(0.0, concave_[k + 1] - grid_.concave_onset);
  return over * over / (1 + over * over);
}

/// Exactly 0 where the curve bends too gently for its lines to meet, towards 1 with every point where they
/// would. The curve decides, for radii of later lines are smaller by the way gone.
double HyperbolicMarch::share_of_concave_points(ConstFieldView x) {
  if (!(grid_.concave_smoothing > 0)) return 0;
  measure(x, row_of(0));
  find_concave_places(x, row_of(0));
  double points = 0;
  for (std::size_t k = 0; k < line_.size(); ++k) points += excess(k);
  constexpr double few = 0.05;
  return points / (few + points);
}

/// What is added to eps at point k. eps D+D- x moves a line by eps arc^2 along its normal per unit of
/// curvature: in a step d as far as a front does whose speed grows with concave curvature by a length of
/// concave_smoothing times the depth, which flattens what a
/// front of constant speed would fold within that depth.
double HyperbolicMarch::concave_smoothing(std::size_t k, double d) const {
  if (!(concave_share_ > 0)) return 0;
  const double smooth = smooth_[k + 1];
  return grid_.concave_smoothing * concave_share_ * excess(k) * depth() * d / (smooth * smooth);
}

/// Near an end that slides on a wall, normals turn into the wall's direction, that towards which the foot's normal
/// points. Those that go less far along it than half the square of the foot's do so less, and those that turn away from
/// it, as beyond the tip of a flap, not at all.
void HyperbolicMarch::blend_into_walls() {
  for (std::size_t end = 0; end < 2; ++end) {
    const std::optional<Vec2>& direction = grid_.walls[end];
    if (!direction) continue;
    if (grid_.flat_ends[end]) {
      shift_along_curve(end);
      continue;
    }
    const auto at = [&](std::size_t k) { return end == 0 ? k : line_.size() - 1 - k; };
    const double foot = line_[at(0)].normal.dot(*direction);
    const Vec2 wall = foot < 0 ? Vec2(-*direction) : *direction;
    const std::size_t reach = std::min(static_cast<std::size_t>(grid_.blend), line_.size() / 2);
    for (std::size_t k = 0; k <= reach; ++k) {
      LinePoint& here = line_[at(k)];
      const double way = 1 - static_cast<double>(k) / static_cast<double>(reach + 1);
      const double blend = way * share_of_wall(here.normal.dot(wall), std::abs(foot));
      here.normal = ((1 - blend) * here.normal + blend * wall).normalized();
      here.blend = std::max(here.blend, blend);
    }
  }
}

/// A step along n + c t moves a line by as much as one along n, parallel to the curve, and its points by c
/// along it: with c the cotangent of the angle between curve and wall the end stays on the wall. From
/// there c falls to zero over a way on which the lines' points keep at least half their distance.
///
///     o---o---o---o---o---o   curve
///      `-_ `-_ `-. \  |   |
///     ====`-_=`-_=`.\=|===|=  wall
void HyperbolicMarch::shift_along_curve(std::size_t end) {
  const auto at = [&](std::size_t k) { return end == 0 ? k : line_.size() - 1 - k; };
  const LinePoint foot = line_[at(0)];
  const double sine = std::abs(foot.normal.dot(*grid_.walls[end]));
  const double shift = std::abs(foot.tangent.dot(*grid_.walls[end])) / std::max(sine, 0.05);
  const double way = 2 * depth() * shift;
  double gone = 0;
  for (std::size_t k = 0; k < line_.size() / 2 && gone < way; gone += arc_[at(k++)]) {
    LinePoint& here = line_[at(k)];
    const double share = 1 - gone / way;
    here.normal += (end == 0 ? shift : -shift) * share * here.tangent;
    here.blend = std::max(here.blend, share);
  }
}

/// Where the curve leans over the wall on which its end slides, lines would run into the wall: near the end a
/// normal descends over the whole depth by no more than half the point's height above the wall.
void HyperbolicMarch::keep_off_walls(ConstFieldView x, int j) {
  const double reach = 2 * depth();
  for (std::size_t end = 0; end < 2; ++end) {
    if (!grid_.walls[end] || grid_.flat_ends[end]) continue;
    const auto index = [&](std::size_t k) { return end == 0 ? k : line_.size() - 1 - k; };
    const auto position = [&](std::size_t k) { return vector_at(x, static_cast<int>(index(k)), j); };
    Vec2 up(-(*grid_.walls[end])[1], (*grid_.walls[end])[0]);
    if (up.dot(position(line_.size() / 2) - position(0)) < 0) up = -up;
    for (std::size_t k = 1; k < line_.size() / 2; ++k) {
      const double height = up.dot(position(k) - position(0));
      if (!(height < reach)) break;
      LinePoint& here = line_[index(k)];
      const double descent = -up.dot(here.normal), most = std::max(height, 0.0) / reach;
      if (descent <= most) continue;
      here.blend = 1 - most / descent;
      here.normal = (here.normal + (descent - most) * up).normalized();
    }
  }
}

/// [I + A D0 - eps D+D-] dx = d (smooth / arc) n + eps D+D- x, A the linearised normal.
void HyperbolicMarch::fill_rows(ConstFieldView x, int j, double d) {
  const int n = static_cast<int>(line_.size());
  for (int k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const LinePoint& here = line_[at];
    if (!closed() && (k == 0 || k == n - 1)) {
      fill_end(at, d);
      continue;
    }
    const int before = k == 0 ? n - 1 : k - 1;
    const double arc = arc_[at], smooth = smooth_[at + 1], reach = part(at) * d, step = reach * smooth / arc;
    const bool near_end = !closed() && (k == 1 || k == n - 2);
    const double eps = (near_end ? grid_.end_smoothing : grid_.smoothing) * std::min(1.0, reach / smooth) +
                       concave_smoothing(at, reach);
    const Mat2 turn = (0.5 * (1 - here.blend) * step / arc) * here.tangent * here.normal.transpose();
    LineRow& row = solver_.rows()[at];
    row.below = -turn - eps * Mat2::Identity();
    row.above = turn - eps * Mat2::Identity();
    row.diagonal = (1 + 2 * eps) * Mat2::Identity();
    row.right = step * here.normal +
                eps * (vector_at(x, k + 1, j) - 2 * vector_at(x, k, j) + vector_at(x, before, j));
  }
}

/// Open end: no step across the wall, along it the neighbour's
/// step; without a wall straight along the normal.
void HyperbolicMarch::fill_end(std::size_t k, double d) {
  LineRow& row = solver_.rows()[k];
  const std::optional<Vec2>& wall = grid_.walls[k == 0 ? 0 : 1];
  row.below = row.above = Mat2::Zero();
  if (!wall) {
    row.diagonal = Mat2::Identity();
    row.right = part(k) * d * smooth_[k + 1] / arc_[k] * line_[k].normal;
    return;
  }
  row.diagonal << -(*wall)[1], (*wall)[0], (*wall)[0], (*wall)[1];
  Mat2& inner = k == 0 ? row.above : row.below;
  inner.row(1) = -wall->transpose();
  row.right.setZero();
}

void HyperbolicMarch::place(FieldView x, int j, int j_next) {
  const std::span<const Vec2> step = closed() ? solver_.solve_closed() : solver_.solve_open();
  const std::size_t n = step.size();
  for (int c = 0; c < 2; ++c) {
    const double* from = x.row(c, j);
    double* to = x.row(c, j_next);
    const std::array<double, 2> ends{from[0], from[n - 1]};
    for (std::size_t k = 0; k < n; ++k) to[k] = from[k] + step[k][c];
    if (closed()) to[n] = to[0];
    for (std::size_t end = 0; end < 2; ++end) {
      const std::optional<Vec2>& wall = grid_.walls[end];
      if (closed() || !wall) continue;
      const std::size_t k = end == 0 ? 0 : n - 1;
      to[k] = ends[end] + (*wall)[c] * wall->dot(step[k]);
    }
  }
}

}  // namespace fsi::grid
