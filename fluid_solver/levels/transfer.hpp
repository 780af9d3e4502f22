#pragma once
/// Values between two levels of a lattice: averages up, conservative parabolas down.
///
///     |  q  |  q  |  q  |           a coarse value is the mean of the conserved variables of the nine fine ones
///     |        Q        |           in its control volume; the nine that are made from a coarse one have it as
///                                   their mean
///
/// On a side of the rectangle half of a control volume lies outside: behind a mirror it is the image of the
/// other half, at the end of a period the other end. On all other sides the value is that of the side itself.

#include <array>

#include "fluid_solver/levels/cell_mask.hpp"
#include "fluid_solver/positivity.hpp"
#include "fluid_solver/state_vector.hpp"

namespace fsi::fluid {

/// The fine points of a line that make up a coarse one's control volume there.
struct Members {
  int n = 0;
  std::array<int, 3> at{};
  std::array<double, 3> weight{};  ///< they add up to one
  bool mirrored = false;           ///< half of it lies behind a mirror
};

/// Of coarse point k on a line of so many fine points; `ends` are what lies beyond the first and last of them.
Members members_of(int k, int fine_points, const std::array<Beyond, 2>& ends);

/// What lies beyond the sides left, right, bottom, top.
using Ends = std::array<Beyond, 4>;

/// Gives coarse points the averages of their control volumes. States are primitive.
void restrict_to(const grid::RowSets& points, FieldView coarse, ConstFieldView fine, const Ends& ends,
                 double gamma);

/// The same for the density alone; what else a point has it keeps.
void restrict_density(const grid::RowSets& points, FieldView coarse, ConstFieldView fine, const Ends& ends);

/// Gives the fine points in the control volumes of coarse points values of quadratic polynomials with the
/// averages of the coarse ones and central differences to their neighbours; deviations from the average are
/// scaled down to stay within the range of the neighbours, and to nothing where a density or pressure would
/// not be positive. Neighbours of the points must have values, ghosts included.
void prolong_from(const grid::RowSets& points, ConstFieldView coarse, FieldView fine, double gamma);

}  // namespace fsi::fluid
