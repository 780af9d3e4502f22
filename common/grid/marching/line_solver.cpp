#include "common/grid/marching/line_solver.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace fsi::grid {

LineSolver::LineSolver(std::size_t unknowns)
    : rows_(unknowns), seam_(unknowns, Mat2::Zero()), x_(unknowns, Vec2::Zero()) {}

namespace {

/// A row after elimination: its unknown = right - onward (next unknown) + seam (last unknown). Kept in
/// registers from row to row, for the next one waits for it.
struct DoneRow {
  Mat2 onward, seam;
  Vec2 right;
};

/// One step of an elimination: from the row done before to this one.
[[gnu::always_inline]] inline void advance(DoneRow& done, const Mat2& diagonal, const Mat2& back,
                                           const Mat2& onward, const Vec2& right, const Mat2& seam) {
  const Mat2 d = diagonal - back.lazyProduct(done.onward);
  const double scale = 1 / (d(0, 0) * d(1, 1) - d(0, 1) * d(1, 0));
  Mat2 inverse;
  inverse << scale * d(1, 1), -scale * d(0, 1), -scale * d(1, 0), scale * d(0, 0);
  const Vec2 r = right - back.lazyProduct(done.right);
  const Mat2 s = seam - back.lazyProduct(done.seam);
  done.onward = inverse.lazyProduct(onward);
  done.right = inverse.lazyProduct(r);
  done.seam = inverse.lazyProduct(s);
}

}  // namespace

/// Solves for the first `count` unknowns: right and seam_ become their values and their answers to the seam.
/// Both ends are eliminated towards the middle in one loop: two chains of dependent operations instead of one
/// of twice the length.
void LineSolver::solve_first(std::size_t count) {
  const std::size_t last = count - 1, middle = count / 2;
  DoneRow low{Mat2::Zero(), Mat2::Zero(), Vec2::Zero()}, high = low;
  const auto step_up = [&](std::size_t k) {
    LineRow& row = rows_[k];
    advance(low, row.diagonal, row.below, row.above, row.right, seam_[k]);
    row.above = low.onward, row.right = low.right, seam_[k] = low.seam;
  };
  const auto step_down = [&](std::size_t k) {
    LineRow& row = rows_[k];
    advance(high, row.diagonal, row.above, row.below, row.right, seam_[k]);
    row.below = high.onward, row.right = high.right, seam_[k] = high.seam;
  };
  // Below the middle lie `middle` rows, above it as many or one less.
  for (std::size_t k = 0; k < last - middle; ++k) step_up(k), step_down(last - k);
  for (std::size_t k = last - middle; k < middle; ++k) step_up(k);
  LineRow& centre = rows_[middle];
  centre.diagonal -= centre.above * high.onward;
  centre.right -= centre.above * high.right;
  seam_[middle] -= centre.above * high.seam;
  step_up(middle);
  for (std::size_t k = 1; k <= middle; ++k) {
    LineRow& row = rows_[middle - k];
    row.right -= row.above * rows_[middle - k + 1].right;
    seam_[middle - k] -= row.above * seam_[middle - k + 1];
    if (middle + k > last) continue;
    LineRow& other = rows_[middle + k];
    other.right -= other.below * rows_[middle + k - 1].right;
    seam_[middle + k] -= other.below * seam_[middle + k - 1];
  }
}

std::span<const Vec2> LineSolver::solve_open() {
  std::ranges::fill(seam_, Mat2::Zero());
  solve_first(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) x_[k] = rows_[k].right;
  return x_;
}

std::span<const Vec2> LineSolver::solve_closed() {
  // All unknowns but the last as an open line: x = right + seam
  // z, z the last unknown, which its own row then gives.
  const std::size_t last = rows_.size() - 1;
  std::ranges::fill(seam_, Mat2::Zero());
  seam_[0] = -rows_[0].below;
  seam_[last - 1] = -rows_[last - 1].above;
  solve_first(last);
  const LineRow& row = rows_[last];
  const Mat2 own = row.diagonal + row.below * seam_[last - 1] + row.above * seam_[0];
  const Vec2 right = row.right - row.below * rows_[last - 1].right - row.above * rows_[0].right;
  x_[last] = own.inverse() * right;
  for (std::size_t k = 0; k < last; ++k) x_[k] = rows_[k].right + seam_[k] * x_[last];
  return x_;
}

}  // namespace fsi::grid
