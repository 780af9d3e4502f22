#pragma once
/// What can be asked of the entries of a sparse matrix in a message before they are used.

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/wire/messages.hpp"

namespace fsi::wire {

/// Whether all of these lie in 0 .. end - 1.
inline bool all_below(std::span<const std::int32_t> indices, std::size_t end) {
  unsigned outside = 0;
#pragma omp simd reduction(| : outside)
  for (std::size_t e = 0; e < indices.size(); ++e)  // NOLINT(modernize-loop-convert): simd counts
    outside |= static_cast<std::uint32_t>(indices[e]) >= end ? 1U : 0U;
  return outside == 0;
}

/// Whether every entry has a row, a column and a value, and lies within a matrix of `rows` x `columns`.
inline bool fits(const SparseMatrix& matrix, std::size_t rows, std::size_t columns) {
  const std::size_t entries = matrix.value.size();
  return matrix.row.size() == entries && matrix.column.size() == entries && all_below(matrix.row, rows) &&
         all_below(matrix.column, columns);
}

}  // namespace fsi::wire
