#pragma once
/// Pointers to rows: the kernels' view of fields. Index i counts the points of the row; ghosts have i < 0 and
/// i >= n1.

#include "common/core/field.hpp"

namespace fsi::fluid {

/// Primitive variables of one row; T is double or const double.
template <class T>
struct StateRow {
  T *rho = nullptr, *v1 = nullptr, *v2 = nullptr, *p = nullptr;

  StateRow() = default;
  StateRow(T* rho_row, T* v1_row, T* v2_row, T* p_row) : rho(rho_row), v1(v1_row), v2(v2_row), p(p_row) {}
  StateRow(BasicFieldView<T> field, int j)
      : rho(field.row(0, j)), v1(field.row(1, j)), v2(field.row(2, j)), p(field.row(3, j)) {}
  /// The same row with the velocity components exchanged: direction 2 seen as a normal direction.
  StateRow exchanged() const { return {rho, v2, v1, p}; }
  /// The same row with its origin `shift` points further.
  StateRow shifted(int shift) const { return {rho + shift, v1 + shift, v2 + shift, p + shift}; }
  operator StateRow<const double>() const { return {rho, v1, v2, p}; }  // NOLINT(google-explicit-constructor)
};

/// Conserved variables per volume at the points of one row, or their fluxes through its faces times dt times
/// face area. Faces along a row: face i lies between points i and i + 1.
struct ConservedRow {
  double *mass = nullptr, *momentum1 = nullptr, *momentum2 = nullptr, *energy = nullptr;
  ConservedRow exchanged() const { return {mass, momentum2, momentum1, energy}; }
  ConservedRow shifted(int shift) const {
    return {mass + shift, momentum1 + shift, momentum2 + shift, energy + shift};
  }
};
using FluxRow = ConservedRow;

/// Positions in one row.
struct PointRow {
  const double *x = nullptr, *y = nullptr;

  PointRow() = default;
  PointRow(ConstFieldView field, int j) : x(field.row(0, j)), y(field.row(1, j)) {}
  PointRow(const double* x_row, const double* y_row) : x(x_row), y(y_row) {}
};

/// Points i of a row with first <= i < last.
struct Range {
  int first = 0, last = 0;
};

}  // namespace fsi::fluid
