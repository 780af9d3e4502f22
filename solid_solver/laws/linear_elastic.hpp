#pragma once
/// Linear elasticity in plane strain: the small-strain limit of every other law, and not objective.

#include "solid_solver/laws/law.hpp"

namespace fsi::solid {

/// paper eq. (11): P = lambda tr(E~) I + 2 mu E~ with the linear strain E~ = (F + F^T) / 2 - I.
struct LinearElastic {
  static constexpr std::string_view name = "linear_elastic";
  static constexpr bool objective = false;  ///< a rigid rotation strains E~ to second order in the angle

  double lambda = 0;  ///< Lame constant [pressure]
  double mu = 0;      ///< shear modulus [pressure]

  /// Energy per unit reference volume, lambda/2 tr(E~)^2 + mu E~ : E~.
  double psi(const Tensor2& F) const {
    const double e11 = F.a11 - 1.0;
    const double e22 = F.a22 - 1.0;
    const double e12 = 0.5 * (F.a12 + F.a21);
    const double trace = e11 + e22;
    return 0.5 * lambda * trace * trace + mu * (e11 * e11 + e22 * e22 + 2.0 * e12 * e12);
  }

  /// Nominal stress, paper eq. (11). It is symmetric.
  [[gnu::always_inline]] Tensor2 P(const Tensor2& F) const {
    const double e11 = F.a11 - 1.0;
    const double e22 = F.a22 - 1.0;
    const double shear = mu * (F.a12 + F.a21);
    const double pressure = lambda * (e11 + e22);
    return {pressure + 2.0 * mu * e11, shear, shear, pressure + 2.0 * mu * e22};
  }

  /// paper eq. (5): K_ijkl = lambda d_ij d_kl + mu (d_ik d_jl + d_il d_jk), the same for every F.
  [[gnu::always_inline]] Stiffness K(const Tensor2& /*F*/) const {
    const double diagonal = lambda + 2.0 * mu;
    return {.k1111 = diagonal,
            .k1112 = 0.0,
            .k1121 = 0.0,
            .k1122 = lambda,
            .k1221 = mu,
            .k1222 = 0.0,
            .k2112 = mu,
            .k2121 = mu,
            .k2122 = 0.0,
            .k2222 = diagonal};
  }
};

static_assert(Law<LinearElastic>);

}  // namespace fsi::solid
