#include "common/case/check/given/sample.hpp"

#include <cstddef>

#include "common/case/grids/grid_points.hpp"
#include "common/grid/geometry/outline.hpp"

namespace fsi {

std::vector<Vec2> sample_points(const GridSpec& grid, std::optional<Side> side) {
  constexpr int samples = 8;  // in each direction
  std::vector<Vec2> points;
  for (int b = 0; b <= samples; ++b) {
    if (side) {
      points.push_back(side_point(grid, *side, b * (points_along(grid, *side) - 1) / samples));
      continue;
    }
    for (int a = 0; a <= samples; ++a) {
      points.push_back(position(grid, a * (grid.n1 - 1) / samples, b * (grid.n2 - 1) / samples, 0));
    }
  }
  return points;
}

std::vector<Vec2> sample_points(const SolidSpec& solid) {
  constexpr int samples = 16;  // of a grid, in each direction
  const CurveSpec* curve = solid.body_fitted.empty() ? nullptr : &solid.body_fitted.front().curve;
  std::vector<Vec2> points = curve == nullptr ? std::vector<Vec2>() : outline_points(*curve);
  for (int b = 0; b <= samples; ++b) {
    for (int a = 0; a <= samples; ++a) {
      const Vec2 x = place(solid.grid, static_cast<double>(a) / samples, static_cast<double>(b) / samples, 0);
      if (curve == nullptr || (curve->closed() && grid::encloses(curve->x, x))) points.push_back(x);
    }
  }
  return points;
}

std::vector<Vec2> outline_points(const CurveSpec& curve) {
  const std::size_t n = curve.x.size() / 2;
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < n; ++k) points.emplace_back(curve.x[k], curve.x[n + k]);
  return points;
}

}  // namespace fsi
