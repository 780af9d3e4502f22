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

/// Beyond this, what sparse factors spare outweighs that a band needs no list of places.
constexpr Eigen::Index widest_band = 32;

/// Calls action(row, column) for every entry, in their order.
template <class Action>
void each_entry(const Eigen::SparseMatrix<double>& matrix, const Action& action) {
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry)
      action(entry.row(), entry.col());
  }
}

/// Largest distance of an entry of the lower triangle from the diagonal.
Eigen::Index band_width(const Eigen::SparseMatrix<double>& matrix) {
  Eigen::Index width = 0;
  each_entry(matrix, [&](Eigen::Index row, Eigen::Index column) { width = std::max(width, row - column); });
  return width;
}

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
/// the lower triangle, in one column of A. Those that follow each other there are one run.
void AddedMass::find_places() {
  const Eigen::SparseMatrix<double> all = N_ * N_.transpose();
  load_.A = all.triangularView<Eigen::Lower>();
  load_.A.makeCompressed();
  load_.f.resize(N_.rows());
  runs_.clear();
  ends_of_runs_.clear();
  const int *A_rows = load_.A.innerIndexPtr(), *A_starts = load_.A.outerIndexPtr();
  const int *rows = N_.innerIndexPtr(), *starts = N_.outerIndexPtr();
  for (Eigen::Index point = 0; point < N_.cols(); ++point) {
    const int end = starts[point + 1];
    for (int a = starts[point]; a < end; ++a) {
      const int* const column = A_rows + A_starts[rows[a]];
      for (int b = a; b < end; ++b) {
        const auto place =
            static_cast<int>(std::lower_bound(column, A_rows + A_starts[rows[a] + 1], rows[b]) - A_rows);
        if (b == a || place != runs_.back().place + runs_.back().length)
          runs_.push_back({.place = place, .of = a, .first = b});
        ++runs_.back().length;
      }
    }
    ends_of_runs_.push_back(runs_.size());
  }
}

const ModalLoad& AddedMass::load(std::span<const NormalSide> gas, std::span<const double> ds) {
  const double* const values = N_.valuePtr();
  const int *rows = N_.innerIndexPtr(), *starts = N_.outerIndexPtr();
  double* const A = load_.A.valuePtr();
  std::fill_n(A, load_.A.nonZeros(), 0.0);
  load_.f.setZero();
  std::size_t next = 0;
  for (std::size_t k = 0; k < gas.size(); ++k) {
    const double resistance = gas[k].z * ds[k], push = (gas[k].w_n + gas[k].z * gas[k].v_n) * ds[k];
    for (int a = starts[k]; a < starts[k + 1]; ++a) load_.f[rows[a]] += values[a] * push;
    for (; next < ends_of_runs_[k]; ++next) {
      const Run& run = runs_[next];
      const double resisted = values[run.of] * resistance;
#pragma omp simd
      for (int i = 0; i < run.length; ++i) A[run.place + i] += resisted * values[run.first + i];
    }
  }
  return load_;
}

/// Numbers in the places of the entries show where each goes.
std::vector<int> SparseFactors::find_order(const Matrix& places) {
  Matrix numbered = places;
  factors_.analyzePattern(numbered);
  for (Eigen::Index entry = 0; entry < numbered.nonZeros(); ++entry)
    numbered.valuePtr()[entry] = static_cast<double>(entry);
  ordered_.resize(numbered.rows(), numbered.cols());
  ordered_.selfadjointView<Eigen::Upper>() =
      numbered.selfadjointView<Eigen::Lower>().twistedBy(factors_.permutationP());
  std::vector<int> to(static_cast<std::size_t>(numbered.nonZeros()), -1);
  diagonal_.assign(static_cast<std::size_t>(numbered.cols()), -1);
  for (Eigen::Index column = 0; column < ordered_.cols(); ++column) {
    for (int place = ordered_.outerIndexPtr()[column]; place < ordered_.outerIndexPtr()[column + 1];
         ++place) {
      to[static_cast<std::size_t>(ordered_.valuePtr()[place])] = place;
      if (ordered_.innerIndexPtr()[place] == column) diagonal_[static_cast<std::size_t>(column)] = place;
    }
  }
  return to;
}

bool SparseFactors::factorize() {
  factors_.factorize_ordered(ordered_);
  if (factors_.info() != Eigen::Success) return false;
  const Eigen::VectorXd& pivots = factors_.vectorD();
  for (std::size_t k = 0; k < diagonal_.size(); ++k) {
    const double from = diagonal_[k] < 0 ? 0 : ordered_.valuePtr()[diagonal_[k]];
    if (std::abs(pivots[static_cast<Eigen::Index>(k)]) <= pivot_round_off * std::abs(from)) return false;
  }
  return true;
}

void ModalSolver::find_places(const Matrix& S, const Matrix& A) {
  Matrix sum = S + A;
  sum.makeCompressed();
  const Eigen::Index width = band_width(sum);
  std::vector<int> to;
  if (width <= widest_band) {
    BandedFactors& band = factors_.emplace<BandedFactors>();
    band.resize(sum.rows(), width);
    each_entry(sum, [&](Eigen::Index row, Eigen::Index column) {
      to.push_back(row < column ? -1 : static_cast<int>(band.place(row, column)));
    });
  } else {
    to = factors_.emplace<SparseFactors>().find_order(sum);
  }
  const auto follow = [&](const Matrix& part, Term& term) {
    term.places = part;
    term.to.clear();
    const int *rows = sum.innerIndexPtr(), *starts = sum.outerIndexPtr();
    each_entry(part, [&](Eigen::Index row, Eigen::Index column) {
      const int* const found =
          std::lower_bound(rows + starts[column], rows + starts[column + 1], static_cast<int>(row));
      term.to.push_back(to[static_cast<std::size_t>(found - rows)]);
    });
  };
  follow(S, S_);
  follow(A, A_);
}

Eigen::VectorXd ModalSolver::solve_sum(const Matrix& S, const Matrix& A, double dt,
                                       const Eigen::VectorXd& right) {
  if (!same_places(S, S_.places) || !same_places(A, A_.places)) find_places(S, A);
  return std::visit(
      [&](auto& factors) -> Eigen::VectorXd {
        factors.set_zero();
        double* const values = factors.values();
        for (std::size_t entry = 0; entry < S_.to.size(); ++entry) {
          if (S_.to[entry] >= 0) values[S_.to[entry]] = S.valuePtr()[entry];
        }
        for (std::size_t entry = 0; entry < A_.to.size(); ++entry) {
          if (A_.to[entry] >= 0) values[A_.to[entry]] += dt * A.valuePtr()[entry];
        }
        if (!factors.factorize()) return {};
        return factors.solve(right);
      },
      factors_);
}

Eigen::VectorXd ModalSolver::solve(const Matrix& S, const Eigen::VectorXd& right) {
  if (S.rows() <= few_modes) return solve_modes(S, right);
  return solve_sum(S, Matrix(S.rows(), S.cols()), 0, right);
}

Eigen::VectorXd ModalSolver::project(const Matrix& S, const Eigen::VectorXd& g, const ModalLoad& load,
                                     double dt) {
  const Eigen::VectorXd right = g + dt * load.f;
  if (S.rows() <= few_modes) return solve_modes(S + dt * load.A, right);
  return solve_sum(S, load.A, dt, right);
}

}  // namespace fsi
