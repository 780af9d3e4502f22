#include "common/interface/modal_system.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace fsi {

Eigen::SparseMatrix<double> side_by_side(std::span<const Eigen::SparseMatrix<double>> parts) {
  Eigen::Index columns = 0, entries = 0;
  for (const Eigen::SparseMatrix<double>& part : parts) {
    columns += part.cols();
    entries += part.nonZeros();
  }
  Eigen::SparseMatrix<double> all(parts.empty() ? 0 : parts.front().rows(), columns);
  all.reserve(entries);
  Eigen::Index column = 0;
  for (const Eigen::SparseMatrix<double>& part : parts) {
    for (Eigen::Index own = 0; own < part.outerSize(); ++own, ++column) {
      all.startVec(column);
      for (Eigen::SparseMatrix<double>::InnerIterator entry(part, own); entry; ++entry)
        all.insertBack(entry.row(), column) = entry.value();
    }
  }
  all.finalize();
  return all;
}

namespace {

/// A pivot that is less than this part of the diagonal it comes from is round-off.
constexpr double round_off = 1e-14;

}  // namespace

bool same_places(const Eigen::SparseMatrix<double>& a, const Eigen::SparseMatrix<double>& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.nonZeros() != b.nonZeros()) return false;
  return std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols(), b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

void AddedMass::take(const Eigen::SparseMatrix<double>& N) {
  if (load_.A.rows() == N.rows() && same_places(N, N_)) {
    std::copy_n(N.valuePtr(), N.nonZeros(), N_.valuePtr());
    return;
  }
  N_ = N;
  N_.makeCompressed();
  find_places();
}

/// The rows of a column of N increase, so the products of an entry with itself and with those after it are in
/// the lower triangle.
void AddedMass::find_places() {
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  const Eigen::SparseMatrix<double> all = N_ * N_.transpose();
  load_.A = all.triangularView<Eigen::Lower>();
  load_.A.makeCompressed();
  load_.f.resize(N_.rows());
  places_.clear();
  const int *rows = load_.A.innerIndexPtr(), *starts = load_.A.outerIndexPtr();
  for (Eigen::Index point = 0; point < N_.cols(); ++point) {
    for (Entry a(N_, point); a; ++a) {
      for (Entry b = a; b; ++b) {
        const int* const found =
            std::lower_bound(rows + starts[a.row()], rows + starts[a.row() + 1], b.row());
        places_.push_back(found - rows);
      }
    }
  }
}

const ModalLoad& AddedMass::load(std::span<const NormalSide> gas, std::span<const double> ds) {
  const double* const values = N_.valuePtr();
  const int *rows = N_.innerIndexPtr(), *starts = N_.outerIndexPtr();
  double* const A = load_.A.valuePtr();
  std::fill_n(A, load_.A.nonZeros(), 0.0);
  load_.f.setZero();
  auto place = places_.begin();
  for (std::size_t k = 0; k < gas.size(); ++k) {
    const double resistance = gas[k].z * ds[k], push = (gas[k].w_n + gas[k].z * gas[k].v_n) * ds[k];
    const int end = starts[k + 1];
    for (int a = starts[k]; a < end; ++a) {
      load_.f[rows[a]] += values[a] * push;
      const double resisted = values[a] * resistance;
      for (int b = a; b < end; ++b) A[*place++] += resisted * values[b];
    }
  }
  return load_;
}

/// Numbers in the places of the entries show where each goes.
void ModalSolver::find_order(const Matrix& S, const Matrix& A) {
  Matrix sum = S + A;
  sum.makeCompressed();
  factors_.analyzePattern(sum);
  for (Eigen::Index entry = 0; entry < sum.nonZeros(); ++entry)
    sum.valuePtr()[entry] = static_cast<double>(entry);
  ordered_.resize(sum.rows(), sum.cols());
  ordered_.selfadjointView<Eigen::Upper>() =
      sum.selfadjointView<Eigen::Lower>().twistedBy(factors_.permutationP());
  std::vector<Eigen::Index> to(static_cast<std::size_t>(sum.nonZeros()), -1);
  diagonal_.assign(static_cast<std::size_t>(sum.cols()), -1);
  for (Eigen::Index column = 0; column < ordered_.cols(); ++column) {
    for (int place = ordered_.outerIndexPtr()[column]; place < ordered_.outerIndexPtr()[column + 1];
         ++place) {
      to[static_cast<std::size_t>(ordered_.valuePtr()[place])] = place;
      if (ordered_.innerIndexPtr()[place] == column) diagonal_[static_cast<std::size_t>(column)] = place;
    }
  }
  const auto follow = [&](const Matrix& part, Term& term) {
    term.places = part;
    term.to.clear();
    const int *rows = sum.innerIndexPtr(), *starts = sum.outerIndexPtr();
    for (Eigen::Index column = 0; column < part.cols(); ++column) {
      for (Matrix::InnerIterator entry(part, column); entry; ++entry) {
        const int* const found =
            std::lower_bound(rows + starts[column], rows + starts[column + 1], static_cast<int>(entry.row()));
        term.to.push_back(to[static_cast<std::size_t>(found - rows)]);
      }
    }
  };
  follow(S, S_);
  follow(A, A_);
}

Eigen::VectorXd ModalSolver::solve_ordered(const Eigen::VectorXd& right) {
  factors_.factorize_ordered(ordered_);
  if (factors_.info() != Eigen::Success) return {};
  const Eigen::VectorXd& pivots = factors_.vectorD();
  for (std::size_t k = 0; k < diagonal_.size(); ++k) {
    const double from = diagonal_[k] < 0 ? 0 : ordered_.valuePtr()[diagonal_[k]];
    if (std::abs(pivots[static_cast<Eigen::Index>(k)]) <= round_off * std::abs(from)) return {};
  }
  return factors_.solve(right);
}

Eigen::VectorXd ModalSolver::solve(const Matrix& S, const Eigen::VectorXd& right) {
  return project(S, right, {.A = Matrix(S.rows(), S.cols()), .f = Eigen::VectorXd::Zero(right.size())}, 0);
}

Eigen::VectorXd ModalSolver::project(const Matrix& S, const Eigen::VectorXd& g, const ModalLoad& load,
                                     double dt) {
  const Eigen::VectorXd right = g + dt * load.f;
  if (S.rows() <= few_modes) return solve_modes(S + dt * load.A, right);
  if (!same_places(S, S_.places) || !same_places(load.A, A_.places)) find_order(S, load.A);
  double* const values = ordered_.valuePtr();
  std::fill_n(values, ordered_.nonZeros(), 0.0);
  for (std::size_t entry = 0; entry < S_.to.size(); ++entry) {
    if (S_.to[entry] >= 0) values[S_.to[entry]] = S.valuePtr()[entry];
  }
  for (std::size_t entry = 0; entry < A_.to.size(); ++entry) {
    if (A_.to[entry] >= 0) values[A_.to[entry]] += dt * load.A.valuePtr()[entry];
  }
  return solve_ordered(right);
}

}  // namespace fsi
