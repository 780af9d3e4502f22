#pragma once
/// The equations of common/interface/modal.hpp solved step by step for bodies with many modes: what depends
/// on the places of the entries alone (their order, the fill of the factors) is found once and kept until the
/// places change.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

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
  std::vector<Eigen::Index> places_;  ///< in A of the products of the entries of each column with each other
  ModalLoad load_;
};

/// Solves S x = right as `solve_modes`, and (S + dt A) x = g + dt f as `project_modes`.
class ModalSolver {
 public:
  ModalSolver() = default;
  /// A copy finds the order anew: it depends on the places alone, so the solutions are the same.
  ModalSolver(const ModalSolver&) {}
  ModalSolver& operator=(const ModalSolver&) { return *this; }
  ~ModalSolver() = default;

  /// @param S symmetric, compressed; its lower triangle counts  @return empty where S is singular
  Eigen::VectorXd solve(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& right);
  Eigen::VectorXd project(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& g,
                          const ModalLoad& load, double dt);

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  /// Factors of a matrix that is already in their order: only its numbers are new.
  struct Factors : Eigen::SimplicialLDLT<Matrix> {
    void factorize_ordered(const Matrix& ordered) { factorize_preordered<true>(ordered); }
  };
  /// One of the matrices whose sum is factorised, and where its entries are in `ordered_` (-1: they do not count).
  struct Term {
    Matrix places;
    std::vector<Eigen::Index> to;
  };

  void find_order(const Matrix& S, const Matrix& A);
  Eigen::VectorXd solve_ordered(const Eigen::VectorXd& right);

  Term S_, A_;                          ///< of the last sum whose order was found
  Matrix ordered_;                      ///< the upper triangle of the sum, in the order of the factors
  std::vector<Eigen::Index> diagonal_;  ///< places there; -1: none
  Factors factors_;
};

}  // namespace fsi
