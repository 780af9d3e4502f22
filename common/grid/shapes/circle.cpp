#include "common/grid/shapes/circle.hpp"

#include "common/grid/shapes/ellipse.hpp"

namespace fsi::grid {

PlaneCurve circle(const Vec2& centre, double radius) {
  return ellipse({.centre = centre, .a = radius, .b = radius});
}

}  // namespace fsi::grid
