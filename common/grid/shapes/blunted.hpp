#pragma once
/// Ends too sharp for a grid are cut off: a trailing edge gets a small face.
///
///     ______                     ______
///           ------ .     ->            ----|   width
///     ______------               ______----|
///
/// Around a corner a grid fans out; beyond a right angle or so its cells become slivers. The face makes two
/// corners of half the turn each.

#include <vector>

#include "common/grid/shapes/plane_curve.hpp"

namespace fsi::grid {

/// The turn [radian] up to which a grid fans around one corner.
inline constexpr double largest_fan = 1.92;  // 110 degrees

/// The curve with a straight face of a width across every corner that turns by more than `largest_fan`, at
/// equal distances along both its sides; without such corners the curve itself.
/// @throws UserMistake where the sides of a corner are nowhere that far apart before the next corner
PlaneCurve blunted(const PlaneCurve& curve, double width);

/// A corner that `blunted` cuts off.
struct CutCorner {
  Vec2 at;          ///< the corner
  double loss = 0;  ///< from the middle of the face to the corner [length]
};

/// In the order of the curve. @throws UserMistake as `blunted`
std::vector<CutCorner> cut_corners(const PlaneCurve& curve, double width);

}  // namespace fsi::grid
