#include "common/grid/shapes/spline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

struct Knots {
  std::vector<double> s;  ///< parameters, 0 .. 1
  std::vector<Vec2> x;    ///< points
  /// dx/ds on either side of each knot; the same but at corners.
  std::vector<Vec2> leaving, arriving;

  std::size_t piece(double at) const {
    const auto above = std::upper_bound(s.begin() + 1, s.end() - 1, at);
    return static_cast<std::size_t>(above - s.begin()) - 1;
  }
  Vec2 position(double at) const {
    const std::size_t k = piece(at);
    const double h = s[k + 1] - s[k], q = (at - s[k]) / h, p = 1 - q;
    return p * p * (1 + 2 * q) * x[k] + q * q * (1 + 2 * p) * x[k + 1] +
           h * p * q * (p * leaving[k] - q * arriving[k + 1]);
  }
  Vec2 slope(double at) const {
    const std::size_t k = piece(at);
    const double h = s[k + 1] - s[k], q = (at - s[k]) / h, p = 1 - q;
    return 6 * p * q / h * (x[k + 1] - x[k]) + p * (p - 2 * q) * leaving[k] +
           q * (q - 2 * p) * arriving[k + 1];
  }
};

/// Slope at s[at] of the cubic through the points at, at + step, at + 2 step, at + 3 step, or of the
/// polynomial through all points where they are fewer.
Vec2 end_slope(const Knots& knots, std::size_t at, std::ptrdiff_t step) {
  const auto index = [&](int k) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + k * step);
  };
  const int count = std::min(4, static_cast<int>(knots.x.size()));
  Vec2 slope = Vec2::Zero();
  for (int k = 1; k < count; ++k) {
    double weight = 1 / (knots.s[index(k)] - knots.s[at]);
    for (int m = 1; m < count; ++m) {
      if (m != k) weight *= (knots.s[index(m)] - knots.s[at]) / (knots.s[index(m)] - knots.s[index(k)]);
    }
    slope += weight * (knots.x[index(k)] - knots.x[at]);
  }
  return slope;
}

/// Row k of the condition that the second derivative is continuous: below, diagonal, above, right-hand side.
struct Row {
  double below, diagonal, above;
  Vec2 right;
};

Row continuity(double h_before, double h_after, const Vec2& rise_before, const Vec2& rise_after) {
  return {1 / h_before, 2 * (1 / h_before + 1 / h_after), 1 / h_after,
          3 * (rise_before / (h_before * h_before) + rise_after / (h_after * h_after))};
}

/// Tridiagonal elimination; the last row's solution comes first.
std::vector<Vec2> solve(std::vector<Row> rows) {
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const double factor = rows[k].below / rows[k - 1].diagonal;
    rows[k].diagonal -= factor * rows[k - 1].above;
    rows[k].right -= factor * rows[k - 1].right;
  }
  std::vector<Vec2> solution(rows.size());
  for (std::size_t k = rows.size(); k-- > 0;) {
    Vec2 right = rows[k].right;
    if (k + 1 < rows.size()) right -= rows[k].above * solution[k + 1];
    solution[k] = right / rows[k].diagonal;
  }
  return solution;
}

std::vector<Row> rows_of(const Knots& knots, Curve ends) {
  const std::size_t n = knots.x.size();
  std::vector<Row> rows(n);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    rows[k] = continuity(knots.s[k] - knots.s[k - 1], knots.s[k + 1] - knots.s[k],
                         knots.x[k] - knots.x[k - 1], knots.x[k + 1] - knots.x[k]);
  }
  if (ends == Curve::open) {
    rows[0] = {0, 1, 0, end_slope(knots, 0, 1)};
    rows[n - 1] = {0, 1, 0, end_slope(knots, n - 1, -1)};
  } else {
    rows[0] = continuity(knots.s[n - 1] - knots.s[n - 2], knots.s[1] - knots.s[0],
                         knots.x[n - 1] - knots.x[n - 2], knots.x[1] - knots.x[0]);
  }
  return rows;
}

/// Closed: tangents 0 .. n - 2 with a coupling across the seam, split off as a correction of rank one.
std::vector<Vec2> closed_tangents(const Knots& knots) {
  std::vector<Row> rows = rows_of(knots, Curve::closed);
  rows.pop_back();
  const double corner_first = rows.front().below, corner_last = rows.back().above,
               shift = -rows.front().diagonal;
  rows.front().diagonal -= shift;
  rows.back().diagonal -= corner_first * corner_last / shift;
  std::vector<Vec2> tangents = solve(rows);
  for (Row& row : rows) row.right.setZero();
  rows.front().right.setConstant(shift);
  rows.back().right.setConstant(corner_last);
  const std::vector<Vec2> correction = solve(rows);
  const double c = correction.front()[0] + corner_first / shift * correction.back()[0];
  const Vec2 part = (tangents.front() + corner_first / shift * tangents.back()) / (1 + c);
  for (std::size_t k = 0; k < tangents.size(); ++k) tangents[k] -= correction[k].cwiseProduct(part);
  tangents.push_back(tangents.front());
  return tangents;
}

/// By how much the way from a to c turns at b, 0 .. pi.
double turn_at(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 in = b - a, out = c - b;
  return std::abs(std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out)));
}

/// Points of the curve, a closed one's first one again at the end.
std::vector<Vec2> completed(std::vector<Vec2> points, Curve ends) {
  if (ends == Curve::open || points.size() < 2) return points;
  const double seam = (points.back() - points.front()).norm();
  const bool given_again = seam < 1e-9 * (points[1] - points.front()).norm();
  if (given_again) points.pop_back();
  points.push_back(points.front());
  return points;
}

/// The points at which the curve turns by more than an angle; of a closed one, which begins at the first of
/// them afterwards, without that.
std::vector<std::size_t> corners_of(std::vector<Vec2>& points, Curve ends, double angle) {
  const std::size_t n = points.size();
  if (ends == Curve::closed && n > 3) {
    points.pop_back();
    for (std::size_t k = 0; k < n - 1; ++k) {
      if (!(turn_at(points[(k + n - 2) % (n - 1)], points[k], points[(k + 1) % (n - 1)]) > angle)) continue;
      std::ranges::rotate(points, points.begin() + static_cast<std::ptrdiff_t>(k));
      break;
    }
    points.push_back(points.front());
  }
  std::vector<std::size_t> corners;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    if (turn_at(points[k - 1], points[k], points[k + 1]) > angle) corners.push_back(k);
  }
  return corners;
}

Knots knots_of(std::vector<Vec2> points) {
  Knots knots{std::vector<double>(points.size(), 0.0), std::move(points), {}, {}};
  for (std::size_t k = 1; k < knots.x.size(); ++k) {
    const double chord = (knots.x[k] - knots.x[k - 1]).norm();
    if (!(chord > 0)) {
      throw UserMistake(
          fmt::format("points {} and {} of a spline coincide at ({:.6g}, {:.6g}): leave one of them out", k,
                      k + 1, knots.x[k][0], knots.x[k][1]));
    }
    knots.s[k] = knots.s[k - 1] + chord;
  }
  for (double& s : knots.s) s /= knots.s.back();
  return knots;
}

/// The tangents of an open spline through some of the knots.
std::vector<Vec2> open_tangents(const Knots& knots, std::size_t first, std::size_t last) {
  const auto part = [&](const auto& values) {
    return std::vector(values.begin() + static_cast<std::ptrdiff_t>(first),
                       values.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  };
  const Knots own{part(knots.s), part(knots.x), {}, {}};
  return solve(rows_of(own, Curve::open));
}

/// Stretches between corners, each an open spline.
void find_open_tangents(Knots& knots, const std::vector<std::size_t>& corners) {
  std::vector<std::size_t> ends = corners;
  ends.insert(ends.begin(), 0);
  ends.push_back(knots.x.size() - 1);
  knots.leaving.resize(knots.x.size());
  knots.arriving.resize(knots.x.size());
  for (std::size_t m = 0; m + 1 < ends.size(); ++m) {
    const std::vector<Vec2> tangents = open_tangents(knots, ends[m], ends[m + 1]);
    for (std::size_t k = 0; k < tangents.size(); ++k) {
      if (ends[m] + k < ends[m + 1]) knots.leaving[ends[m] + k] = tangents[k];
      if (k > 0) knots.arriving[ends[m] + k] = tangents[k];
    }
  }
}

void check_count(std::size_t points, Curve ends, bool corners) {
  const std::size_t fewest = corners ? 3 : 4,
                    listed = points - static_cast<std::size_t>(ends == Curve::closed);
  if (listed >= fewest) return;
  throw UserMistake(fmt::format("a spline through {} points; write at least {}", listed, fewest));
}

}  // namespace

PlaneCurve spline(std::vector<Vec2> points, Curve ends, double corner_angle) {
  points = completed(std::move(points), ends);
  const bool looks_for_corners = corner_angle < std::numbers::pi;
  check_count(points.size(), ends, looks_for_corners);
  std::vector<std::size_t> corners;
  bool starts_at_corner = false;
  if (looks_for_corners) {
    corners = corners_of(points, ends, corner_angle);
    const std::size_t n = points.size();
    starts_at_corner = ends == Curve::closed && turn_at(points[n - 2], points[0], points[1]) > corner_angle;
  }
  Knots knots = knots_of(std::move(points));
  if (ends == Curve::closed && !starts_at_corner) {
    knots.leaving = knots.arriving = closed_tangents(knots);
  } else {
    find_open_tangents(knots, corners);
  }
  std::vector<double> places;
  if (starts_at_corner) places.push_back(0);
  for (const std::size_t k : corners) places.push_back(knots.s[k]);
  const auto shared = std::make_shared<const Knots>(std::move(knots));
  return {.ends = ends,
          .position = [shared](double s) { return shared->position(s); },
          .slope = [shared](double s) { return shared->slope(s); },
          .corners = std::move(places)};
}

}  // namespace fsi::grid
