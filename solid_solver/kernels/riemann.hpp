#pragma once
/// The linearised Riemann problem of one cell face.

#include <cmath>

#include "solid_solver/kernels/impedance.hpp"

namespace fsi::solid {

/// Velocity and force on a face (area vector times nominal stress).
struct FaceState {
  double v1 = 0, v2 = 0, f1 = 0, f2 = 0;  ///< [velocity], [velocity], [pressure], [pressure]
};

/// Solution at the face of the Riemann problem paper eq. (34), which splits along the p- and s-waves into
///
///     f* - Z v* = f_R - Z v_R,   f* + Z v* = f_L + Z v_L,   Z = sqrt(rho A),
///
/// the relations of paper eq. (18) from both sides as one vector equation each. A = a_i K_ijkl a_l is the
/// acoustic matrix of the face's area vector a, so that Z carries the area as f does. Z has the closed form
/// (rho A + d I) / sqrt(tr rho A + 2 d), d = det Z, and no eigenvectors are needed. Pure, no branches.
/// @param rho_A density times acoustic matrix, positive definite
[[gnu::always_inline]] inline FaceState riemann_solution(const SymmetricTensor2& rho_A, const FaceState& left,
                                                         const FaceState& right) {
  const double d = std::sqrt(rho_A.a11 * rho_A.a22 - rho_A.a12 * rho_A.a12);
  const double t = std::sqrt(rho_A.a11 + rho_A.a22 + 2.0 * d);
  const double half_inverse = 0.5 / (t * d);
  const double half_t = half_inverse * d;
  const double z11 = rho_A.a11 + d, z12 = rho_A.a12, z22 = rho_A.a22 + d;
  const double dv1 = right.v1 - left.v1, dv2 = right.v2 - left.v2;
  const double df1 = right.f1 - left.f1, df2 = right.f2 - left.f2;
  return {.v1 = 0.5 * (left.v1 + right.v1) + half_inverse * (z22 * df1 - z12 * df2),
          .v2 = 0.5 * (left.v2 + right.v2) + half_inverse * (z11 * df2 - z12 * df1),
          .f1 = 0.5 * (left.f1 + right.f1) + half_t * (z11 * dv1 + z12 * dv2),
          .f2 = 0.5 * (left.f2 + right.f2) + half_t * (z12 * dv1 + z22 * dv2)};
}

}  // namespace fsi::solid
