#pragma once
/// Turns the grid of a case file into a component grid.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/case/case.hpp"
#include "common/grid/moving_grid.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "common/io/part.hpp"

namespace fsi {

/// Description of the grid a case asks for. `follows` when one of its sides is an interface.
grid::GridDescription grid_from_case(const GridSpec& spec, bool follows);

/// Description of a grid marched from a curve.
grid::GridDescription grid_from_case(const BodyFittedSpec& spec);

/// Descriptions of grids of the gas along curves. Where bodies move, those of walls follow too.
std::vector<grid::GridDescription> grids_from_case(const std::vector<BodyFittedSpec>& specs);

/// How the grids overlapped since the start, for the report; nothing where there is one grid only.
std::optional<io::Overlap> overlap_of(const grid::CompositeGrid* composite);

/// What the points of a component grid are, for output: 0 unused, 1 discretised, 2 interpolated, row by row;
/// empty where all are discretised (no composite grid).
std::vector<std::uint8_t> kinds_of(const grid::CompositeGrid* composite, int grid);

}  // namespace fsi
