#pragma once
/// Integrals over a domain that several grids cover: a smooth partition of unity, so that no overlap counts
/// twice and no staircase of background points counts at all.
///
///     weight of the body-fitted grid     1 --.__            lines 0 .. S from the curve
///                                               `--.
///     weight of the background           0 _________`---    1 - the former at the same position
///
/// With q = s / S, s the line coordinate counted from the curve and S the last line in use, the body-fitted
/// grid weighs w = 1 - (10 q^3 - 15 q^4 + 6 q^5). Where several body-fitted grids lie above each other, each
/// one weighs w_k prod_m (1 - w_m), m other than k, and the background prod_m (1 - w_m), scaled to a sum of
/// one: at a curve, its own grid weighs everything.

#include <span>
#include <vector>

#include "common/core/field.hpp"
#include "common/grid/overlap/composite_grid.hpp"

namespace fsi::grid {

/// One weight per grid and point (fields of one plane, zero at unused points). The sum of the weights at any
/// position of the domain is 1, up to the error of the grids' own maps.
/// @param x positions now of all grids, at which they are connected; x[0], the Cartesian background, is not
/// read
std::vector<Field> partition_of_unity(const CompositeGrid& grids, std::span<const ConstFieldView> x);

/// Areas that the points stand for: partition of unity times Jacobian (central differences; ghost points of x
/// are read) times trapezoidal end weights (1/2 on each side). The sum of area * f over all points of all
/// grids is the integral of f over the domain, to second order.
std::vector<Field> area_weights(const CompositeGrid& grids, std::span<const ConstFieldView> x);

}  // namespace fsi::grid
