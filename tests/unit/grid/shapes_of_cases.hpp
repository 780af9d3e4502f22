#pragma once
/// The curves of the cases, for the tests of shapes, marching and overlap.

#include <cmath>
#include <numbers>
#include <vector>

#include "common/grid/shapes/ellipse.hpp"
#include "common/grid/shapes/smoothed_polygon.hpp"
#include "common/grid/shapes/spline.hpp"

namespace fsi::grid {

/// Section 6 of the paper.
inline PlaneCurve tilted_ellipse() {
  return ellipse({.centre = {-1, 0}, .a = 1.25, .b = 0.5, .angle = std::numbers::pi / 4});
}

/// Section 7 of the paper.
inline PlaneCurve beam_outline() {
  return smoothed_polygon({.corners = {{-.05, 0}, {-.05, 1}, {.05, 1}, {.05, 0}}, .sharpness = 50});
}

/// A spline with five arms.
inline PlaneCurve star() {
  std::vector<Vec2> points;
  for (int k = 0; k < 60; ++k) {
    const double angle = 2 * std::numbers::pi * k / 60, r = 1 + 0.25 * std::cos(5 * angle);
    points.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return spline(points, Curve::closed);
}

}  // namespace fsi::grid
