#include "fluid_solver/levels/flags.hpp"

#include <algorithm>
#include <cmath>

namespace fsi::fluid {

namespace {

/// Asks early for the values of runs: short ones, one above the other, are far away in memory.
void fetch(ConstFieldView q, int plane, const grid::RowSets& points, int j) {
  constexpr int line = 8;  // points
  if (j >= points.rows()) return;
  const double* row = q.row(plane, j);
  for (const grid::Interval& run : points.row(j)) {
    for (int i = run.begin; i < run.end + line; i += line) __builtin_prefetch(row + i);
  }
}

}  // namespace

void widen(ValueRange& range, ConstFieldView q, int plane, const grid::RowSets& points, const RankRows& own) {
  for (int j = 0; j < points.rows(); ++j) {
    if (!own.owns(j)) continue;
    constexpr int ahead = 8;  // rows
    fetch(q, plane, points, j + ahead);
    const double* row = q.row(plane, j);
    for (const grid::Interval& run : points.row(j)) {
      double low = range.low, high = range.high;
#pragma omp simd reduction(min : low) reduction(max : high)
      for (int i = run.begin; i < run.end; ++i) {
        low = std::min(low, row[i]);
        high = std::max(high, row[i]);
      }
      range = {low, high};
    }
  }
}

void flag_bends(ConstFieldView q, const Bends& wanted, const CellMask& known, const RankRows& own,
                CellMask& flags) {
  const auto [plane, least] = wanted;
  const Layout& shape = q.layout;
  const auto bends = [least = least](double before, double here, double after) -> std::uint8_t {
    return std::fabs(before - 2 * here + after) > least ? 1 : 0;
  };
  const grid::RowSets runs = known.rows();
  for (int j = 0; j < shape.n2; ++j) {
    if (!own.owns(j)) continue;
    const double *value = q.row(plane, j), *lower = q.row(plane, j - 1), *upper = q.row(plane, j + 1);
    std::uint8_t* flag = flags.row(j);
    for (const auto& [begin, end] : runs.row(j)) {
#pragma omp simd
      for (int i = begin + 1; i < end - 1; ++i)
        flag[i] = flag[i] | bends(value[i - 1], value[i], value[i + 1]);
      if (j == 0 || j + 1 == shape.n2) continue;
      const std::uint8_t *below = known.row(j - 1), *above = known.row(j + 1);
#pragma omp simd
      for (int i = begin; i < end; ++i)
        flag[i] = flag[i] | (below[i] & above[i] & bends(lower[i], value[i], upper[i]));
    }
  }
}

void flag_bodies(const grid::CompositeGrid& grids, std::span<const ConstFieldView> x, CellMask& flags) {
  const grid::CartesianGrid& background = grids.background();
  mark_coarse(gaps_of(grids.discretised(0), background.n1), flags);
  const auto index = [](double place, double low, double spacing, int n) {
    return coarse_index(std::clamp(static_cast<int>(std::lround((place - low) / spacing)), 0, n - 1));
  };
  for (int k = 1; k < grids.grids(); ++k) {
    const ConstFieldView points = x[static_cast<std::size_t>(k) - 1];
    for (int j = 0; j < points.layout.n2; ++j) {
      for (int i = 0; i < points.layout.n1; ++i) {
        flags.set(index(points(0, i, j), background.x_a, background.dx(), background.n1),
                  index(points(1, i, j), background.y_a, background.dy(), background.n2));
      }
    }
  }
}

}  // namespace fsi::fluid
