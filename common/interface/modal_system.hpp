#pragma once
/// The equations of common/interface/modal.hpp solved step by step for bodies with many modes: what depends
/// on the places of the entries alone (their order, the fill of the factors) is found once and kept until the
/// places change.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <span>
#include <variant>
#include <vector>

#include "common/interface/band.hpp"
#include "common/interface/modal.hpp"

namespace fsi {

/// Whether two matrices have entries in the same places.
bool same_places(const Eigen::SparseMatrix<double>& a, const Eigen::SparseMatrix<double>& b);

/// The columns of all matrices, which have as many rows, one matrix after the other.
Eigen::SparseMatrix<double> side_by_side(std::span<const Eigen::SparseMatrix<double>> parts);

/// The load of the gas on the modes, as by `modal_load`, with the lower triangle of A.
class AddedMass {
 public:
  /// @param N mode vectors, N(m, i) = n . dx/dq_m at point i
  void take(const Eigen::SparseMatrix<double>& N);
  /// Holds until the next call. @param gas, ds of every point
  const ModalLoad& load(std::span<const NormalSide> gas, std::span<const double> ds);

 private:
  void find_places();

  Eigen::SparseMatrix<double> N_;
  /// Products of an entry of N with entries that follow each other, which go to places of A that do.
  struct Run {
    int place = 0, of = 0, first = 0, length = 0;
  };
  std::vector<Run> runs_;  ///< of all points, in this order
  std::vector<std::size_t> ends_of_runs_;
  ModalLoad load_;
};

/// S = L D L^T in an order that keeps the factors sparse.
class SparseFactors {
 public:
  /// Takes the order for a matrix with entries in these places.
  /// @return where each entry of `places`, in its order, is among the values (-1: the upper triangle does not count)
  std::vector<int> find_order(const Eigen::SparseMatrix<double>& places);
  void set_zero() { std::fill_n(ordered_.valuePtr(), ordered_.nonZeros(), 0.0); }
  double* values() { return ordered_.valuePtr(); }
  /// @return false for a pivot of the size of round-off
  bool factorize();
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const { return factors_.solve(right); }

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  /// Factors of a matrix that is already in their order: only its numbers are new.
  struct Factors : Eigen::SimplicialLDLT<Matrix> {
    void factorize_ordered(const Matrix& ordered) { factorize_preordered<true>(ordered); }
  };

  Matrix ordered_;                      ///< the upper triangle, in the order of the factors
  std::vector<Eigen::Index> diagonal_;  ///< places there; -1: none
  Factors factors_;
};

/// Solves S x = right as `solve_modes`, and (S + dt A) x = g + dt f as `project_modes`: within a band where
/// the entries lie near the diagonal.
class ModalSolver {
 public:
  ModalSolver() = default;
  /// A copy finds the places anew: they depend on those of the entries alone, so the solutions are the same.
  ModalSolver(const ModalSolver&) {}
  ModalSolver& operator=(const ModalSolver&) { return *this; }
  ~ModalSolver() = default;

  /// @param S symmetric, compressed; its lower triangle counts  @return empty where S is singular
  Eigen::VectorXd solve(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& right);
  Eigen::VectorXd project(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& g,
                          const ModalLoad& load, double dt);

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  /// One of the matrices whose sum is factorised, and where its entries are among the values of the factors
  /// (-1: they do not count).
  struct Term {
    Matrix places;
    std::vector<int> to;
  };

  void find_places(const Matrix& S, const Matrix& A);
  Eigen::VectorXd solve_sum(const Matrix& S, const Matrix& A, double dt, const Eigen::VectorXd& right);

  Term S_, A_;  ///< of the last sum
  std::variant<SparseFactors, BandedFactors> factors_;
};

}  // namespace fsi
