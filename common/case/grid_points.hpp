#pragma once
/// Where the points of a case's grid are.

#include "common/case/case.hpp"
#include "common/core/types.hpp"

namespace fsi {

/// Position of grid point (i, j) at time t.
Vec2 position(const GridSpec& grid, int i, int j, double t);
/// Number of points of a side.
int points_along(const GridSpec& grid, Side side);
/// Point k of a side at t = 0.
Vec2 side_point(const GridSpec& grid, Side side, int k);

}  // namespace fsi
