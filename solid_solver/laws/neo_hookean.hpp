#pragma once
/// The compressible neo-Hookean law in plane strain. Objective;
/// the energy grows without bound as J goes to zero.

#include "solid_solver/laws/law.hpp"
#include "solid_solver/laws/logarithm.hpp"

namespace fsi::solid {

/// paper eq. (10): P = S F^T, S = lambda ln(J) C^-1 + mu (I - C^-1), C = F^T F.
///
/// With C^-1 F^T = F^-1 the stress is P = mu F^T + (lambda ln J - mu) F^-1, so neither C nor S is formed.
/// For J <= 0 everything is not-a-number: the solid solver finds and names such points.
struct NeoHookean {
  static constexpr std::string_view name = "neo_hookean";
  static constexpr bool objective = true;

  double lambda = 0;  ///< Lame constant [pressure]
  double mu = 0;      ///< shear modulus [pressure]

  /// Energy per unit reference volume, lambda/2 (ln J)^2 - mu ln J + mu/2 (tr C - 3), with C33 = 1.
  double psi(const Tensor2& F) const {
    const double log_J = logarithm(F.a11 * F.a22 - F.a12 * F.a21);
    const double stretch = F.a11 * F.a11 + F.a12 * F.a12 + F.a21 * F.a21 + F.a22 * F.a22 - 2.0;
    return 0.5 * lambda * log_J * log_J - mu * log_J + 0.5 * mu * stretch;
  }

  /// Nominal stress, paper eq. (7) with S of paper eq. (10).
  [[gnu::always_inline]] Tensor2 P(const Tensor2& F) const {
    const double J = F.a11 * F.a22 - F.a12 * F.a21;
    const double c = (lambda * logarithm(J) - mu) / J;
    return {.a11 = mu * F.a11 + c * F.a22,
            .a12 = mu * F.a21 - c * F.a12,
            .a21 = mu * F.a12 - c * F.a21,
            .a22 = mu * F.a22 + c * F.a11};
  }

  /// paper eq. (8): K_ijkl = mu d_il d_jk + lambda G_ij G_lk + (mu - lambda ln J) G_ik G_lj, G = F^-1.
  [[gnu::always_inline]] Stiffness K(const Tensor2& F) const {
    const double J = F.a11 * F.a22 - F.a12 * F.a21;
    const double c = mu - lambda * logarithm(J);
    const double inverse_J = 1.0 / J;
    const double g11 = inverse_J * F.a22;
    const double g12 = -inverse_J * F.a12;
    const double g21 = -inverse_J * F.a21;
    const double g22 = inverse_J * F.a11;
    const double both = lambda + c;
    return {.k1111 = mu + both * g11 * g11,
            .k1112 = both * g11 * g21,
            .k1121 = both * g11 * g12,
            .k1122 = lambda * g11 * g22 + c * g12 * g21,
            .k1221 = mu + both * g12 * g12,
            .k1222 = both * g12 * g22,
            .k2112 = mu + both * g21 * g21,
            .k2121 = lambda * g21 * g12 + c * g22 * g11,
            .k2122 = both * g21 * g22,
            .k2222 = mu + both * g22 * g22};
  }
};

static_assert(Law<NeoHookean>);

}  // namespace fsi::solid
