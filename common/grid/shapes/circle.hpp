#pragma once

#include "common/grid/shapes/plane_curve.hpp"

namespace fsi::grid {

/// Circle, counter-clockwise from angle 0. @throws UserMistake for a radius that is not positive
PlaneCurve circle(const Vec2& centre, double radius);

}  // namespace fsi::grid
