#pragma once
/// One grid of a body as it is given.

#include "common/grid/moving_grid.hpp"
#include "solid_solver/options.hpp"

namespace fsi::solid {

/// A component grid and the conditions on its sides.
struct SolidPart {
  grid::MovingGrid grid;
  Boundaries boundaries;
};

}  // namespace fsi::solid
