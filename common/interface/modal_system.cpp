#include "common/interface/modal_system.hpp"

#include <algorithm>
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
  const bool known = load_.A.rows() == N.rows() && same_places(N, N_);
  N_ = N;
  N_.makeCompressed();
  if (!known) find_places();
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

Eigen::VectorXd ModalSolver::solve(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& right) {
  if (S.rows() <= few_modes) return solve_modes(S, right);
  if (!same_places(S, ordered_)) {
    ordered_ = S;
    factors_.analyzePattern(S);
  }
  factors_.factorize(S);
  if (factors_.info() != Eigen::Success) return {};
  const Eigen::VectorXd diagonal = factors_.permutationP() * Eigen::VectorXd(S.diagonal());
  if ((factors_.vectorD().array().abs() <= round_off * diagonal.array().abs()).any()) return {};
  return factors_.solve(right);
}

Eigen::VectorXd ModalSolver::project(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& g,
                                     const ModalLoad& load, double dt) {
  return solve(S + dt * load.A, g + dt * load.f);
}

}  // namespace fsi
