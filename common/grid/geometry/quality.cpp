#include "common/grid/geometry/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

/// Cross products of the edges that meet at the corners of the cells between two rows of points.
struct CellRow {
  const double *x0, *y0, *x1, *y1;

  CellRow(ConstFieldView x, int j)
      : x0(x.row(0, j)), y0(x.row(1, j)), x1(x.row(0, j + 1)), y1(x.row(1, j + 1)) {}

  /// Smallest corner area of cell i. Corners that share an edge share its differences.
  double smallest(int i) const {
    const double bx = x0[i + 1] - x0[i], by = y0[i + 1] - y0[i], tx = x1[i + 1] - x1[i],
                 ty = y1[i + 1] - y1[i];
    const double lx = x1[i] - x0[i], ly = y1[i] - y0[i], rx = x1[i + 1] - x0[i + 1],
                 ry = y1[i + 1] - y0[i + 1];
    return std::min(std::min(bx * ly - by * lx, bx * ry - by * rx),
                    std::min(tx * ly - ty * lx, tx * ry - ty * rx));
  }
  /// Area of the rectangle with the mean sides of cell i.
  double size(int i) const {
    const double bx = x0[i + 1] - x0[i], by = y0[i + 1] - y0[i], tx = x1[i + 1] - x1[i],
                 ty = y1[i + 1] - y1[i];
    const double lx = x1[i] - x0[i], ly = y1[i] - y0[i], rx = x1[i + 1] - x0[i + 1],
                 ry = y1[i + 1] - y0[i + 1];
    return 0.25 * (std::sqrt(bx * bx + by * by) + std::sqrt(tx * tx + ty * ty)) *
           (std::sqrt(lx * lx + ly * ly) + std::sqrt(rx * rx + ry * ry));
  }
};

double smallest_of_row(const CellRow& cells, int count) {
  double smallest = std::numeric_limits<double>::infinity();
#pragma omp simd reduction(min : smallest)
  for (int i = 0; i < count; ++i) smallest = std::min(smallest, cells.smallest(i));
  return smallest;
}

/// The edges that meet at the four corners of a cell.
void add_cell(ConstFieldView x, int i, int j, GridQuality& quality) {
  double smallest = std::numeric_limits<double>::infinity(), largest = -smallest;
  for (int corner = 0; corner < 4; ++corner) {
    const int ic = i + corner % 2, jc = j + corner / 2, a = corner % 2 ? -1 : 1, b = corner / 2 ? -1 : 1;
    const double e1 = x(0, ic + a, jc) - x(0, ic, jc), e2 = x(1, ic + a, jc) - x(1, ic, jc);
    const double f1 = x(0, ic, jc + b) - x(0, ic, jc), f2 = x(1, ic, jc + b) - x(1, ic, jc);
    const double area = a * b * (e1 * f2 - e2 * f1);
    const double e = std::hypot(e1, e2), f = std::hypot(f1, f2);
    smallest = std::min(smallest, area);
    largest = std::max(largest, area);
    quality.max_skew = std::max(quality.max_skew, std::abs(e1 * f1 + e2 * f2) / (e * f));
    quality.max_aspect = std::max(quality.max_aspect, std::max(e / f, f / e));
  }
  quality.min_jacobian = std::min(quality.min_jacobian, smallest);
  quality.min_jacobian_ratio = std::min(quality.min_jacobian_ratio, smallest / largest);
}

}  // namespace

GridQuality quality_of(ConstFieldView x) {
  GridQuality quality{.min_jacobian = std::numeric_limits<double>::infinity(), .min_jacobian_ratio = 1};
  for (int j = 0; j + 1 < x.layout.n2; ++j) {
    for (int i = 0; i + 1 < x.layout.n1; ++i) add_cell(x, i, j, quality);
  }
  return quality;
}

double cell_quality(ConstFieldView x) {
  double quality = 1;
  for (int j = 0; j + 1 < x.layout.n2; ++j) {
    const CellRow cells(x, j);
#pragma omp simd reduction(min : quality)
    for (int i = 0; i < x.layout.n1 - 1; ++i) quality = std::min(quality, cells.smallest(i) / cells.size(i));
  }
  return quality;
}

void check_cells(ConstFieldView x, const std::string& name, double t) {
  for (int j = 0; j + 1 < x.layout.n2; ++j) {
    const CellRow cells(x, j);
    // A position that is no number hides from a minimum; its row's sum shows it.
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (int i = 0; i < x.layout.n1; ++i) sum += cells.x0[i] + cells.y0[i] + cells.x1[i] + cells.y1[i];
    if (smallest_of_row(cells, x.layout.n1 - 1) > 0 && std::isfinite(sum)) continue;
    for (int i = 0; i + 1 < x.layout.n1; ++i) {
      const double smallest = cells.smallest(i);
      if (smallest > 0 && std::isfinite(smallest)) continue;
      throw Diverged(fmt::format("the cell from here on is folded, corner area = {:.3g}", smallest),
                     {.t = t, .grid = name, .point = {i, j}, .position = {x(0, i, j), x(1, i, j)}});
    }
  }
}

namespace {

/// What is left of the line half-way to the first ghost line, and whether that is enough. The ghost line is continued
/// freely here; `fill_ghosts` bounds it where too little is left.
CrowdedCorner crowd_at(ConstFieldView x, Side curve, int i, double least) {
  const int out = curve == Side::bottom ? -1 : 1, j = curve == Side::bottom ? 0 : x.layout.n2 - 1;
  const auto at = [x](int k, int line) { return Vec2(x(0, k, line), x(1, k, line)); };
  const auto ghost = [&](int k) -> Vec2 { return 3 * (at(k, j) - at(k, j - out)) + at(k, j - 2 * out); };
  const Vec2 along = at(i + 1, j) - at(i - 1, j), behind = ghost(i + 1) - ghost(i - 1);
  const double share = 0.5 * (1 + behind.dot(along) / along.squaredNorm());
  const double part = share < 1 ? (1 - least) / (1 - share) : std::numeric_limits<double>::infinity();
  return {.point = i, .spacing = part * (at(i, j - out) - at(i, j)).norm(), .part = part, .x = at(i, j)};
}

}  // namespace

std::optional<CrowdedCorner> crowded_corner(ConstFieldView x, Side curve) {
  std::optional<CrowdedCorner> worst;
  for (int i = 0; i < x.layout.n1; ++i) {
    const CrowdedCorner here = crowd_at(x, curve, i, least_share);
    if (here.part < (worst ? worst->part : 1)) worst = here;
  }
  return worst;
}

namespace {

/// Of the points next to corners, or of all others.
std::optional<CrowdedCorner> most_crowded(ConstFieldView x, Side curve, std::span<const int> corners,
                                          bool at_corners, double least) {
  const int period = x.layout.n1 - 1;
  const auto is_beside_corner = [&](int i) {
    return std::ranges::any_of(corners, [&](int corner) {
      const int apart = std::abs(i - corner);
      return std::min(apart, period - apart) <= 1;
    });
  };
  std::optional<CrowdedCorner> worst;
  for (int i = 0; i < x.layout.n1; ++i) {
    if (is_beside_corner(i) != at_corners) continue;
    const CrowdedCorner here = crowd_at(x, curve, i, least);
    if (here.part < (worst ? worst->part : std::numeric_limits<double>::infinity())) worst = here;
  }
  return worst;
}

}  // namespace

std::optional<CrowdedCorner> most_crowded_bend(ConstFieldView x, Side curve, std::span<const int> corners) {
  return most_crowded(x, curve, corners, false, least_share_of_turns);
}

std::optional<CrowdedCorner> most_crowded_corner(ConstFieldView x, Side curve, std::span<const int> corners,
                                                 double least) {
  return most_crowded(x, curve, corners, true, least);
}

SlantedLine most_slanted_line(ConstFieldView x, Side curve) {
  const int in = curve == Side::bottom ? 1 : -1, j = curve == Side::bottom ? 0 : x.layout.n2 - 1;
  const auto at = [x](int i, int line) { return Vec2(x(0, i, line), x(1, i, line)); };
  SlantedLine worst;
  for (int i = 0; i < x.layout.n1; ++i) {
    const Vec2 along = 0.5 * (at(i + 1, j) - at(i - 1, j)), across = at(i, j + in) - at(i, j);
    const double slant = std::abs(across.dot(along)) / along.squaredNorm();
    if (slant > worst.slant) worst = {.point = i, .slant = slant, .x = at(i, j)};
  }
  return worst;
}

}  // namespace fsi::grid
