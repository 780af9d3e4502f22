#pragma once
/// Skewed, curved reference domains whose bottom is the straight line y = 0.

#include <cmath>
#include <numbers>

#include "common/core/types.hpp"
#include "common/grid/moving_grid.hpp"

namespace fsi::solid::test {

/// Reference domains as functions of r, s in [0, 1].
using Shape = Vec2 (*)(double r, double s);

/// Corners between 72 and 107 degrees.
inline Vec2 skewed_position(double r, double s) {
  return {r + 0.2 * s + 0.04 * std::sin(3 * s), s * (1 + 0.1 * r) + 0.05 * std::sin(3 * s) * std::sin(6 * r)};
}

/// Width tapers towards the top: corners of atan(0.4 / taper) at the bottom.
inline Vec2 tapered_position(double r, double s, double taper) {
  const double hump = std::sin(std::numbers::pi * r), sway = std::sin(std::numbers::pi * s);
  return {0.5 + (r - 0.5) * (1 - 2 * taper * s) + 0.03 * sway * sway, 0.4 * s * (1 + 0.1 * hump * hump)};
}
/// Bottom corners of 55 degrees, top corners of 125.
inline Vec2 trapezoid(double r, double s) {
  return tapered_position(r, s, 0.28);
}
/// Bottom corners of 79 degrees, top corners of 101.
inline Vec2 slightly_tapered(double r, double s) {
  return tapered_position(r, s, 0.08);
}
/// Two thirds of a ring, whose lines lie closer together towards its middle and are not at right angles.
inline Vec2 fan(double r, double s) {
  const double radius = 0.3 + 0.3 * s + 0.2 * s * s, angle = 1 + 4 * r + 0.3 * s;
  return {radius * std::sin(angle), radius * std::cos(angle)};
}

inline grid::MovingGrid grid_of(Shape shape, int cells) {
  return {{.name = "block",
           .n1 = cells + 1,
           .n2 = cells + 1,
           .mapping = [shape](double r, double s, double) { return shape(r, s); }},
          0};
}

inline grid::MovingGrid skewed_grid(int cells) {
  return grid_of(skewed_position, cells);
}

inline grid::MovingGrid unit_square(int cells) {
  return {{.name = "square",
           .n1 = cells + 1,
           .n2 = cells + 1,
           .mapping = [](double r, double s, double) -> Vec2 {
             return {r, s};
           }},
          0};
}

/// Outward normal of a domain at the point (x, y) of a side:
/// r and s by Newton's method from the middle of the side.
inline Vec2 normal_of(Shape shape, Side side, double x, double y) {
  const bool across_r = direction_of(side) == 0;
  double r = across_r ? (at_upper_end(side) ? 1.0 : 0.0) : 0.5,
         s = across_r ? 0.5 : (at_upper_end(side) ? 1.0 : 0.0);
  Vec2 along_r, along_s;
  for (int iteration = 0; iteration < 30; ++iteration) {
    constexpr double e = 1e-5;
    along_r = (shape(r + e, s) - shape(r - e, s)) / (2 * e);
    along_s = (shape(r, s + e) - shape(r, s - e)) / (2 * e);
    const Vec2 miss = Vec2(x, y) - shape(r, s);
    const double area = along_r.x() * along_s.y() - along_r.y() * along_s.x();
    r += (miss.x() * along_s.y() - miss.y() * along_s.x()) / area;
    s += (along_r.x() * miss.y() - along_r.y() * miss.x()) / area;
  }
  const Vec2 along = across_r ? along_s : along_r;
  const double sign = side == Side::right || side == Side::bottom ? 1.0 : -1.0;
  return sign * Vec2(along.y(), -along.x()).normalized();
}

}  // namespace fsi::solid::test
