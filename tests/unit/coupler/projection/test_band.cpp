/// Symmetric matrices near their diagonal, and the sums a ModalSolver makes of them.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/interface/band.hpp"
#include "common/interface/modal_system.hpp"
#include "common/wire/sparse.hpp"

namespace fsi {
namespace {

/// Entries as irregular as can be, up to `width` from the diagonal; positive definite.
Eigen::MatrixXd banded(Eigen::Index rows, Eigen::Index width) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(rows, rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    S(k, k) = 2.5 * static_cast<double>(width) + 1;
    for (Eigen::Index i = 1; i <= std::min(width, rows - 1 - k); ++i)
      S(k, k + i) = S(k + i, k) = std::sin(static_cast<double>(3 * k + 7 * i));
  }
  return S;
}

BandedFactors factors_of(const Eigen::MatrixXd& S, Eigen::Index width) {
  BandedFactors factors;
  factors.resize(S.rows(), width);
  for (Eigen::Index k = 0; k < S.rows(); ++k) {
    for (Eigen::Index i = k; i <= std::min(k + width, S.rows() - 1); ++i)
      factors.values()[factors.place(i, k)] = S(i, k);
  }
  return factors;
}

/// Mode vectors of which each point moves with `reach` modes that follow each other.
Eigen::SparseMatrix<double> along_a_line(Eigen::Index modes, Eigen::Index points, Eigen::Index reach) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(modes, points);
  for (Eigen::Index point = 0; point < points; ++point) {
    for (Eigen::Index i = 0; i < reach; ++i)
      N((point * (modes - reach)) / points + i, point) = std::cos(static_cast<double>(point + 3 * i)) + 0.1;
  }
  return N.sparseView();
}

TEST(BandedFactors, SolveForEveryWidthAndSize) {
  for (const auto& [rows, width] :
       {std::pair{1, 0}, {7, 0}, {9, 1}, {20, 3}, {20, 4}, {5, 7}, {61, 11}, {80, 32}}) {
    const Eigen::MatrixXd S = banded(rows, width);
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(rows, -1, 2);
    BandedFactors factors = factors_of(S, width);
    ASSERT_TRUE(factors.factorize());
    EXPECT_LE((S * factors.solve(right) - right).norm(), 1e-13 * right.norm()) << rows << ", " << width;
  }
}

TEST(BandedFactors, TakeAnotherMatrixAfterOne) {
  constexpr Eigen::Index rows = 30, width = 5;
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(rows, 1, 3);
  BandedFactors factors = factors_of(banded(rows, width), width);
  ASSERT_TRUE(factors.factorize());
  factors.set_zero();
  for (Eigen::Index k = 0; k < rows; ++k) factors.values()[factors.place(k, k)] = 2;
  ASSERT_TRUE(factors.factorize());
  EXPECT_EQ((2 * factors.solve(right) - right).norm(), 0);
}

TEST(BandedFactors, SayThatNothingResists) {
  Eigen::MatrixXd S = banded(12, 2);
  S.row(5).setZero();
  S.col(5).setZero();
  EXPECT_FALSE(factors_of(S, 2).factorize());
  S = banded(12, 2);
  const Eigen::VectorXd free = Eigen::VectorXd::Ones(12);  // no energy in a motion of all together
  for (Eigen::Index k = 0; k < 12; ++k) S(k, k) -= S.row(k).dot(free);
  EXPECT_FALSE(factors_of(S, 2).factorize());
}

TEST(ModalSolver, ProjectsABeamAsADenseSolutionDoes) {
  constexpr Eigen::Index modes = 60;
  constexpr double dt = 0.3;
  ModalSolver solver;
  for (const Eigen::Index reach : {12, 12, 4, 40, 12}) {  // 40: too wide for a band
    const Eigen::MatrixXd S = banded(modes, 5), N = along_a_line(modes, 90, reach);
    const ModalLoad load{
        .A = Eigen::MatrixXd((N * N.transpose()).triangularView<Eigen::Lower>()).sparseView(),
        .f = Eigen::VectorXd::LinSpaced(modes, 3, 1)};
    const Eigen::VectorXd g = Eigen::VectorXd::LinSpaced(modes, -1, 2), right = g + dt * load.f;
    const Eigen::SparseMatrix<double> lower = Eigen::MatrixXd(S.triangularView<Eigen::Lower>()).sparseView();
    const Eigen::MatrixXd sum = S + dt * N * N.transpose();
    EXPECT_LE((sum * solver.project(lower, g, load, dt) - right).norm(), 1e-12 * right.norm()) << reach;
    EXPECT_LE((S * solver.solve(lower, g) - g).norm(), 1e-12 * g.norm()) << reach;
  }
}

TEST(SparseMessage, IsTakenIntoAMatrixWhateverThatWasBefore) {
  Eigen::SparseMatrix<double> kept;
  for (const auto& [reach, factor] : {std::pair{3, 1.0}, {3, -2.0}, {5, 1.0}, {3, 3.0}}) {
    const Eigen::SparseMatrix<double> N = factor * along_a_line(20, 15, reach);
    wire::put_matrix(wire::entries_of(N), 20, 15, kept);
    EXPECT_EQ((kept - N).norm(), 0) << reach;
  }
  wire::SparseMatrix moved = wire::entries_of(kept);
  ++moved.column.back();  // the same rows, one entry in another column
  wire::put_matrix(moved, 20, 16, kept);
  EXPECT_EQ((kept - wire::matrix_of(moved, 20, 16)).norm(), 0);
  moved = wire::entries_of(along_a_line(20, 15, 3));
  for (std::int32_t& column : moved.column) column = 14 - column;
  wire::put_matrix(moved, 20, 15, kept);
  EXPECT_EQ((kept - wire::matrix_of(moved, 20, 15)).norm(), 0);
}

}  // namespace
}  // namespace fsi
