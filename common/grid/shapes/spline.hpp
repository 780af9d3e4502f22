#pragma once
/// Cubic spline through points, by accumulated chord length: twice continuously differentiable.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/grid/shapes/plane_curve.hpp"

namespace fsi::grid {

/// Spline through points in their order. A closed one joins the last point to the first (which may be given
/// again at the end). Ends of an open one have the slope of the cubic through the four points there.
/// @throws UserMistake for fewer than four points or points that coincide
PlaneCurve spline(std::vector<Vec2> points, Curve ends);

/// Points of CSV text: two numbers a line, separated by comma, semicolon or blanks; empty lines, lines that
/// start with # and one heading line are skipped.
/// @throws UserMistake with `name`:line:column
std::vector<Vec2> points_from_csv(std::string_view text, const std::string& name);

}  // namespace fsi::grid
