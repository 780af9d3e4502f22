#pragma once
/// Where a lattice is too coarse: at bends of the gas's state, and near bodies.

#include <span>

#include "common/grid/overlap/composite_grid.hpp"
#include "fluid_solver/levels/cell_mask.hpp"

namespace fsi::fluid {

/// Smallest and largest value.
struct ValueRange {
  double low, high;
};

/// Widens a range to the values of one plane at the points of a set.
void widen(ValueRange& range, ConstFieldView q, int plane, const grid::RowSets& points);

/// Adds the points whose undivided second difference in one direction is larger than `least`; differences
/// are taken between known points.
void flag_bends(ConstFieldView q, int plane, double least, const CellMask& known, CellMask& flags);

/// Adds the points of a lattice three times as coarse as the background in whose control volumes something
/// lies that only the background itself can have: points that are not discretised, and all points of
/// body-fitted grids, at x[0], x[1], ...
void flag_bodies(const grid::CompositeGrid& grids, std::span<const ConstFieldView> x, CellMask& flags);

}  // namespace fsi::fluid
