#pragma once
/// Where the points of a case's grid are.

#include <vector>

#include "common/case/case.hpp"
#include "common/core/types.hpp"

namespace fsi {

/// Position at time t of the place with the parameters r, s in [0, 1].
Vec2 place(const GridSpec& grid, double r, double s, double t);
/// Position of grid point (i, j) at time t.
Vec2 position(const GridSpec& grid, int i, int j, double t);
/// Where a side of an upright rectangle is: its x, or its y.
double end_of(const GridSpec& grid, Side side);
/// Number of points of a side.
int points_along(const GridSpec& grid, Side side);
/// Point k of a side at time t.
Vec2 side_point(const GridSpec& grid, Side side, int k, double t = 0);
/// Neighbour of point k of a side towards the inside.
Vec2 inner_point(const GridSpec& grid, Side side, int k);
/// n points along a side at t = 0, evenly in the grid's parameter, component-major.
std::vector<double> points_on_side(const GridSpec& grid, Side side, int n);
/// Digits that place a coordinate to a hundredth of the distance of points there.
int digits_for(double coordinate, double spacing);

}  // namespace fsi
