#pragma once
/// A plane curve by its parameter, and points placed along it.
///
/// Every shape of this folder is a function that makes a PlaneCurve. Points of a curve are component-major
/// (component c of point k at [c * n + k]), as everywhere in common/grid. On a closed curve the last point
/// is the first one again, to the bit.

#include <functional>
#include <span>
#include <vector>

#include "common/core/types.hpp"
#include "common/grid/geometry/interface_geometry.hpp"

namespace fsi::grid {

/// x(s) for 0 <= s <= 1. A closed curve continues periodically.
struct PlaneCurve {
  Curve ends = Curve::closed;
  std::function<Vec2(double s)> position;
  std::function<Vec2(double s)> slope;  ///< dx/ds
  bool even = false;                    ///< s is proportional to the arclength
  /// Parameters, ascending, 0 <= s < 1, where the direction jumps; an open curve has none at its ends.
  std::vector<double> corners = {};
};

/// Draws points together around one place of a curve: adds strength/2 tanh(sharpness (r - place)) to the
/// index as a function of the arclength r.
struct PointWeight {
  double strength = 0;   ///< a: about this part of all points goes there [-]
  double sharpness = 1;  ///< b: one over the width of the place, in parts of the length [-]
  double place = 0;      ///< c: where, in parts of the length [-]
};

/// Total length.
double length_of(const PlaneCurve& curve);

/// Parameters of n points, both ends included, evenly in arclength or by weights in arclength. Ascending
/// from 0 to 1. Each corner is one of the points; those between two corners are evenly spaced.
/// @throws UserMistake for n < 3, weights that turn the points back, or fewer points than corners take
std::vector<double> distribute(const PlaneCurve& curve, int n, std::span<const PointWeight> weights = {});

/// Points of the curve at parameters, component-major, and which of them are corners.
std::vector<double> points_at(const PlaneCurve& curve, std::span<const double> s);
std::vector<int> corners_among(const PlaneCurve& curve, std::span<const double> s);

/// n points of the curve at distribute()'s parameters, 2 n.
std::vector<double> points_on(const PlaneCurve& curve, int n, std::span<const PointWeight> weights = {});

}  // namespace fsi::grid
