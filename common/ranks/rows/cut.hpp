#pragma once
/// Which rank owns which rows of which component grid: the rows of all grids, one grid after the other, cut into
/// as many pieces as there are ranks, of about as many points to advance each; or the rows of each grid by itself.

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
  const grid::RowSets* averaged = nullptr;  ///< points that get averages of a finer level; null: none
  int halo = RankRows::halo;                ///< rows around one's own that are brought
};

/// What is cut into pieces.
enum class Pieces {
  of_all_grids,  ///< the rows of all grids, one grid after the other
  of_each_grid,  ///< each grid: where ranks wait for each other after each of them, as with levels
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
  Cut(std::span<const CutGrid> grids, int ranks, Pieces pieces = Pieces::of_all_grids, double shift = 0);

  int ranks() const { return ranks_; }
  grid::RowRange own(int grid, int rank) const;
  /// Own rows and halo of a rank, in grid rows; empty where it owns none. See RankRows.
  std::vector<grid::RowRange> halos(int grid, int rank) const;
  /// A ghost row belongs to whom the row next to it belongs to.
  int owner(int grid, int j) const;
  /// Points to advance of the busiest rank, of all grids or grid by grid, against those of all ranks' mean.
  double imbalance(std::span<const CutGrid> grids) const;

 private:
  struct Rows {
    int n2 = 0;
    bool periodic2 = false;
    int halo = 0;
    std::vector<int> first;  ///< row of each rank; at the end their count
  };
  Pieces pieces_ = Pieces::of_all_grids;
  int ranks_ = 0;
  std::vector<Rows> grids_;
};

}  // namespace fsi
