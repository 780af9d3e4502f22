#include "common/case/grid_points.hpp"

#include <cmath>

namespace fsi {

Vec2 position(const GridSpec& grid, int i, int j, double t) {
  const double r = static_cast<double>(i) / (grid.n1 - 1);
  const double s = static_cast<double>(j) / (grid.n2 - 1);
  Vec2 x(grid.x_a + r * (grid.x_b - grid.x_a), grid.y_a + s * (grid.y_b - grid.y_a));
  if (grid.kind == GridSpec::Kind::mapped) {
    x = Vec2(grid.map.c1.at_parameters(r, s, t), grid.map.c2.at_parameters(r, s, t));
  }
  const double c = std::cos(grid.rotation);
  const double sine = std::sin(grid.rotation);
  return {c * x[0] - sine * x[1], sine * x[0] + c * x[1]};
}

int points_along(const GridSpec& grid, Side side) {
  return direction_of(side) == 0 ? grid.n2 : grid.n1;
}

Vec2 side_point(const GridSpec& grid, Side side, int k) {
  const int end = at_upper_end(side) ? (direction_of(side) == 0 ? grid.n1 : grid.n2) - 1 : 0;
  return direction_of(side) == 0 ? position(grid, end, k, 0) : position(grid, k, end, 0);
}

}  // namespace fsi
