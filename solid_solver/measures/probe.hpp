#pragma once
/// Values at material points that are no grid points.

#include <optional>

#include "solid_solver/options.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

/// Place of a probe: cell (i, j) and position inside it.
struct ProbePoint {
  int i = 0, j = 0;
  double a = 0, b = 0;  ///< in [0, 1]
  int grid = 0;
};

/// The cell of points with values that holds the reference position (x, y); nothing when there is none.
std::optional<ProbePoint> locate_probe(ConstFieldView reference, const SolidPoints& points, double x,
                                       double y);

/// Bilinear interpolation, second order.
SolidState value_at_probe(ConstFieldView q, const ProbePoint& probe);

}  // namespace fsi::solid
