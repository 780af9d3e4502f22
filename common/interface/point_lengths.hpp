#pragma once
/// What of a curve's length belongs to each of its points, for forces and powers along it.

#include <cmath>
#include <cstddef>
#include <span>

#include "common/core/component_major.hpp"

namespace fsi {

/// Half of the way to each neighbour, along the point's own tangent [length]. With the normals of chords between the
/// neighbours n ds is half of that chord, turned, and adds up to nothing over a closed curve, at its corners too: with half
/// of both steps themselves a constant pressure pushes a body with corners. Of the two copies of the point that
/// closes a curve each has its own half.
/// @param x positions of n points, component-major
/// @param normals unit normals, to one side of the curve
inline void point_lengths(std::span<const double> x, std::span<const double> normals, std::span<double> ds) {
  const std::size_t last = ds.size() - 1;
  double sum = 0;
  for (std::size_t k = 0; k <= last; ++k) {
    const Vec2 n = vector_at(normals, k),
               way = vector_at(x, k < last ? k + 1 : k) - vector_at(x, k > 0 ? k - 1 : k);
    ds[k] = 0.5 * (n.x() * way.y() - n.y() * way.x());
    sum += ds[k];
  }
  if (sum >= 0) return;
  for (double& length : ds) length = -length;
}

}  // namespace fsi
