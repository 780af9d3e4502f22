#include "common/case/scales.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/case/grids/grid_points.hpp"

namespace fsi {

double size_of(const GridSpec& grid) {
  if (grid.kind == GridSpec::Kind::rectangle) return std::max(grid.x_b - grid.x_a, grid.y_b - grid.y_a);
  Vec2 low = place(grid, 0, 0, 0), high = low;
  for (const auto& [r, s] : {std::pair{1, 0}, {0, 1}, {1, 1}}) {
    low = low.cwiseMin(place(grid, r, s, 0));
    high = high.cwiseMax(place(grid, r, s, 0));
  }
  return (high - low).maxCoeff();
}

double crossing_time_of(const SolidSpec& solid) {
  return size_of(solid.grid) * std::sqrt(solid.rho / (solid.lambda + 2 * solid.mu));
}

}  // namespace fsi
