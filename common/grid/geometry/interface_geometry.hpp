#pragma once
/// Geometry of a curve of points, component-major (component c of point k at [c * n + k]).

#include <span>
#include <vector>

#include "common/core/types.hpp"

namespace fsi::grid {

/// How the points continue beyond the ends.
enum class Curve {
  open,    ///< they do not: second-order one-sided differences at the ends
  closed,  ///< the last point is the first one again, or the first one of the next period
};

/// Derivative with respect to the index by second-order differences, 2 n.
std::vector<double> tangents(std::span<const double> x, Curve curve);

/// Unit normals, 2 n: to the right of the direction of increasing
/// index for `orientation` = 1, to the left for -1.
std::vector<double> normals(std::span<const double> x, Curve curve, double orientation);

/// Orientation that makes `normals` of a grid's side point out of the grid.
constexpr double outward(Side side) {
  return side == Side::right || side == Side::bottom ? 1.0 : -1.0;
}

}  // namespace fsi::grid
