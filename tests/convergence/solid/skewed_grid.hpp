#pragma once
/// A skewed, curved reference domain whose bottom is the straight line y = 0.

#include <cmath>

#include "common/core/types.hpp"
#include "common/grid/moving_grid.hpp"

namespace fsi::solid::test {

inline Vec2 skewed_position(double r, double s) {
  return {r + 0.2 * s + 0.04 * std::sin(3 * s), s * (1 + 0.1 * r) + 0.05 * std::sin(3 * s) * std::sin(6 * r)};
}

inline grid::MovingGrid skewed_grid(int cells) {
  return {{.name = "skewed",
           .n1 = cells + 1,
           .n2 = cells + 1,
           .mapping = [](double r, double s, double) { return skewed_position(r, s); }},
          0};
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

/// Outward normal of the skewed domain at the point (x, y) of a side.
inline Vec2 skewed_normal(Side side, double x, double y) {
  double r = x - 0.2 * y, s = y;
  Vec2 along_r, along_s;
  for (int iteration = 0; iteration < 30; ++iteration) {
    constexpr double e = 1e-5;
    along_r = (skewed_position(r + e, s) - skewed_position(r - e, s)) / (2 * e);
    along_s = (skewed_position(r, s + e) - skewed_position(r, s - e)) / (2 * e);
    const Vec2 miss = Vec2(x, y) - skewed_position(r, s);
    const double area = along_r.x() * along_s.y() - along_r.y() * along_s.x();
    r += (miss.x() * along_s.y() - miss.y() * along_s.x()) / area;
    s += (along_r.x() * miss.y() - along_r.y() * miss.x()) / area;
  }
  const Vec2 along = direction_of(side) == 0 ? along_s : along_r;
  const double sign = side == Side::right || side == Side::bottom ? 1.0 : -1.0;
  return sign * Vec2(along.y(), -along.x()).normalized();
}

}  // namespace fsi::solid::test
