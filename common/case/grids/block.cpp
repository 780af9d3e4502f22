#include "common/case/grids/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/case/grids/grid_points.hpp"
#include "common/case/grids/node_tools.hpp"

namespace fsi {

namespace {

/// Counter-clockwise: side k goes from corner k to corner k + 1.
constexpr std::array<Side, 4> in_turn{Side::bottom, Side::right, Side::top, Side::left};

std::size_t turn_of(Side side) {
  return static_cast<std::size_t>(std::ranges::find(in_turn, side) - in_turn.begin());
}

Vec2 point_at(const CurveSpec& curve, int k) {
  const auto n = static_cast<std::size_t>(curve.points()), at = static_cast<std::size_t>(k);
  return {curve.x[at], curve.x[n + at]};
}

/// Numbers of the points at the ends of the sides, the first one again at the end of a closed outline.
std::vector<int> ends_of_sides(const CurveSpec& outline) {
  std::vector<int> ends = outline.corners;
  if (outline.closed()) {
    if (!ends.empty()) ends.push_back(ends.front() + outline.points() - 1);
    return ends;
  }
  ends.insert(ends.begin(), 0);
  ends.push_back(outline.points() - 1);
  return ends;
}

/// "" where all points between two ends lie on a line.
std::string kink_between(const CurveSpec& outline, int first, int last) {
  const int count = outline.points() - (outline.closed() ? 1 : 0);
  const Vec2 a = point_at(outline, first % count), b = point_at(outline, last % count);
  const Vec2 along = (b - a).normalized();
  constexpr double straight = 1e-6;
  for (int k = first + 1; k < last; ++k) {
    const Vec2 x = point_at(outline, k % count) - a;
    if (std::abs(along[0] * x[1] - along[1] * x[0]) <= straight * (b - a).norm()) continue;
    return fmt::format("its side from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) is not straight", a[0], a[1], b[0],
                       b[1]);
  }
  return "";
}

/// A corner at which the outline turns away from the body.
std::string hollow_among(const std::array<Vec2, 4>& x) {
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 in = x[k] - x[(k + 3) % 4], out = x[(k + 1) % 4] - x[k];
    if (in[0] * out[1] - in[1] * out[0] <= 0)
      return fmt::format("it is hollow at ({:.6g}, {:.6g})", x[k][0], x[k][1]);
  }
  return "";
}

/// Which of the sides of a closed outline is the bottom: the one that goes most to the right.
std::size_t bottom_among(const std::array<Vec2, 4>& x) {
  std::size_t best = 0;
  double most = -2;
  for (std::size_t k = 0; k < 4; ++k) {
    const double to_the_right = (x[(k + 1) % 4] - x[k]).normalized()[0];
    constexpr double round_off = 1e-9;
    if (to_the_right > most + round_off) most = to_the_right, best = k;
  }
  return best;
}

}  // namespace

BlockCorners block_corners(const CurveSpec& outline) {
  const std::vector<int> ends = ends_of_sides(outline);
  const bool closed = outline.closed();
  const auto corners = std::max(static_cast<int>(ends.size()) - (closed ? 1 : 0), 0);
  if (corners != 4)
    return {.at = {}, .why_not = fmt::format("it has {} corners{}", corners, closed ? "" : " with its feet")};
  if (!closed && outline.walls->front() != outline.walls->back())
    return {.at = {}, .why_not = "it stands on two walls"};
  for (std::size_t k = 1; k < ends.size(); ++k) {
    if (std::string bend = kink_between(outline, ends[k - 1], ends[k]); !bend.empty())
      return {.at = {}, .why_not = std::move(bend)};
  }
  std::array<Vec2, 4> x, placed;
  for (std::size_t k = 0; k < 4; ++k) x[k] = point_at(outline, ends[k]);
  if (std::string hollow = hollow_among(x); !hollow.empty()) return {.at = {}, .why_not = std::move(hollow)};
  // Where the first of these corners is in the grid.
  const std::size_t first = closed ? 4 - bottom_among(x) : turn_of(outline.walls->front()) + 1;
  for (std::size_t k = 0; k < 4; ++k) placed[(first + k) % 4] = x[k];
  return {.at = placed};
}

bool leaves_block_open(const config::Node& solid) {
  const config::Node* grid = solid.find("grid");
  const config::Node* kind = grid == nullptr ? nullptr : grid->find("kind");
  if (kind != nullptr && kind->text == "block") return true;
  return config::lacks(grid, {"x", "y", "map", "kind"}) &&
         config::lacks(solid.find("body_fitted"), {"lines", "spacing", "growth", "concave_smoothing", "map"});
}

std::array<int, 2> block_points(const std::array<Vec2, 4>& corners, double h) {
  const auto length = [&](std::size_t side) { return (corners[(side + 1) % 4] - corners[side]).norm(); };
  const std::array lengths = {0.5 * (length(0) + length(2)), 0.5 * (length(1) + length(3))};
  constexpr double fewest = 4, most = 1e8, longest = 1.5;  // cells, cells, widths of a cell
  const double width = longest * std::min(lengths[0], lengths[1]) / fewest;
  const auto points = [&](double side) {
    return static_cast<int>(std::lround(std::clamp(side / std::min(h, width), fewest, most))) + 1;
  };
  return {points(lengths[0]), points(lengths[1])};
}

std::vector<Side> sides_along(const CurveSpec& outline) {
  if (outline.closed()) return {in_turn.begin(), in_turn.end()};
  const std::size_t wall = turn_of(outline.walls->front());
  std::vector<Side> sides;
  for (std::size_t k = 1; k < 4; ++k) sides.push_back(in_turn[(wall + k) % 4]);
  return sides;
}

CurveSpec block_outline(const GridSpec& grid, CurveSpec outline) {
  std::vector<Vec2> points;
  outline.corners.clear();
  outline.elastic_corners = true;
  for (const Side side : sides_along(outline)) {
    const int n = points_along(grid, side);
    if (!points.empty()) points.pop_back();
    if (outline.closed() || !points.empty()) outline.corners.push_back(static_cast<int>(points.size()));
    for (int k = 0; k < n; ++k)
      points.push_back(side_point(grid, side, runs_against_outline(side) ? n - 1 - k : k));
  }
  const std::size_t n = points.size();
  outline.x.resize(2 * n);
  double length = 0;
  for (std::size_t k = 0; k < n; ++k) {
    outline.x[k] = points[k][0];
    outline.x[n + k] = points[k][1];
    if (k > 0) length += (points[k] - points[k - 1]).norm();
  }
  outline.spacing = length / static_cast<double>(n - 1);
  return outline;
}

}  // namespace fsi
