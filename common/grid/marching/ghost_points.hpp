#pragma once
/// Where the ghost points of a grid along a curve lie.

#include "common/core/field.hpp"
#include "common/grid/geometry/interface_geometry.hpp"

namespace fsi::grid {

/// Of the last step of a line before its end, what its change from one step to the next may be [-].
inline constexpr double largest_change_of_step = 0.25;

/// How near to each other lines across the curve may come at the first ghost points, part of their distance on it [-].
inline constexpr double least_ghost_distance = 0.1;

/// Places the ghost points of x (planes x1, x2). Across the curve, and along its lines where those are open, they continue
/// the grid by third-order extrapolation; along closed lines they are the points of the next turn. Where a line bends
/// sharply just before its end, as at the foot of a soft body that leans, extrapolation would bend the ghost cells over
/// until the cell of the end, which they share, has no area left: the change of a step is then cut to
/// `largest_change_of_step`. Behind a sharp corner of the curve they go less far, where lines across would come nearer to
/// each other than `least_ghost_distance`, or cross.
void fill_ghosts(FieldView x, Curve lines);

}  // namespace fsi::grid
