#pragma once
/// A polygon whose corners are arcs of a given radius.
///
///        ____            straight edges stay where they are; an arc touches both edges of its corner, so the
///      /      \          outline reaches as far as an edge does and no other corner changes it
///     |        |
///
/// The parameter is the arclength. The curvature jumps where an arc begins. With a radius of 0 the corners
/// are sharp, and corners of the curve.

#include <vector>

#include "common/grid/shapes/plane_curve.hpp"

namespace fsi::grid {

struct RoundedPolygon {
  std::vector<Vec2> corners = {};  ///< a closed polygon's last corner is joined to its first one
  Curve ends = Curve::open;        ///< open: the first and the last corner are its ends
  double radius = 0;               ///< of every corner's arc; 0: sharp corners [length]
};

/// Starts in the middle of a closed polygon's first edge, at an open one's first corner.
/// @throws UserMistake for too few or coinciding corners, edges that turn back on themselves, and where an
/// edge is too short for the arcs at its ends; it says which one and the largest radius there
PlaneCurve rounded_polygon(const RoundedPolygon& shape);

}  // namespace fsi::grid
