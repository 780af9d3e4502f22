#pragma once
/// A body's overlapping grids put together. They are static: connected once.

#include <optional>
#include <vector>

#include "common/core/field.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "solid_solver/solid_part.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

/// Nothing for a single grid without bodies.
/// @throws UserMistake where the first grid is no rectangle along x and y, a grid does not fit its
/// description, or the conditions on its sides do not fit its place
std::optional<grid::CompositeGrid> connected(const std::vector<SolidPart>& parts,
                                             std::vector<grid::BodyFittedGrid> bodies);

/// Areas that the points stand for, one field per grid.
std::vector<Field> areas_of(const grid::CompositeGrid& composite, const std::vector<SolidPart>& parts);

/// Points of one grid; `layout` is that of a single grid.
SolidPoints points_of(const std::optional<grid::CompositeGrid>& composite, int grid, const Layout& layout);

}  // namespace fsi::solid
