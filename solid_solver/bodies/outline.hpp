#pragma once
/// Where a body that is no continuum meets the gas.

#include <vector>

#include "common/grid/geometry/interface_geometry.hpp"

namespace fsi::bodies {

/// What the coupler sees of the body: its points where the gas is.
struct Outline {
  std::vector<double> x;  ///< reference positions, 2 n component-major
  grid::Curve ends = grid::Curve::closed;
  double orientation = 1;  ///< of the normals (grid::normals) [-]
};

}  // namespace fsi::bodies
