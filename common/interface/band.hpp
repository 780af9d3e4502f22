#pragma once
/// Symmetric matrices whose entries lie near the diagonal, as those of a beam do, whose nodes follow each other along a line.
///
///     x .         a column holds its entry of the diagonal and the `width` below it,
///     x x .       with zeros where the matrix ends
///     . x x .
///     0 . x x

#include <Eigen/Core>
#include <vector>

namespace fsi {

/// S = L D L^T without pivoting.
class BandedFactors {
 public:
  /// All entries zero. @param width largest distance of an entry from the diagonal
  void resize(Eigen::Index rows, Eigen::Index width);
  void set_zero();

  Eigen::Index rows() const { return rows_; }
  /// Of the entries of the lower triangle.
  double* values() { return values_.data(); }
  /// Where an entry of the lower triangle is among them.
  Eigen::Index place(Eigen::Index row, Eigen::Index column) const { return column * stride_ + row - column; }

  /// Puts the factors in the place of the matrix. @return false for a pivot of the size of round-off
  bool factorize();
  /// Solution of S x = right, with the factors.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  Eigen::Index rows_ = 0, width_ = 0, blocks_ = 0;
  Eigen::Index stride_ = 0;      ///< from column to column
  std::vector<double> values_;   ///< columns, each followed by zeros
  std::vector<double> inverse_;  ///< of the pivots
};

/// A pivot that is less than this part of the diagonal it comes from is round-off.
inline constexpr double pivot_round_off = 1e-14;

}  // namespace fsi
