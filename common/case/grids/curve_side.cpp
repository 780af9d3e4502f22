#include "common/case/grids/curve_side.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi {

namespace {

/// Twice the area to the left of a polygon's direction, closed by a straight line.
double signed_area(const std::vector<double>& x) {
  const std::size_t n = x.size() / 2;
  double area = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    area += x[k] * x[n + next] - x[next] * x[n + k];
  }
  return area;
}

/// The corners of a rectangle, counter-clockwise, and how far along its rim a point of a side is (0 .. 4).
struct Rim {
  double x_a, x_b, y_a, y_b;

  Vec2 corner(int k) const {
    const int place = k % 4;
    return {place == 1 || place == 2 ? x_b : x_a, place >= 2 ? y_b : y_a};
  }
  double place_of(const Vec2& x, Side side) const {
    const double part1 = (x[0] - x_a) / (x_b - x_a), part2 = (x[1] - y_a) / (y_b - y_a);
    switch (side) {
      case Side::bottom:
        return part1;
      case Side::right:
        return 1 + part2;
      case Side::top:
        return 3 - part1;
      default:
        return 4 - part2;
    }
  }
};

/// Area of the part of a rectangle to the left of a curve between two of its sides, in parts of the whole.
double part_to_the_left(const CurveSpec& curve, const Rim& rim) {
  const auto n = static_cast<std::size_t>(curve.points());
  const Vec2 first(curve.x[0], curve.x[n]), last(curve.x[n - 1], curve.x[2 * n - 1]);
  const double from = rim.place_of(last, (*curve.walls)[1]);
  double to = rim.place_of(first, (*curve.walls)[0]);
  if (to < from) to += 4;
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < n; ++k) points.emplace_back(curve.x[k], curve.x[n + k]);
  for (int k = static_cast<int>(std::floor(from)) + 1; k < to; ++k) points.push_back(rim.corner(k));
  double area = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec2 &a = points[k], &b = points[(k + 1) % points.size()];
    area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
  }
  return area / ((rim.x_b - rim.x_a) * (rim.y_b - rim.y_a));
}

void reverse_direction(std::vector<double>& x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::reverse(x.begin(), middle);
  std::reverse(middle, x.end());
}

}  // namespace

void put_body_to_the_left(CurveSpec& curve, const std::optional<std::array<double, 4>>& rectangle) {
  const bool between_sides =
      curve.on.empty() && curve.walls && curve.walls->front() != curve.walls->back() && rectangle;
  const auto backwards = [&] {
    if (!between_sides) return signed_area(curve.x) < 0;
    const auto [x_a, x_b, y_a, y_b] = *rectangle;
    const double part = part_to_the_left(curve, {x_a, x_b, y_a, y_b});
    constexpr double round_off = 1e-9;
    if (std::abs(part - 0.5) < round_off) {
      throw UserMistake(
          "cuts the rectangle of the gas into halves, and the gas is the larger part: let the rectangle "
          "reach "
          "farther on the side where the gas is");
    }
    return part > 0.5;
  };
  if (!backwards()) return;
  reverse_direction(curve.x);
  for (int& corner : curve.corners) {
    const bool seam = corner == 0;  // of a closed curve, which begins where it ends
    corner = seam ? 0 : curve.points() - 1 - corner;
  }
  std::ranges::sort(curve.corners);
  if (curve.walls) std::swap(curve.walls->front(), curve.walls->back());
}

}  // namespace fsi
