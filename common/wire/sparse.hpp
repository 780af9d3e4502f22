#pragma once
/// Sparse matrices of messages as Eigen's, and back.

#include <Eigen/SparseCore>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "common/wire/messages.hpp"

namespace fsi::wire {

/// Whether entries follow each other as Eigen keeps them: by columns, in these by rows, each place once.
inline bool in_order(const SparseMatrix& entries) {
  for (std::size_t e = 1; e < entries.value.size(); ++e) {
    const bool later = entries.column[e] > entries.column[e - 1] ||
                       (entries.column[e] == entries.column[e - 1] && entries.row[e] > entries.row[e - 1]);
    if (!later) return false;
  }
  return true;
}

/// A matrix of Eigen's compressed arrays: `starts` of the columns among `rows` and `values`.
inline Eigen::SparseMatrix<double> compressed(Eigen::Index rows_in_all, std::span<const int> starts,
                                              std::span<const int> rows, std::span<const double> values) {
  Eigen::SparseMatrix<double> matrix(rows_in_all, static_cast<Eigen::Index>(starts.size()) - 1);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(values.size()));
  std::ranges::copy(starts, matrix.outerIndexPtr());
  std::ranges::copy(rows, matrix.innerIndexPtr());
  std::ranges::copy(values, matrix.valuePtr());
  return matrix;
}

/// @param entries rows and columns within the matrix; in any order, and those of one place add up
inline Eigen::SparseMatrix<double> matrix_of(const SparseMatrix& entries, Eigen::Index rows,
                                             Eigen::Index columns) {
  if (in_order(entries)) {
    std::vector<int> starts(static_cast<std::size_t>(columns) + 1);
    for (const std::int32_t column : entries.column) ++starts[static_cast<std::size_t>(column) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    return compressed(rows, starts, entries.row, entries.value);
  }
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.value.size());
  for (std::size_t e = 0; e < entries.value.size(); ++e)
    triplets.emplace_back(entries.row[e], entries.column[e], entries.value[e]);
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

/// The same into a matrix that is there: where it has the entries of the message already, only its numbers are new.
inline void put_matrix(const SparseMatrix& entries, Eigen::Index rows, Eigen::Index columns,
                       Eigen::SparseMatrix<double>& into) {
  const auto stays = [&] {
    if (into.rows() != rows || into.cols() != columns || !into.isCompressed()) return false;
    if (into.nonZeros() != std::ssize(entries.value)) return false;
    if (!std::ranges::equal(entries.row, std::span(into.innerIndexPtr(), entries.row.size()))) return false;
    const int* const starts = into.outerIndexPtr();
    for (Eigen::Index column = 0; column < columns; ++column) {
      const auto wrong = [&](std::int32_t of_entry) { return of_entry != static_cast<std::int32_t>(column); };
      const auto own = entries.column.begin();
      if (std::any_of(own + starts[column], own + starts[column + 1], wrong)) return false;
    }
    return true;
  };
  if (stays()) {
    std::ranges::copy(entries.value, into.valuePtr());
  } else {
    into = matrix_of(entries, rows, columns);
  }
}

/// @param matrix compressed
inline void put_entries(const Eigen::SparseMatrix<double>& matrix, SparseMatrix& into) {
  into.row.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
  into.value.assign(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros());
  into.column.resize(into.row.size());
  const int* const starts = matrix.outerIndexPtr();
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    std::fill(into.column.begin() + starts[column], into.column.begin() + starts[column + 1],
              static_cast<std::int32_t>(column));
}

inline SparseMatrix entries_of(const Eigen::SparseMatrix<double>& matrix) {
  SparseMatrix entries;
  put_entries(matrix, entries);
  return entries;
}

/// The lower triangle of a symmetric matrix.
inline SparseMatrix lower_entries_of(const Eigen::SparseMatrix<double>& matrix) {
  return entries_of(Eigen::SparseMatrix<double>(matrix.triangularView<Eigen::Lower>()));
}

}  // namespace fsi::wire
