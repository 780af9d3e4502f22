#pragma once
/// The points at which checks look at what a case gives as functions of place: points of its grids, for others the run does
/// not have.

#include <cstddef>
#include <optional>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/types.hpp"

namespace fsi {

/// Some points of a grid at time t, or of one side of it, the corners among them.
std::vector<Vec2> sample_points(const GridSpec& grid, std::optional<Side> side = {}, double t = 0);

/// Some points of the grid of a gas at the start, those behind curves fitted to it left out: there the solver takes no value,
/// but on the coarser ones of several levels, which it fills everywhere.
std::vector<Vec2> sample_points(const FluidSpec& fluid);

/// All points of the k-th curve fitted to a gas, those behind others of its curves left out.
std::vector<Vec2> curve_points(const FluidSpec& fluid, std::size_t k);

/// Some points of a body, its outline's among them.
std::vector<Vec2> sample_points(const SolidSpec& solid);

/// The first corner of a cell and its two edges from there.
struct BodyCell {
  Vec2 x, edge1, edge2;
};

/// Some cells of a body; none of one that stands on a wall.
std::vector<BodyCell> sample_cells(const SolidSpec& solid);

/// All points of an outline.
std::vector<Vec2> outline_points(const CurveSpec& curve);

}  // namespace fsi
