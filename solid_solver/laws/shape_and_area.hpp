#pragma once
/// What laws of the form psi = mu/2 (tr C - 2) + U(J) have in common: shape and area of an element enter apart.

#include "solid_solver/laws/law.hpp"

namespace fsi::solid {

[[gnu::always_inline]] inline double determinant_of(const Tensor2& F) {
  return F.a11 * F.a22 - F.a12 * F.a21;
}

/// tr C - 2, which is I1 - 3 in plane strain [-].
[[gnu::always_inline]] inline double stretch_of(const Tensor2& F) {
  return F.a11 * F.a11 + F.a12 * F.a12 + F.a21 * F.a21 + F.a22 * F.a22 - 2.0;
}

/// Nominal stress, paper eq. (7): mu F^T + c F^-1, c = J dU/dJ [pressure].
[[gnu::always_inline]] inline Tensor2 stress_of_shape_and_area(const Tensor2& F, double mu,
                                                               double area_stress) {
  const double c = area_stress / determinant_of(F);
  return {.a11 = mu * F.a11 + c * F.a22,
          .a12 = mu * F.a21 - c * F.a12,
          .a21 = mu * F.a12 - c * F.a21,
          .a22 = mu * F.a22 + c * F.a11};
}

/// paper eq. (8): K_ijkl = mu d_il d_jk + k G_ij G_lk + c G_ik G_lj, G = F^-1, c = -J dU/dJ, k = -J dc/dJ
/// [pressure].
[[gnu::always_inline]] inline Stiffness stiffness_of_shape_and_area(const Tensor2& F, double mu, double c,
                                                                    double k) {
  const double inverse_J = 1.0 / determinant_of(F);
  const double g11 = inverse_J * F.a22;
  const double g12 = -inverse_J * F.a12;
  const double g21 = -inverse_J * F.a21;
  const double g22 = inverse_J * F.a11;
  const double both = k + c;
  return {.k1111 = mu + both * g11 * g11,
          .k1112 = both * g11 * g21,
          .k1121 = both * g11 * g12,
          .k1122 = k * g11 * g22 + c * g12 * g21,
          .k1221 = mu + both * g12 * g12,
          .k1222 = both * g12 * g22,
          .k2112 = mu + both * g21 * g21,
          .k2121 = k * g21 * g12 + c * g22 * g11,
          .k2122 = both * g21 * g22,
          .k2222 = mu + both * g22 * g22};
}

}  // namespace fsi::solid
