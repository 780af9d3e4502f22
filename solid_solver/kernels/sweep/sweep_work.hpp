#pragma once
/// The work space of a sweep.

#include <cstddef>

#include "solid_solver/kernels/sweep/stiffness_at.hpp"
#include "solid_solver/kernels/sweep/update_rows.hpp"

namespace fsi::solid {

/// Rows for as many columns of a grid as are swept at a time, at places that the compiler knows from one another: one
/// pointer leads to all of them. With a pointer for each the loops were as much about pointers as about points.
inline constexpr Layout sweep_work(528, 101);

/// The rows, by the index of the grid's columns. Those of a row number exist for the present and the last row.
class SweepWork {
 public:
  /// @param first_column a block begins there
  SweepWork(FieldView work, int first_column) : data_(work.data + sweep_work.at(0, 0) - first_column) {}

  FaceRows east() const { return face_rows(row(0)); }
  FaceRows west() const { return face_rows(row(4)); }
  FaceRows south() const { return face_rows(row(8)); }
  FaceRows north(int j) const { return face_rows(row(0, j)); }
  FaceRows faces1() const { return face_rows(row(12)); }
  FaceRows faces2(int j) const { return face_rows(row(4, j)); }
  AcousticRows acoustic1() const { return acoustic_rows(row(16)); }
  AcousticRows acoustic2(int j) const { return acoustic_rows(row(8, j)); }
  StiffnessRows stiffness(int j) const {
    double* k = row(11, j);
    return {k,
            k + next,
            k + 2 * next,
            k + 3 * next,
            k + 4 * next,
            k + 5 * next,
            k + 6 * next,
            k + 7 * next,
            k + 8 * next,
            k + 9 * next};
  }
  /// Velocity of the points at t + dt/2.
  double* centre(int c, int j) const { return row(21 + c, j); }
  PointRows points(int j) const {
    return {.stiff = stiffness(j), .along1 = acoustic1(), .along2 = acoustic2(j), .sound = soundness(j)};
  }
  /// det F, but no number where waves are not real.
  double* soundness(int j) const { return row(23, j); }
  /// Of StressUpwinding: the share of upwinding that stays, c_p of the rest, the stress at t + dt/2 and what is
  /// taken from it.
  double* share(int j) const { return row(24, j); }
  double* rest1() const { return row(28); }
  double* rest2(int j) const { return row(25, j); }
  StressRow decay1() const { return stress_row(row(29)); }
  StressRow decay2(int j) const { return stress_row(row(26, j)); }
  StressRow centre_stress(int j) const { return stress_row(row(30, j)); }
  /// Nobody writes there.
  const double* zero() const { return row(19); }
  /// The step of blocks that reach beyond their run.
  StateRow<double> edge() const {
    return {row(20), row(21), row(22), row(23), row(24), row(25), row(26), row(27)};
  }

 private:
  static constexpr std::ptrdiff_t next = sweep_work.stride;
  static constexpr int shared = 33, of_a_row = 34;
  static_assert(shared + 2 * of_a_row == sweep_work.n2);

  double* row(int k) const { return data_ + k * next; }
  double* row(int k, int j) const { return row(shared + of_a_row * (j & 1)) + k * next; }
  static FaceRows face_rows(double* first) {
    return {first, first + next, first + 2 * next, first + 3 * next};
  }
  static StressRow stress_row(double* first) {
    return {first, first + next, first + 2 * next, first + 3 * next};
  }
  static AcousticRows acoustic_rows(double* first) { return {first, first + next, first + 2 * next}; }

  double* data_;
};

}  // namespace fsi::solid
