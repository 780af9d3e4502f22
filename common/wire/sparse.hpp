#pragma once
/// Sparse matrices of messages as Eigen's, and back.

#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

#include "common/wire/messages.hpp"

namespace fsi::wire {

/// @param entries rows and columns within the matrix
inline Eigen::SparseMatrix<double> matrix_of(const SparseMatrix& entries, Eigen::Index rows,
                                             Eigen::Index columns) {
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
