#include "common/case/grids/grid_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fsi {

Vec2 place(const GridSpec& grid, double r, double s, double t) {
  Vec2 x(grid.x_a + r * (grid.x_b - grid.x_a), grid.y_a + s * (grid.y_b - grid.y_a));
  if (grid.kind == GridSpec::Kind::mapped) {
    x = Vec2(grid.map.c1.at_parameters(r, s, t), grid.map.c2.at_parameters(r, s, t));
  }
  if (grid.kind == GridSpec::Kind::block) {
    const auto& [x_00, x_10, x_11, x_01] = grid.corners;
    const Vec2 below = x_00 + r * (x_10 - x_00), above = x_01 + r * (x_11 - x_01);
    return below + s * (above - below);
  }
  const double c = std::cos(grid.rotation);
  const double sine = std::sin(grid.rotation);
  return {c * x[0] - sine * x[1], sine * x[0] + c * x[1]};
}

Vec2 position(const GridSpec& grid, int i, int j, double t) {
  return place(grid, static_cast<double>(i) / (grid.n1 - 1), static_cast<double>(j) / (grid.n2 - 1), t);
}

double end_of(const GridSpec& grid, Side side) {
  if (direction_of(side) == 0) return at_upper_end(side) ? grid.x_b : grid.x_a;
  return at_upper_end(side) ? grid.y_b : grid.y_a;
}

int points_along(const GridSpec& grid, Side side) {
  return direction_of(side) == 0 ? grid.n2 : grid.n1;
}

Vec2 side_point(const GridSpec& grid, Side side, int k, double t) {
  const int end = at_upper_end(side) ? (direction_of(side) == 0 ? grid.n1 : grid.n2) - 1 : 0;
  return direction_of(side) == 0 ? position(grid, end, k, t) : position(grid, k, end, t);
}

Vec2 inner_point(const GridSpec& grid, Side side, int k) {
  const int end = at_upper_end(side) ? (direction_of(side) == 0 ? grid.n1 : grid.n2) - 2 : 1;
  return direction_of(side) == 0 ? position(grid, end, k, 0) : position(grid, k, end, 0);
}

std::vector<double> points_on_side(const GridSpec& grid, Side side, int n) {
  const auto count = static_cast<std::size_t>(n);
  std::vector<double> x(2 * count);
  const double end = at_upper_end(side) ? 1 : 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double along = static_cast<double>(k) / (n - 1);
    const Vec2 point = direction_of(side) == 0 ? place(grid, end, along, 0) : place(grid, along, end, 0);
    x[k] = point[0];
    x[count + k] = point[1];
  }
  return x;
}

int digits_for(double coordinate, double spacing) {
  if (coordinate == 0) return 1;
  constexpr int of_a_hundredth = 2;
  const double before = std::ceil(std::log10(std::abs(coordinate) / spacing));
  return std::clamp(static_cast<int>(before) + of_a_hundredth, 1, std::numeric_limits<double>::max_digits10);
}

}  // namespace fsi
