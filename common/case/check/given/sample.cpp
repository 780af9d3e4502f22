#include "common/case/check/given/sample.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>

#include "common/case/grids/curve_side.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/grid/geometry/outline.hpp"

namespace fsi {

namespace {

/// Every so many points of n, so that about `samples` remain.
int stride(int n, int samples) {
  return std::max(1, (n - 1) / samples);
}

/// Whether a place is in the body that a grid is to cover.
bool in_body(const SolidSpec& solid, const Vec2& x) {
  if (fitted_grids(solid).empty()) return true;
  const CurveSpec& curve = solid.body_fitted.front().curve;
  return curve.closed() && grid::encloses(curve.x, x);
}

using Box = Eigen::AlignedBox2d;

/// Around all that may lie behind a curve: behind the closed outline of a body the body lies.
Box box_of(const BodyFittedSpec& fitted) {
  Box box(Vec2::Constant(-std::numeric_limits<double>::infinity()),
          Vec2::Constant(std::numeric_limits<double>::infinity()));
  if (fitted.solid.empty() || !fitted.curve.closed()) return box;
  box.setEmpty();
  for (const Vec2& x : outline_points(fitted.curve)) box.extend(x);
  return box;
}

/// What lies behind curves fitted to a gas goes, the k-th curve apart.
void leave_out_behind(std::vector<Vec2>& points, const FluidSpec& fluid,
                      std::optional<std::size_t> apart = {}) {
  for (std::size_t k = 0; k < fluid.body_fitted.size(); ++k) {
    if (k == apart) continue;
    const BodyFittedSpec& fitted = fluid.body_fitted[k];
    const Box box = box_of(fitted);
    std::erase_if(points,
                  [&](const Vec2& x) { return box.contains(x) && lies_behind(fitted, fluid.grid, x); });
  }
}

constexpr int samples_of_body = 16;  // in each direction
/// The same of a gas, or along its sides: what is smaller than a hundredth of it may be missed.
constexpr int samples_of_gas = 96;

}  // namespace

std::vector<Vec2> sample_points(const GridSpec& grid, std::optional<Side> side, double t) {
  std::vector<Vec2> points;
  if (side) {
    const int last = points_along(grid, *side) - 1, samples = std::min(last, samples_of_gas);
    for (int a = 0; a <= samples; ++a) points.push_back(side_point(grid, *side, a * last / samples, t));
    return points;
  }
  constexpr int samples = 8;  // in each direction
  for (int b = 0; b <= samples; ++b) {
    for (int a = 0; a <= samples; ++a) {
      points.push_back(position(grid, a * (grid.n1 - 1) / samples, b * (grid.n2 - 1) / samples, t));
    }
  }
  return points;
}

std::vector<Vec2> sample_points(const FluidSpec& fluid) {
  std::vector<Vec2> points;
  const GridSpec& grid = fluid.grid;
  const int last1 = std::min(grid.n1 - 1, samples_of_gas), last2 = std::min(grid.n2 - 1, samples_of_gas);
  for (int b = 0; b <= last2; ++b) {
    for (int a = 0; a <= last1; ++a)
      points.push_back(position(grid, a * (grid.n1 - 1) / last1, b * (grid.n2 - 1) / last2, 0));
  }
  if (fluid.refine.levels == 1) leave_out_behind(points, fluid);
  return points;
}

std::vector<Vec2> curve_points(const FluidSpec& fluid, std::size_t k) {
  std::vector<Vec2> points = outline_points(fluid.body_fitted[k].curve);
  leave_out_behind(points, fluid, k);
  return points;
}

std::vector<Vec2> sample_points(const SolidSpec& solid) {
  std::vector<Vec2> points;
  if (!fitted_grids(solid).empty()) {
    constexpr std::size_t most = 64;
    const std::vector<Vec2> outline = outline_points(solid.body_fitted.front().curve);
    for (std::size_t k = 0; k < outline.size(); k += std::max<std::size_t>(1, outline.size() / most))
      points.push_back(outline[k]);
  }
  const GridSpec& grid = solid.grid;
  for (int b = 0; b <= samples_of_body; ++b) {
    for (int a = 0; a <= samples_of_body; ++a) {
      const Vec2 x =
          position(grid, a * (grid.n1 - 1) / samples_of_body, b * (grid.n2 - 1) / samples_of_body, 0);
      if (in_body(solid, x)) points.push_back(x);
    }
  }
  return points;
}

std::vector<BodyCell> sample_cells(const SolidSpec& solid) {
  const GridSpec& grid = solid.grid;
  std::vector<BodyCell> cells;
  for (int j = 0; j + 1 < grid.n2; j += stride(grid.n2, samples_of_body)) {
    for (int i = 0; i + 1 < grid.n1; i += stride(grid.n1, samples_of_body)) {
      const Vec2 x = position(grid, i, j, 0), x1 = position(grid, i + 1, j, 0),
                 x2 = position(grid, i, j + 1, 0);
      if (in_body(solid, x) && in_body(solid, x1) && in_body(solid, x2))
        cells.push_back({.x = x, .edge1 = x1 - x, .edge2 = x2 - x});
    }
  }
  return cells;
}

std::vector<Vec2> outline_points(const CurveSpec& curve) {
  const std::size_t n = curve.x.size() / 2;
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < n; ++k) points.emplace_back(curve.x[k], curve.x[n + k]);
  return points;
}

}  // namespace fsi
