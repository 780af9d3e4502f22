#pragma once
/// A polygon with rounded corners.
///
/// Each component of x'(s) is the polygon's slope, averaged with the bell e/2 sech^2(e s): log-cosh steps
/// from edge to edge. The parameter is nearly the normalised arclength; a corner's radius goes as the total
/// length over e. A closed curve is the polygon itself, averaged with the bell as a periodic function: it
/// does not depend on the corner that is listed first, and has the polygon's symmetries.

#include <vector>

#include "common/grid/shapes/plane_curve.hpp"

namespace fsi::grid {

struct SmoothedPolygon {
  std::vector<Vec2> corners = {};         ///< a closed polygon's last corner is joined to its first one
  Curve ends = Curve::open;               ///< open: straight through both ends, which are met exactly
  double sharpness = 50;                  ///< e, of every corner, per unit of s [-]
  std::vector<double> sharpness_at = {};  ///< e of each edge where they differ [-]
};

/// @throws UserMistake for too few or coinciding corners, a sharpness that is not positive, or
/// so small that a closed polygon shrinks to less than half its length
PlaneCurve smoothed_polygon(const SmoothedPolygon& shape);

}  // namespace fsi::grid
