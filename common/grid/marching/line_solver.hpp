#pragma once
/// Block-tridiagonal systems of 2 x 2 blocks along a line of points, open or closed, by elimination.

#include <cstddef>
#include <span>
#include <vector>

#include "common/core/types.hpp"

namespace fsi::grid {

/// below x[k - 1] + diagonal x[k] + above x[k + 1] = right
struct LineRow {
  Mat2 below, diagonal, above;
  Vec2 right;
};

class LineSolver {
 public:
  explicit LineSolver(std::size_t unknowns = 0);

  /// Rows to be filled before every solve.
  std::span<LineRow> rows() { return rows_; }
  /// Ends decoupled: below of the first and above of the last row do not count. The rows are used up.
  std::span<const Vec2> solve_open();
  /// The first and the last unknown are neighbours. The rows are used up.
  std::span<const Vec2> solve_closed();

 private:
  std::vector<LineRow> rows_;
  std::vector<Mat2> seam_;  ///< how each unknown answers to the last one of a closed line
  std::vector<Vec2> x_;

  void solve_first(std::size_t count);
};

}  // namespace fsi::grid
