#pragma once
/// Values at material points that are no grid points.

#include "common/grid/moving_grid.hpp"
#include "solid_solver/options.hpp"

namespace fsi::solid {

/// Place of a probe: cell (i, j) and position inside it.
struct ProbePoint {
  int i = 0, j = 0;
  double a = 0, b = 0;  ///< in [0, 1]
};

/// The cell that holds the reference position (x, y). @throws UserMistake when there is none
ProbePoint locate_probe(const grid::MovingGrid& grid, double x, double y);

/// Bilinear interpolation, second order.
SolidState value_at_probe(ConstFieldView q, const ProbePoint& probe);

}  // namespace fsi::solid
