#pragma once
/// Keeps density and pressure positive where the second-order step would not.
///
///     . . . . . .      x  thin: the step leaves too little of its density or pressure
///     . . o . . .      o  beside it: advanced again, since a face has another flux
///     . o x o . .
///     . . o . . .      first-order split fluxes on the four faces of x, the old ones on all others
///
/// A flux is the same for both points of its face, so nothing is lost. Points beside that become thin by this
/// are treated in the same way, until there is none. Costs nothing but the counting where no point is thin.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "common/case/schema/boundary_facts.hpp"
#include "common/grid/overlap/interpolation.hpp"
#include "common/ranks/rows/rank_rows.hpp"
#include "fluid_solver/kernels/sweep.hpp"

namespace fsi::fluid {

/// What became of the thin points of a step.
struct Positivity {
  std::vector<PointIndex> thin;  ///< advanced points with positive fluxes
  std::vector<int> rows;         ///< rows with points advanced again, sorted
  std::size_t floors = 0;        ///< points whose pressure had to be lifted to the floor all the same
};

/// Where a step of a grid is made positive.
struct PositivityTask {
  const SweepOutput& output;
  const std::array<Beyond, 4>& beyond;  ///< left, right, bottom, top
  Ranks& ranks;                         ///< who sweep the grid together; all of them call
};

/// Treats the thin points of `task`, which has been swept. Points that are no numbers, or without density, stay
/// what they are.
Positivity keep_positive(const SweepTask& task, const Scheme& scheme, const PositivityTask& positive);

/// Quadratic interpolation across a jump may leave too little as well: less than `thin_part` of the density
/// or pressure in the middle of the stencil. Such a point gets the smallest value of its donors. Not
/// conservative, as interpolation is not. @returns the number of points in rows of one's own
std::size_t keep_positive(const grid::InterpolationList& list, std::span<const FieldView> fields,
                          const RankRows& rows);

}  // namespace fsi::fluid
