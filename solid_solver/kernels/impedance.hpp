#pragma once
/// What a solid tells the coupler about its characteristics: the impedance matrix Z of a boundary point.

#include <cmath>

#include "common/core/types.hpp"
#include "solid_solver/laws/law.hpp"

namespace fsi::solid {

/// Symmetric 2 x 2 matrix as plain numbers.
struct SymmetricTensor2 {
  double a11 = 0, a12 = 0, a22 = 0;  ///< [unit of the tensor]
};

/// The acoustic matrix B_jk = n_i K_ijkl n_l of waves that travel along the unit vector n of the reference
/// space. T' of paper eq. (16) is B seen in the frame (n0,
/// t0); its eigenvalues are phi_p and phi_s = rho c^2.
[[gnu::always_inline]] inline SymmetricTensor2 acoustic_matrix(const Stiffness& K, double n1, double n2) {
  const double n11 = n1 * n1;
  const double n12 = n1 * n2;
  const double n22 = n2 * n2;
  return {.a11 = n11 * K.k1111 + 2.0 * n12 * K.k1112 + n22 * K.k2112,
          .a12 = n11 * K.k1121 + n12 * (K.k1122 + K.k2121) + n22 * K.k2122,
          .a22 = n11 * K.k1221 + 2.0 * n12 * K.k1222 + n22 * K.k2222};
}
inline SymmetricTensor2 acoustic_matrix(const Stiffness& K, const Vec2& n) {
  return acoustic_matrix(K, n.x(), n.y());
}

/// Z = eta sum_j z_j Y_j Y_j^T, z_j = sqrt(rho phi_j), with phi_j, Y_j the eigenpairs of the acoustic matrix
/// B for the outward reference normal n0: both relations of paper eq.
/// (23) are then w - Z v = w_0 - Z v_0 in Cartesian components.
///
/// Z = eta sqrt(rho) sqrt(B), and the root of a positive definite 2 x 2 matrix has the closed form
/// sqrt(B) = (B + d I) / sqrt(tr B + 2 d), d = sqrt(det B): no eigenvectors, no branches.
/// Not-a-number where B is not positive definite, that is where the solid is no longer hyperbolic.
/// @param rho reference density  @param eta reference area / current area, paper eq. (13)
[[gnu::always_inline]] inline SymmetricTensor2 impedance_of(const SymmetricTensor2& B, double rho,
                                                            double eta) {
  const double d = std::sqrt(B.a11 * B.a22 - B.a12 * B.a12);
  const double scale = eta * std::sqrt(rho / (B.a11 + B.a22 + 2.0 * d));
  return {.a11 = scale * (B.a11 + d), .a12 = scale * B.a12, .a22 = scale * (B.a22 + d)};
}
inline SymmetricTensor2 impedance_matrix(const Stiffness& K, const Vec2& n0, double rho, double eta) {
  return impedance_of(acoustic_matrix(K, n0), rho, eta);
}

}  // namespace fsi::solid
