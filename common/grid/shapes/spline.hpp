#pragma once
/// Cubic spline through points, by accumulated chord length: twice continuously differentiable.

#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/grid/shapes/plane_curve.hpp"

namespace fsi::grid {

/// Spline through points in their order. A closed one joins the last point to the first (which may be given
/// again at the end). Ends of an open one have the slope of the cubic through the four points there.
/// Where the straight lines between the points turn by more than `corner_angle` the curve has a corner: each
/// stretch from corner to corner is an open spline of its own, a parabola through three points, a straight
/// line through two. A closed curve with corners begins at one.
/// @throws UserMistake for fewer than four points (three with corners) or points that coincide
PlaneCurve spline(std::vector<Vec2> points, Curve ends, double corner_angle = std::numbers::pi);

/// Points of CSV text: two numbers a line, separated by comma, semicolon or blanks; empty lines, lines that
/// start with # and one heading line are skipped.
/// @throws UserMistake with `name`:line:column
std::vector<Vec2> points_from_csv(std::string_view text, const std::string& name);

}  // namespace fsi::grid
