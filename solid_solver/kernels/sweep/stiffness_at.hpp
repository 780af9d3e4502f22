#pragma once
/// K at t + dt/2, and what the sweep makes of it.

#include <limits>

#include "solid_solver/kernels/sweep/sweep_rows.hpp"
#include "solid_solver/laws/law.hpp"

namespace fsi::solid {

/// Whether K takes no longer than the other numbers of a point: one loop then finds all of them.
template <class L>
inline constexpr bool quick_stiffness = requires { L::quick_stiffness; };

/// What is written down for each point of a row.
struct PointRows {
  StiffnessRows stiff;
  AcousticRows along1, along2;
  double* sound;  ///< det F, but no number where waves are not real
};

/// K and the acoustic matrices at t + dt/2, from F of u + dt/2 v. Differs from the paper: the acoustic matrix of a
/// face is the mean of those of its two points, which the time step needs anyway, instead of one from an F
/// differenced about the face. It multiplies a jump of O(h^3) in smooth flow.
/// @param half dt / 2 [time]
template <Law L, class Row>
[[gnu::always_inline]] inline Stiffness stiffness_at(const L& law, const Row& row, const StateRows& q, int i,
                                                     double half, const PointRows& to) {
  const Tensor2 F = deformation_gradient(row, q, i, half);
  const Stiffness K = law.K(F);
  to.stiff.set(i, K);
  const SymmetricTensor2 A1 = row.acoustic1(i, K), A2 = row.acoustic2(i, K);
  to.along1.set(i, A1);
  to.along2.set(i, A2);
  const double J = determinant(F);
  to.sound[i] =
      J > 0.0 && !(bears_waves(A1) && bears_waves(A2)) ? std::numeric_limits<double>::quiet_NaN() : J;
  return K;
}

}  // namespace fsi::solid
