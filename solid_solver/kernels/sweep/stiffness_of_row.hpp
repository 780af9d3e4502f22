#pragma once
/// F and K of the points of a row at t + dt/2, and what the sweep makes of them.

#include <limits>

#include "solid_solver/kernels/sweep/sweep_rows.hpp"
#include "solid_solver/laws/law.hpp"

namespace fsi::solid {

/// Whether K takes no longer than the other numbers of a point: one loop then finds all of them.
template <class L>
inline constexpr bool quick_stiffness = requires { L::quick_stiffness; };

/// K and the acoustic matrices at t + dt/2, from F of u + dt/2 v. Differs from the paper: the acoustic matrix of a
/// face is the mean of those of its two points, which the time step needs anyway, instead of one from an F
/// differenced about the face. It multiplies a jump of O(h^3) in smooth flow.
template <Law L, class Row>
struct StiffnessOfRow {
  Row row;
  StateRows q;
  AcousticRows along1, along2;
  StiffnessRows stiff;
  double* sound;
  L law;
  double half;  ///< dt / 2 [time]

  /// Writes them down for point i. Returns K.
  [[gnu::always_inline]] Stiffness find(int i) const {
    const Tensor2 F = deformation_gradient(row, q, i, half);
    const Stiffness K = law.K(F);
    stiff.set(i, K);
    const SymmetricTensor2 A1 = row.acoustic1(i, K), A2 = row.acoustic2(i, K);
    along1.set(i, A1);
    along2.set(i, A2);
    const double J = determinant(F);
    sound[i] =
        J > 0.0 && !(bears_waves(A1) && bears_waves(A2)) ? std::numeric_limits<double>::quiet_NaN() : J;
    return K;
  }

  /// What `find` has written.
  [[gnu::always_inline]] Stiffness found(int i) const { return stiff.at(i); }
};

}  // namespace fsi::solid
