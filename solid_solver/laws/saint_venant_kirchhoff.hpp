#pragma once
/// The Saint Venant-Kirchhoff law in plane strain: a linear relation between the second Piola-Kirchhoff
/// stress S and the Green strain E. Objective, but soft under strong compression.

#include "solid_solver/laws/law.hpp"

namespace fsi::solid {

/// paper eq. (9): P = S F^T, S = lambda tr(E) I + 2 mu E, with the Green strain E = (F^T F - I) / 2.
struct SaintVenantKirchhoff {
  static constexpr std::string_view name = "saint_venant_kirchhoff";
  static constexpr bool objective = true;
  static constexpr bool quick_stiffness = true;  ///< K is a polynomial
  static constexpr std::string_view where_soft =
      "this law loses its stiffness where it is pressed together; `neo_hookean` does not";

  double lambda = 0;  ///< Lame constant [pressure]
  double mu = 0;      ///< shear modulus [pressure]

  /// Energy per unit reference volume, lambda/2 tr(E)^2 + mu tr(E^2).
  double psi(const Tensor2& F) const {
    const Symmetric E = green_strain(F);
    const double trace = E.a11 + E.a22;
    return 0.5 * lambda * trace * trace + mu * (E.a11 * E.a11 + E.a22 * E.a22 + 2.0 * E.a12 * E.a12);
  }

  /// Nominal stress, paper eq. (7) with S of paper eq. (9).
  [[gnu::always_inline]] Tensor2 P(const Tensor2& F) const {
    const Symmetric S = second_stress(F);
    return {.a11 = S.a11 * F.a11 + S.a12 * F.a12,
            .a12 = S.a11 * F.a21 + S.a12 * F.a22,
            .a21 = S.a12 * F.a11 + S.a22 * F.a12,
            .a22 = S.a12 * F.a21 + S.a22 * F.a22};
  }

  /// paper eq. (8): K_ijkl = S_il d_jk + lambda F_ji F_kl + mu (d_il B_jk + F_jl F_ki), B = F F^T.
  [[gnu::always_inline]] Stiffness K(const Tensor2& F) const {
    const Symmetric S = second_stress(F);
    const double b11 = mu * (F.a11 * F.a11 + F.a12 * F.a12);
    const double b12 = mu * (F.a11 * F.a21 + F.a12 * F.a22);
    const double b22 = mu * (F.a21 * F.a21 + F.a22 * F.a22);
    const double both = lambda + mu;
    return {.k1111 = S.a11 + both * F.a11 * F.a11 + b11,
            .k1112 = S.a12 + both * F.a11 * F.a12,
            .k1121 = both * F.a11 * F.a21 + b12,
            .k1122 = lambda * F.a11 * F.a22 + mu * F.a12 * F.a21,
            .k1221 = S.a11 + both * F.a21 * F.a21 + b22,
            .k1222 = S.a12 + both * F.a21 * F.a22,
            .k2112 = S.a22 + both * F.a12 * F.a12 + b11,
            .k2121 = lambda * F.a12 * F.a21 + mu * F.a11 * F.a22,
            .k2122 = both * F.a12 * F.a22 + b12,
            .k2222 = S.a22 + both * F.a22 * F.a22 + b22};
  }

 private:
  struct Symmetric {
    double a11 = 0, a12 = 0, a22 = 0;
  };

  [[gnu::always_inline]] static Symmetric green_strain(const Tensor2& F) {
    return {.a11 = 0.5 * (F.a11 * F.a11 + F.a21 * F.a21 - 1.0),
            .a12 = 0.5 * (F.a11 * F.a12 + F.a21 * F.a22),
            .a22 = 0.5 * (F.a12 * F.a12 + F.a22 * F.a22 - 1.0)};
  }

  [[gnu::always_inline]] Symmetric second_stress(const Tensor2& F) const {
    const Symmetric E = green_strain(F);
    const double pressure = lambda * (E.a11 + E.a22);
    return {.a11 = pressure + 2.0 * mu * E.a11, .a12 = 2.0 * mu * E.a12, .a22 = pressure + 2.0 * mu * E.a22};
  }
};

static_assert(Law<SaintVenantKirchhoff>);

}  // namespace fsi::solid
