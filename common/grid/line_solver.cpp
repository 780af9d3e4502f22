#include "common/grid/line_solver.hpp"

#include <Eigen/LU>

namespace fsi::grid {

LineSolver::LineSolver(std::size_t unknowns) : rows_(unknowns), seam_(unknowns), x_(unknowns) {}

std::span<const Vec2> LineSolver::solve_open() {
  const std::size_t n = rows_.size();
  for (std::size_t k = 0; k < n; ++k) {
    LineRow& row = rows_[k];
    if (k > 0) {
      row.diagonal -= row.below * rows_[k - 1].above;
      row.right -= row.below * rows_[k - 1].right;
    }
    const Mat2 inverse = row.diagonal.inverse();
    row.above = (inverse * row.above).eval();
    row.right = (inverse * row.right).eval();
  }
  x_[n - 1] = rows_[n - 1].right;
  for (std::size_t k = n - 1; k-- > 0;) x_[k] = rows_[k].right - rows_[k].above * x_[k + 1];
  return x_;
}

std::span<const Vec2> LineSolver::solve_closed() {
  // All unknowns but the last as an open line: x = y + seam z, z the last unknown, which its own row then
  // gives.
  const std::size_t last = rows_.size() - 1;
  for (std::size_t k = 0; k < last; ++k) {
    LineRow& row = rows_[k];
    seam_[k] = k == 0 ? Mat2(-row.below) : Mat2::Zero();
    if (k > 0) {
      row.diagonal -= row.below * rows_[k - 1].above;
      row.right -= row.below * rows_[k - 1].right;
      seam_[k] -= row.below * seam_[k - 1];
    }
    if (k == last - 1) seam_[k] -= row.above;
    const Mat2 inverse = row.diagonal.inverse();
    row.above = (inverse * row.above).eval();
    row.right = (inverse * row.right).eval();
    seam_[k] = (inverse * seam_[k]).eval();
  }
  for (std::size_t k = last - 1; k-- > 0;) {
    rows_[k].right -= rows_[k].above * rows_[k + 1].right;
    seam_[k] -= rows_[k].above * seam_[k + 1];
  }
  const LineRow& row = rows_[last];
  const Mat2 own = row.diagonal + row.below * seam_[last - 1] + row.above * seam_[0];
  const Vec2 right = row.right - row.below * rows_[last - 1].right - row.above * rows_[0].right;
  x_[last] = own.inverse() * right;
  for (std::size_t k = 0; k < last; ++k) x_[k] = rows_[k].right + seam_[k] * x_[last];
  return x_;
}

}  // namespace fsi::grid
