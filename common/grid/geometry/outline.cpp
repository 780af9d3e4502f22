#include "common/grid/geometry/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/core/component_major.hpp"

namespace fsi::grid {

namespace {

/// A segment of one of the curves that are looked at together.
struct Segment {
  Vec2 from, to;
  std::size_t index;
  int curve;

  double left() const { return std::min(from[0], to[0]); }
  double right() const { return std::max(from[0], to[0]); }
  double low() const { return std::min(from[1], to[1]); }
  double high() const { return std::max(from[1], to[1]); }
};

void append(std::span<const double> x, int curve, std::vector<Segment>& segments) {
  for (std::size_t k = 0; k + 1 < x.size() / 2; ++k)
    segments.push_back({.from = vector_at(x, k), .to = vector_at(x, k + 1), .index = k, .curve = curve});
}

/// Touching counts, so that crossings at a point of a curve are not missed.
bool meet(const Segment& a, const Segment& b) {
  if (a.low() > b.high() || b.low() > a.high() || a.left() > b.right() || b.left() > a.right()) return false;
  const Vec2 along_a = a.to - a.from, along_b = b.to - b.from;
  return cross(along_a, b.from - a.from) * cross(along_a, b.to - a.from) <= 0 &&
         cross(along_b, a.from - b.from) * cross(along_b, a.to - b.from) <= 0;
}

Vec2 common_point(const Segment& a, const Segment& b) {
  const double area = cross(a.to - a.from, b.to - b.from);
  if (area == 0) return 0.5 * (a.to + b.from);  // on one line
  const double part = cross(b.from - a.from, b.to - b.from) / area;
  return a.from + part * (a.to - a.from);
}

/// The first pair, from left to right, that `counts` and meets.
template <typename Counts>
std::optional<Intersection> first_meeting(std::vector<Segment>& segments, const Counts& counts) {
  std::ranges::sort(segments, {}, &Segment::left);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Segment& a = segments[k];
    for (std::size_t l = k + 1; l < segments.size() && segments[l].left() <= a.right(); ++l) {
      const Segment& b = segments[l];
      if (!counts(a, b) || !meet(a, b)) continue;
      return Intersection{
          .a = std::min(a.index, b.index), .b = std::max(a.index, b.index), .x = common_point(a, b)};
    }
  }
  return std::nullopt;
}

/// The point of a segment nearest to a position.
Vec2 nearest_on(const Vec2& from, const Vec2& to, const Vec2& position) {
  const double length2 = (to - from).squaredNorm();
  if (length2 == 0) return from;
  return from + std::clamp((position - from).dot(to - from) / length2, 0.0, 1.0) * (to - from);
}

/// The point of a curve nearest to a position.
Vec2 nearest_on(std::span<const double> curve, const Vec2& position) {
  Vec2 best = vector_at(curve, 0);
  for (std::size_t k = 0; k + 1 < curve.size() / 2; ++k) {
    const Vec2 x = nearest_on(vector_at(curve, k), vector_at(curve, k + 1), position);
    if ((x - position).squaredNorm() < (best - position).squaredNorm()) best = x;
  }
  return best;
}

}  // namespace

std::optional<Intersection> self_crossing(std::span<const double> x, Curve ends) {
  std::vector<Segment> segments;
  append(x, 0, segments);
  const std::size_t last = segments.size() - 1;
  return first_meeting(segments, [&](const Segment& a, const Segment& b) {
    const std::size_t low = std::min(a.index, b.index), high = std::max(a.index, b.index);
    const bool neighbours = high - low == 1 || (ends == Curve::closed && low == 0 && high == last);
    return !neighbours;
  });
}

std::optional<Intersection> crossing_of(std::span<const double> a, std::span<const double> b) {
  std::vector<Segment> segments;
  append(a, 0, segments);
  append(b, 1, segments);
  return first_meeting(segments, [](const Segment& s, const Segment& t) { return s.curve != t.curve; });
}

bool encloses(std::span<const double> outline, const Vec2& position) {
  const std::size_t n = outline.size() / 2;
  bool inside = false;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 a = vector_at(outline, k) - position, b = vector_at(outline, (k + 1) % n) - position;
    if ((a[1] > 0) == (b[1] > 0)) continue;
    if ((cross(a, b) > 0) == (b[1] > a[1])) inside = !inside;
  }
  return inside;
}

double distance_to(std::span<const double> curve, const Vec2& position) {
  return (nearest_on(curve, position) - position).norm();
}

Gap gap_between(std::span<const double> a, std::span<const double> b) {
  Gap gap{.distance = std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < a.size() / 2; ++k) {
    const double distance = distance_to(b, vector_at(a, k));
    if (distance < gap.distance) gap = {.distance = distance, .x = vector_at(a, k)};
  }
  for (std::size_t k = 0; k < b.size() / 2; ++k) {
    const Vec2 x = nearest_on(a, vector_at(b, k));
    const double distance = (x - vector_at(b, k)).norm();
    if (distance < gap.distance) gap = {.distance = distance, .x = x};
  }
  return gap;
}

Bend sharpest_bend(std::span<const double> x, Curve ends, double turn, std::span<const int> corners) {
  const std::size_t n = x.size() / 2;
  Bend bend{.radius = std::numeric_limits<double>::infinity()};
  for (std::size_t k = ends == Curve::closed ? 0 : 1; k + 1 < n; ++k) {
    if (std::ranges::find(corners, static_cast<int>(k)) != corners.end()) continue;
    const Vec2 before = vector_at(x, k == 0 ? n - 2 : k - 1), here = vector_at(x, k),
               after = vector_at(x, k + 1);
    const double area = turn * cross(here - before, after - here);
    if (!(area > 0)) continue;
    // The circle through three points: the product of the sides over four times the triangle's area.
    const double radius =
        (here - before).norm() * (after - here).norm() * (after - before).norm() / (2 * area);
    if (radius < bend.radius) bend = {.radius = radius, .x = here};
  }
  return bend;
}

namespace {

/// How far from `from` along `direction` a ray on a curve's left (`side` = 1) or right (-1) leaves it through
/// the segment a, b; infinite where it does not.
double leaving(const Vec2& from, const Vec2& direction, const Vec2& a, const Vec2& b, double side) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const Vec2 along = b - a, to_a = a - from;
  const double slope = cross(direction, along);
  if (!(side * slope > 0)) return never;  // along the curve next to `from` it is the other way round
  const double distance = cross(to_a, along) / slope, part = cross(to_a, direction) / slope;
  return distance > 0 && part >= 0 && part <= 1 ? distance : never;
}

}  // namespace

Gap narrowest(std::span<const double> x, Curve ends, double side) {
  const std::size_t n = x.size() / 2;
  Gap gap{.distance = std::numeric_limits<double>::infinity()};
  for (std::size_t k = ends == Curve::closed ? 0 : 1; k + 1 < n; ++k) {
    const Vec2 before = vector_at(x, k == 0 ? n - 2 : k - 1), here = vector_at(x, k),
               after = vector_at(x, k + 1);
    const Vec2 normal = side * Vec2(before[1] - after[1], after[0] - before[0]).normalized();
    for (std::size_t m = 0; m + 1 < n; ++m) {
      if (m == k || m + 1 == k || (k == 0 && m + 2 == n)) continue;  // the point's own segments
      const double distance = leaving(here, normal, vector_at(x, m), vector_at(x, m + 1), side);
      if (distance < gap.distance) gap = {.distance = distance, .x = here};
    }
  }
  return gap;
}

}  // namespace fsi::grid
