#pragma once
/// Turns the grid of a case file into a component grid.

#include "common/case/case.hpp"
#include "common/grid/moving_grid.hpp"

namespace fsi {

/// Description of the grid a case asks for. `follows` when one of its sides is an interface.
grid::GridDescription grid_from_case(const GridSpec& spec, bool follows);

}  // namespace fsi
