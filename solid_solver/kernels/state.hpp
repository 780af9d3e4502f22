#pragma once
/// How the unknowns of the solid lie in memory, and small operations on tensors of one point.

#include "solid_solver/laws/law.hpp"

namespace fsi::solid {

/// Planes of a state field.
namespace plane {
inline constexpr int u1 = 0, u2 = 1, v1 = 2, v2 = 3, P11 = 4, P12 = 5, P21 = 6, P22 = 7;
inline constexpr int count = 8;
}  // namespace plane

/// dP_ij/dt = K_ijkl L_kl for the velocity gradient L_kl = dv_k/dx_l: the last of paper eq. (4).
[[gnu::always_inline]] inline Tensor2 contract(const Stiffness& K, const Tensor2& L) {
  return {.a11 = K.k1111 * L.a11 + K.k1112 * L.a12 + K.k1121 * L.a21 + K.k1122 * L.a22,
          .a12 = K.k1121 * L.a11 + K.k2121 * L.a12 + K.k1221 * L.a21 + K.k1222 * L.a22,
          .a21 = K.k1112 * L.a11 + K.k2112 * L.a12 + K.k2121 * L.a21 + K.k2122 * L.a22,
          .a22 = K.k1122 * L.a11 + K.k2122 * L.a12 + K.k1222 * L.a21 + K.k2222 * L.a22};
}

[[gnu::always_inline]] inline double determinant(const Tensor2& F) {
  return F.a11 * F.a22 - F.a12 * F.a21;
}

}  // namespace fsi::solid
