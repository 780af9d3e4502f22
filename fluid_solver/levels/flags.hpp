#pragma once
/// Where a lattice is too coarse: at bends of the gas's state, and near bodies.

#include <span>

#include "common/grid/overlap/composite_grid.hpp"
#include "common/ranks/rows/rank_rows.hpp"
#include "fluid_solver/levels/cell_mask.hpp"

namespace fsi::fluid {

/// Smallest and largest value.
struct ValueRange {
  double low, high;
};

/// Widens a range to the values of one plane at the points of a set that are in rows of one's own.
void widen(ValueRange& range, ConstFieldView q, int plane, const grid::RowSets& points, const RankRows& own);

/// Undivided second differences of a plane that are too large.
struct Bends {
  int plane;
  double least;
};

/// Adds the points in rows of one's own whose undivided second difference in one direction is too large; differences
/// are taken between known points.
void flag_bends(ConstFieldView q, const Bends& bends, const CellMask& known, const RankRows& own,
                CellMask& flags);

/// Adds the points of a lattice three times as coarse as the background in whose control volumes something
/// lies that only the background itself can have: points that are not discretised, and all points of
/// body-fitted grids, at x[0], x[1], ...
void flag_bodies(const grid::CompositeGrid& grids, std::span<const ConstFieldView> x, CellMask& flags);

}  // namespace fsi::fluid
