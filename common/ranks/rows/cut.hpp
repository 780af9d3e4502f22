#pragma once
/// Which rank owns which rows of which component grid: the rows of all grids, one grid after the other, cut into
/// as many pieces as there are ranks, of about as many points to advance each.

#include <cstddef>
#include <span>
#include <vector>

#include "common/core/field.hpp"
#include "common/grid/intervals.hpp"
#include "common/ranks/rows/rank_rows.hpp"

namespace fsi {

/// A component grid, as far as its cut depends on it.
struct CutGrid {
  Layout layout;
  bool periodic2 = false;
  const grid::RowSets* discretised = nullptr;
  int halo = RankRows::halo;  ///< rows around one's own that are brought
};

/// Part of a row of a grid: points begin <= i < end; j may be that of a ghost row.
struct Strip {
  int grid = 0, j = 0, begin = 0, end = 0;
  bool operator==(const Strip&) const = default;
};

class Cut {
 public:
  Cut() = default;
  /// Every piece's end is moved by up to `shift` of a piece, to one side or the other (tests).
  Cut(std::span<const CutGrid> grids, int ranks, double shift = 0);

  int ranks() const { return static_cast<int>(first_.size()) - 1; }
  grid::RowRange own(int grid, int rank) const;
  /// Own rows and halo of a rank, in grid rows; empty where it owns none. See RankRows.
  std::vector<grid::RowRange> halos(int grid, int rank) const;
  /// A ghost row belongs to whom the row next to it belongs to.
  int owner(int grid, int j) const;
  /// Points to advance of the busiest rank, against those of all ranks' mean.
  double imbalance(std::span<const CutGrid> grids) const;

 private:
  struct Rows {
    int first = 0;  ///< number of its first row among those of all grids
    int n2 = 0;
    bool periodic2 = false;
    int halo = 0;
  };
  std::vector<Rows> grids_;
  std::vector<int> first_;  ///< of each rank, among the rows of all grids; at the end their count
};

}  // namespace fsi
