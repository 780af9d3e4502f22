#include "common/case/scales.hpp"

#include <algorithm>
#include <cmath>

namespace fsi {

double size_of(const GridSpec& grid) {
  if (grid.kind == GridSpec::Kind::rectangle) return std::max(grid.x_b - grid.x_a, grid.y_b - grid.y_a);
  double size = 0;
  for (const Expression* component : {&grid.map.c1, &grid.map.c2}) {
    const auto [low, high] =
        std::minmax({component->at_parameters(0, 0, 0), component->at_parameters(1, 0, 0),
                     component->at_parameters(0, 1, 0), component->at_parameters(1, 1, 0)});
    size = std::max(size, high - low);
  }
  return size;
}

double crossing_time_of(const SolidSpec& solid) {
  return size_of(solid.grid) * std::sqrt(solid.rho / (solid.lambda + 2 * solid.mu));
}

}  // namespace fsi
