#pragma once
/// On which side of an outline the body is, and on which a place.

#include <array>
#include <optional>
#include <vector>

#include "common/case/case.hpp"

namespace fsi {

/// Turns the points of a curve so that the body lies to their left: inside a closed curve, between a curve
/// and the side of the gas's rectangle on which both its ends stand, and of the two parts into which a curve
/// between two sides cuts that rectangle (x_a, x_b, y_a, y_b) the smaller one. @throws UserMistake where they are alike
void put_body_to_the_left(CurveSpec& curve, const std::optional<std::array<double, 4>>& rectangle);

/// The sides of its grid that bound a solid: all four, or, of one with a `shape`, those between the two ends of the
/// outline, on which it stands.
std::vector<Side> sides_of_body(const SolidSpec& solid);

/// Is a place within the background on the other side of the curve than the domain? Not those on the curve.
bool lies_behind(const BodyFittedSpec& spec, const GridSpec& background, const Vec2& x);

}  // namespace fsi
