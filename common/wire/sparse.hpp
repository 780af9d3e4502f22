#pragma once
/// Sparse matrices of messages as Eigen's, and back.

#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <numeric>
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

/// @param entries rows and columns within the matrix; in any order, and those of one place add up
inline Eigen::SparseMatrix<double> matrix_of(const SparseMatrix& entries, Eigen::Index rows,
                                             Eigen::Index columns) {
  if (in_order(entries)) {
    std::vector<int> starts(static_cast<std::size_t>(columns) + 1);
    for (const std::int32_t column : entries.column) ++starts[static_cast<std::size_t>(column) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    return Eigen::Map<const Eigen::SparseMatrix<double>>(
        rows, columns, static_cast<Eigen::Index>(entries.value.size()), starts.data(), entries.row.data(),
        entries.value.data());
  }
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.value.size());
  for (std::size_t e = 0; e < entries.value.size(); ++e)
    triplets.emplace_back(entries.row[e], entries.column[e], entries.value[e]);
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

inline SparseMatrix entries_of(const Eigen::SparseMatrix<double>& matrix) {
  SparseMatrix entries;
  const auto count = static_cast<std::size_t>(matrix.nonZeros());
  entries.row.reserve(count);
  entries.column.reserve(count);
  entries.value.reserve(count);
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry) {
      entries.row.push_back(static_cast<std::int32_t>(entry.row()));
      entries.column.push_back(static_cast<std::int32_t>(entry.col()));
      entries.value.push_back(entry.value());
    }
  }
  return entries;
}

/// The lower triangle of a symmetric matrix.
inline SparseMatrix lower_entries_of(const Eigen::SparseMatrix<double>& matrix) {
  return entries_of(Eigen::SparseMatrix<double>(matrix.triangularView<Eigen::Lower>()));
}

}  // namespace fsi::wire
