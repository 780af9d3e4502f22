#pragma once
/// Small fixed-size tensors; nothing here touches the heap.

#include <Eigen/Core>

namespace fsi {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;

/// Positive where b points to the left of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// The four sides of a logically rectangular component grid: r1 = 0, r1 = 1, r2 = 0, r2 = 1.
enum class Side { left, right, bottom, top };

inline constexpr Side all_sides[] = {Side::left, Side::right, Side::bottom, Side::top};

/// Coordinate direction (0 or 1) that is constant on a side.
constexpr int direction_of(Side side) {
  return side == Side::left || side == Side::right ? 0 : 1;
}

/// True for the sides at r = 1.
constexpr bool at_upper_end(Side side) {
  return side == Side::right || side == Side::top;
}

constexpr const char* name_of(Side side) {
  constexpr const char* names[] = {"left", "right", "bottom", "top"};
  return names[static_cast<int>(side)];
}

}  // namespace fsi
