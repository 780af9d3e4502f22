#pragma once
/// The compressible neo-Hookean law in plane strain. Objective;
/// the energy grows without bound as J goes to zero.

#include "solid_solver/laws/law.hpp"
#include "solid_solver/laws/logarithm.hpp"
#include "solid_solver/laws/shape_and_area.hpp"

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
    const double log_J = logarithm(determinant_of(F));
    return 0.5 * lambda * log_J * log_J - mu * log_J + 0.5 * mu * stretch_of(F);
  }

  /// Nominal stress, paper eq. (7) with S of paper eq. (10).
  [[gnu::always_inline]] Tensor2 P(const Tensor2& F) const {
    return stress_of_shape_and_area(F, mu, lambda * logarithm(determinant_of(F)) - mu);
  }

  /// paper eq. (8): K_ijkl = mu d_il d_jk + lambda G_ij G_lk + (mu - lambda ln J) G_ik G_lj, G = F^-1.
  [[gnu::always_inline]] Stiffness K(const Tensor2& F) const {
    return stiffness_of_shape_and_area(F, mu, mu - lambda * logarithm(determinant_of(F)), lambda);
  }
};

static_assert(Law<NeoHookean>);

}  // namespace fsi::solid
