#pragma once
/// Rows of scratch memory for the sweep, allocated once. Row k holds the points -2 <= i < n1 + 2 of one grid
/// row, each row on cache lines of its own.

#include "common/core/field.hpp"

namespace fsi::fluid {

class Workspace {
 public:
  Workspace() = default;
  Workspace(int n1, int rows) : rows_(Layout(n1, rows), 1) {}

  /// row(k)[i] is valid for -2 <= i < n1 + 2 and for a whole vector after.
  double* row(int k) { return rows_.view().row(0, k); }

 private:
  Field rows_;
};

}  // namespace fsi::fluid
