#pragma once
/// What dissipation must leave alone beside loaded sides.

#include <algorithm>

#include "solid_solver/boundary/sides/sides.hpp"

namespace fsi::solid {

/// 1 beside cells whose sides are as 1 to 1.1 or nearer, and less the longer or the flatter they are [-].
inline double squareness(const SideMetrics& m) {
  const double squared_ratio = m.across.squaredNorm() / m.along.squaredNorm();
  const double shape = std::min(squared_ratio, 1.0 / squared_ratio);
  return std::min(1.0, 1.5 * shape * shape);
}

/// How much of paper eq. (41) the traction of a loaded side takes [-]. The traction of P(F) is right with the second
/// differences of (43), (41) has fourth-order ones. What they differ by moves the side along the characteristics and
/// makes noise grow where cells are far from square, or where beta^r takes nearly all of it
/// (docs/theory_solid.md, stability).
inline double traction_share(const SideMetrics& m, double beta) {
  return squareness(m) * std::clamp(2.5 * (0.9 - beta), 0.0, 1.0);
}

/// Takes back what paper eq. (40) across loaded sides, with beta = beta^u, did to their own points on the way from q to
/// `next`: the ghost displacement there makes the traction right, it does not continue the field.
///
/// A ghost point of paper eq. (43) contains differences along the side, times the cell's depth over its length:
/// what (40) makes of them on the side itself is no dissipation, and grows on deep cells. So the side's own
/// points take none across the side, and beside cells that are not square the next line takes it with an extrapolated
/// ghost point. Both are what (40) has there beyond a linear displacement (beyond_linear): where lines bend, a ghost
/// point is not where extrapolation has it, nor is the displacement of a body that has turned.
void correct_displacement_dissipation(const Sides& sides, ConstFieldView q, FieldView next, double beta);

}  // namespace fsi::solid
