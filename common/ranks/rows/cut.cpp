#include "common/ranks/rows/cut.hpp"

#include <algorithm>

namespace fsi {

namespace {

/// Points to advance up to each row of all grids.
std::vector<double> work_before(std::span<const CutGrid> grids) {
  std::vector<double> work{0};
  for (const CutGrid& grid : grids) {
    for (int j = 0; j < grid.layout.n2; ++j) {
      double points = 0;
      for (const grid::Interval& run : grid.discretised->row(j)) points += run.end - run.begin;
      work.push_back(work.back() + points);
    }
  }
  return work;
}

}  // namespace

Cut::Cut(std::span<const CutGrid> grids, int ranks, double shift) {
  int rows = 0;
  for (const CutGrid& grid : grids) {
    grids_.push_back({.first = rows, .n2 = grid.layout.n2, .periodic2 = grid.periodic2, .halo = grid.halo});
    rows += grid.layout.n2;
  }
  const std::vector<double> work = work_before(grids);
  const double piece = work.back() / ranks;
  for (int rank = 0; rank < ranks; ++rank) {
    const double end = piece * (rank + (rank > 0 ? (rank % 2 == 0 ? shift : -shift) : 0));
    const auto row = std::ranges::lower_bound(work, end);
    const int least = first_.empty() ? 0 : first_.back();
    first_.push_back(rank == 0 ? 0 : std::clamp(static_cast<int>(row - work.begin()), least, rows));
  }
  first_.push_back(rows);
}

grid::RowRange Cut::own(int grid, int rank) const {
  const auto& [first, n2, periodic2, halo] = grids_[static_cast<std::size_t>(grid)];
  const auto r = static_cast<std::size_t>(rank);
  return {std::clamp(first_[r] - first, 0, n2), std::clamp(first_[r + 1] - first, 0, n2)};
}

std::vector<grid::RowRange> Cut::halos(int grid, int rank) const {
  const grid::RowRange rows = own(grid, rank);
  if (rows.first >= rows.end) return {};
  const auto& [first, n2, periodic2, halo] = grids_[static_cast<std::size_t>(grid)];
  std::vector<grid::RowRange> halos{{rows.first - halo, rows.end + halo}};
  if (!periodic2) return halos;
  // Ghost row -1 is row n2 - 2, ghost row n2 is row 1, and row n2 - 1 is row 0.
  const auto [low, high] = halos.front();
  if (low < 0) halos.push_back({std::max(n2 - 1 + low, 0), n2});
  if (high >= n2) halos.push_back({0, std::min(high - n2 + 1, n2)});
  return halos;
}

int Cut::owner(int grid, int j) const {
  const Rows& rows = grids_[static_cast<std::size_t>(grid)];
  const int row = rows.first + std::clamp(j, 0, rows.n2 - 1);
  return static_cast<int>(std::upper_bound(first_.begin(), first_.end() - 1, row) - first_.begin()) - 1;
}

double Cut::imbalance(std::span<const CutGrid> grids) const {
  const std::vector<double> work = work_before(grids);
  double most = 0;
  for (int rank = 0; rank < ranks(); ++rank) {
    const auto r = static_cast<std::size_t>(rank);
    most = std::max(
        most, work[static_cast<std::size_t>(first_[r + 1])] - work[static_cast<std::size_t>(first_[r])]);
  }
  return most * ranks() / work.back();
}

}  // namespace fsi
