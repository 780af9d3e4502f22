#include "common/case/grids/curve_side.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "common/core/component_major.hpp"
#include "common/core/failure.hpp"
#include "common/grid/geometry/outline.hpp"

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
  double margin = 0;  ///< so far outside corners are taken to be, and ends are led on [length]

  Vec2 corner(int k) const {
    const int place = k % 4;
    return {place == 1 || place == 2 ? x_b + margin : x_a - margin, place >= 2 ? y_b + margin : y_a - margin};
  }
  Vec2 led_on(Vec2 x, Side side) const {
    x[direction_of(side)] += at_upper_end(side) ? margin : -margin;
    return x;
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

/// What bounds the part of a rectangle to the left of a curve between its sides; with a margin, places on the rim are
/// within it, or not, as those beside them are.
std::vector<double> bounds_to_the_left(const CurveSpec& curve, const Rim& rim) {
  const auto [first_side, last_side] = *curve.walls;
  const Vec2 first = vector_at(curve.x, 0),
             last = vector_at(curve.x, static_cast<std::size_t>(curve.points()) - 1);
  const double from = rim.place_of(last, last_side);
  double to = rim.place_of(first, first_side);
  if (to < from) to += 4;
  std::vector<Vec2> closing{rim.led_on(last, last_side)};
  for (int k = static_cast<int>(std::ceil(from)); k <= to; ++k) closing.push_back(rim.corner(k));
  closing.push_back(rim.led_on(first, first_side));
  std::vector<double> x(curve.x.begin(), curve.x.begin() + curve.points()),
      y(curve.x.begin() + curve.points(), curve.x.end());
  for (const Vec2& point : closing) {
    x.push_back(point[0]);
    y.push_back(point[1]);
  }
  x.insert(x.end(), y.begin(), y.end());
  return x;
}

/// Area of the part of a rectangle to the left of a curve between two of its sides, in parts of the whole.
double part_to_the_left(const CurveSpec& curve, const Rim& rim) {
  return 0.5 * signed_area(bounds_to_the_left(curve, rim)) / ((rim.x_b - rim.x_a) * (rim.y_b - rim.y_a));
}

/// Is a position to the left of a curve?
bool is_to_the_left(const CurveSpec& curve, const Rim& rim, const Vec2& x) {
  const bool on_sides = curve.walls && curve.on.empty();
  if (on_sides) return grid::encloses(bounds_to_the_left(curve, rim), x);
  return grid::encloses(curve.x, x) == (signed_area(curve.x) > 0);
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

std::vector<Side> sides_of_body(const SolidSpec& solid) {
  if (solid.body_fitted.empty()) return {std::begin(all_sides), std::end(all_sides)};
  const std::optional<std::array<Side, 2>>& walls = solid.body_fitted.front().curve.walls;
  if (!walls) return {};
  constexpr std::array in_turn{Side::bottom, Side::right, Side::top, Side::left};  // the body to their left
  std::vector<Side> sides{walls->back()};
  for (auto k = std::ranges::find(in_turn, walls->back()) - in_turn.begin(); sides.back() != walls->front();)
    sides.push_back(in_turn[static_cast<std::size_t>(++k % 4)]);
  return sides;
}

bool lies_behind(const BodyFittedSpec& spec, const GridSpec& background, const Vec2& x) {
  const double width = background.x_b - background.x_a, height = background.y_b - background.y_a;
  const Rim rim{background.x_a, background.x_b, background.y_a, background.y_b, std::min(width, height)};
  constexpr double round_off = 1e-9;  // of the largest coordinate
  double largest = 0;
  for (const double coordinate : spec.curve.x) largest = std::max(largest, std::abs(coordinate));
  return is_to_the_left(spec.curve, rim, x) == (spec.side == Side::top) &&
         grid::distance_to(spec.curve.x, x) > round_off * largest;
}

}  // namespace fsi
