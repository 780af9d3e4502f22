#pragma once
/// Area, centre and second moment of a plane region, from the points of its rim.

#include <span>

#include "common/core/types.hpp"

namespace fsi::rigid {

struct Inertia {
  double area = 0;  ///< [length^2]
  Vec2 centre = Vec2::Zero();
  double second_moment = 0;  ///< polar, about the centre [length^4]
};

/// Of the polygon through the points `x` (2 n, component-major), which the last side closes; the region lies
/// to the left. Parts of the rim that are walked both ways, as the seam of a ring, cancel.
/// @throws std::invalid_argument where the area is not positive
Inertia inertia_of(std::span<const double> x);

}  // namespace fsi::rigid
