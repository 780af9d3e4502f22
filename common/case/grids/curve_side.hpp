#pragma once
/// On which side of an outline the body is.

#include <array>
#include <optional>

#include "common/case/case.hpp"

namespace fsi {

/// Turns the points of a curve so that the body lies to their left: inside a closed curve, between a curve
/// and the side of the gas's rectangle on which both its ends stand, and of the two parts into which a curve
/// between two sides cuts that rectangle (x_a, x_b, y_a, y_b) the smaller one. @throws UserMistake where they are alike
void put_body_to_the_left(CurveSpec& curve, const std::optional<std::array<double, 4>>& rectangle);

}  // namespace fsi
