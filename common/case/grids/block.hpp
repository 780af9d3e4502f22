#pragma once
/// Bodies with four straight sides: one grid from corner to corner, neither a ring nor a core.
///
///         (0, 1) +--- top ---+ (1, 1)      the outline runs counter-clockwise, the body to its left;
///                |           |             of a body on a wall it begins and ends on that side
///              left        right
///                |           |
///         (0, 0) +-- bottom -+ (1, 0)

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// The corners of an outline as those of a grid, or why it has not four straight sides.
struct BlockCorners {
  std::optional<std::array<Vec2, 4>> at;  ///< as GridSpec::corners
  std::string why_not = {};               ///< "it has 5 corners"
};

/// @param outline seen closely, the body to its left. A body that stands on a wall has the side of that name there
BlockCorners block_corners(const CurveSpec& outline);

/// Nothing is said of a ring or a core: a body of four straight sides takes one grid from corner to corner.
bool leaves_block_open(const config::Node& solid);

/// Points of a grid between these corners, h apart on the mean, five at least in each direction; across a thin
/// block cells are thinner than h, and no more than half as long again along it, for the lines of the gas that
/// leave its corners lean towards the side whose points are farther apart.
std::array<int, 2> block_points(const std::array<Vec2, 4>& corners, double h);

/// Sides of the grid of a block that are its outline, in the order of the outline.
std::vector<Side> sides_along(const CurveSpec& outline);

/// Does the index along a side grow against the direction of the outline?
constexpr bool runs_against_outline(Side side) {
  return side == Side::top || side == Side::left;
}

/// The outline with the points of the grid.
CurveSpec block_outline(const GridSpec& grid, CurveSpec outline);

}  // namespace fsi
