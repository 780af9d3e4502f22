#pragma once
/// The points at which checks look at what a case gives as functions of place.

#include <optional>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/types.hpp"

namespace fsi {

/// Some points of a grid at t = 0, or of one side of it, the corners among them.
std::vector<Vec2> sample_points(const GridSpec& grid, std::optional<Side> side = {});

/// Some points of a body, its outline's among them.
std::vector<Vec2> sample_points(const SolidSpec& solid);

/// All points of an outline.
std::vector<Vec2> outline_points(const CurveSpec& curve);

}  // namespace fsi
