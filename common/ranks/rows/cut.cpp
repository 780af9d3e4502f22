#include "common/ranks/rows/cut.hpp"

#include <algorithm>
#include <utility>

namespace fsi {

namespace {

/// Points to advance up to each row of some grids.
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

/// The first row of each rank, and the count of rows.
std::vector<int> rows_of_ranks(std::span<const double> work, int ranks, double shift) {
  const int rows = static_cast<int>(work.size()) - 1;
  const double piece = work.back() / ranks;
  std::vector<int> first;
  for (int rank = 0; rank < ranks; ++rank) {
    const double end = piece * (rank + (rank > 0 ? (rank % 2 == 0 ? shift : -shift) : 0));
    const auto row = std::ranges::lower_bound(work, end);
    const int least = first.empty() ? 0 : first.back();
    first.push_back(rank == 0 ? 0 : std::clamp(static_cast<int>(row - work.begin()), least, rows));
  }
  first.push_back(rows);
  return first;
}

}  // namespace

Cut::Cut(std::span<const CutGrid> grids, int ranks, Pieces pieces, double shift)
    : pieces_(pieces), ranks_(ranks) {
  const bool each = pieces == Pieces::of_each_grid;
  const std::vector<int> of_all = each ? std::vector<int>{} : rows_of_ranks(work_before(grids), ranks, shift);
  int before = 0;
  for (const CutGrid& grid : grids) {
    const int n2 = grid.layout.n2;
    std::vector<int> first = each ? rows_of_ranks(work_before({&grid, 1}), ranks, shift) : of_all;
    for (int& row : first) row = std::clamp(row - before, 0, n2);
    if (!each) before += n2;
    grids_.push_back({.n2 = n2, .periodic2 = grid.periodic2, .halo = grid.halo, .first = std::move(first)});
  }
}

grid::RowRange Cut::own(int grid, int rank) const {
  const std::vector<int>& first = grids_[static_cast<std::size_t>(grid)].first;
  const auto r = static_cast<std::size_t>(rank);
  return {first[r], first[r + 1]};
}

std::vector<grid::RowRange> Cut::halos(int grid, int rank) const {
  const grid::RowRange rows = own(grid, rank);
  if (rows.first >= rows.end) return {};
  const Rows& of_grid = grids_[static_cast<std::size_t>(grid)];
  const int n2 = of_grid.n2;
  std::vector<grid::RowRange> halos{{rows.first - of_grid.halo, rows.end + of_grid.halo}};
  if (!of_grid.periodic2) return halos;
  // Ghost row -1 is row n2 - 2, ghost row n2 is row 1, and row n2 - 1 is row 0.
  const auto [low, high] = halos.front();
  if (low < 0) halos.push_back({std::max(n2 - 1 + low, 0), n2});
  if (high >= n2) halos.push_back({0, std::min(high - n2 + 1, n2)});
  return halos;
}

int Cut::owner(int grid, int j) const {
  const auto& [n2, periodic2, halo, first] = grids_[static_cast<std::size_t>(grid)];
  const int row = std::clamp(j, 0, n2 - 1);
  return static_cast<int>(std::upper_bound(first.begin(), first.end() - 1, row) - first.begin()) - 1;
}

double Cut::imbalance(std::span<const CutGrid> grids) const {
  std::vector<double> all(static_cast<std::size_t>(ranks_));
  double total = 0, most_of_each = 0;
  for (std::size_t k = 0; k < grids.size(); ++k) {
    const std::vector<double> work = work_before(grids.subspan(k, 1));
    double most = 0;
    for (std::size_t rank = 0; rank < all.size(); ++rank) {
      const auto [first, end] = own(static_cast<int>(k), static_cast<int>(rank));
      const double here = work[static_cast<std::size_t>(end)] - work[static_cast<std::size_t>(first)];
      all[rank] += here;
      most = std::max(most, here);
    }
    most_of_each += most;
    total += work.back();
  }
  return (pieces_ == Pieces::of_each_grid ? most_of_each : std::ranges::max(all)) * ranks_ / total;
}

}  // namespace fsi
