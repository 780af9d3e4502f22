#pragma once
/// Questions about curves of points before grids are fitted to them: do they cross, how near do they come.
///
/// Points are component-major (component c of point k at [c * n + k]), joined by straight segments; segment k
/// goes from point k to point k + 1. Of a closed curve the last point is the first one again.

#include <cstddef>
#include <optional>
#include <span>

#include "common/core/types.hpp"
#include "common/grid/geometry/interface_geometry.hpp"

namespace fsi::grid {

/// Two segments that have a point in common.
struct Intersection {
  std::size_t a = 0, b = 0;  ///< the segments
  Vec2 x = Vec2::Zero();
};

/// Where a curve meets itself, its neighbouring segments apart. Costs n log n for ordinary curves.
std::optional<Intersection> self_crossing(std::span<const double> x, Curve ends);

/// Where two curves meet.
std::optional<Intersection> crossing_of(std::span<const double> a, std::span<const double> b);

/// Is a position within a closed curve (of an open one: closed by a straight line)?
bool encloses(std::span<const double> outline, const Vec2& position);

/// Distance of a position from a curve.
double distance_to(std::span<const double> curve, const Vec2& position);

/// The smallest distance of two curves that do not cross, and where on the first of them.
struct Gap {
  double distance = 0;  ///< [length]
  Vec2 x = Vec2::Zero();
};
Gap gap_between(std::span<const double> a, std::span<const double> b);

/// The smallest radius of curvature of a curve where it turns to the left (`turn` = 1) or to the right (-1),
/// and where; infinite where it never does. At `corners` (points) it turns with no radius: left out.
struct Bend {
  double radius = 0;  ///< [length]
  Vec2 x = Vec2::Zero();
};
Bend sharpest_bend(std::span<const double> x, Curve ends, double turn, std::span<const int> corners = {});

/// The shortest way along a normal from a curve to the next place of it, on its left (`side` = 1) or on its
/// right
/// (-1): how thick a body is, or how narrow a bay; infinite where no normal meets the curve again. Costs n^2.
Gap narrowest(std::span<const double> x, Curve ends, double side);

}  // namespace fsi::grid
