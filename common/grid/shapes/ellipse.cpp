#include "common/grid/shapes/ellipse.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/core/failure.hpp"

namespace fsi::grid {

PlaneCurve ellipse(const Ellipse& shape) {
  if (!(shape.a > 0 && shape.b > 0)) {
    throw UserMistake(fmt::format("semi-axes {} and {} of a circle or an ellipse; write positive lengths",
                                  shape.a, shape.b));
  }
  constexpr double turn = 2 * std::numbers::pi;
  const Vec2 axis_a = shape.a * Vec2(std::cos(shape.angle), std::sin(shape.angle));
  const Vec2 axis_b = shape.b * Vec2(-std::sin(shape.angle), std::cos(shape.angle));
  return {.ends = Curve::closed,
          .position = [=, centre = shape.centre](double s) -> Vec2 {
            return centre + std::cos(turn * s) * axis_a + std::sin(turn * s) * axis_b;
          },
          .slope = [=](double s) -> Vec2 {
            return turn * (-std::sin(turn * s) * axis_a + std::cos(turn * s) * axis_b);
          },
          .even = shape.a == shape.b};
}

}  // namespace fsi::grid
