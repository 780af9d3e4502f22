#pragma once

#include "common/grid/shapes/plane_curve.hpp"

namespace fsi::grid {

struct Ellipse {
  Vec2 centre = Vec2::Zero();
  double a = 1, b = 1;  ///< semi-axes [length]
  double angle = 0;     ///< of the axis a against the x axis [rad]
};

/// Ellipse, counter-clockwise from the end of the axis a. @throws UserMistake for semi-axes not positive
PlaneCurve ellipse(const Ellipse& shape);

}  // namespace fsi::grid
