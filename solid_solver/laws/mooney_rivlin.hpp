#pragma once
/// The compressible Mooney-Rivlin law in plane strain: the neo-Hookean law and a part that is linear in the
/// second invariant. Objective; the energy grows without bound as J goes to zero.

#include <array>
#include <optional>
#include <string_view>

#include "solid_solver/laws/law.hpp"
#include "solid_solver/laws/logarithm.hpp"
#include "solid_solver/laws/shape_and_area.hpp"

namespace fsi::solid {

/// psi = c10 (I1 - 3) + c01 (I2 - 3) - (2 c10 + 4 c01) ln J + (lambda - 4 c01) / 2 (ln J)^2, c10 = mu/2 -
/// c01.
///
/// The coefficients of ln J make the rest state free of stress and give it the Lame constants lambda and mu,
/// and c01 = 0 is the neo-Hookean law. In plane strain C33 = 1 makes I1 = tr C + 1 and I2 = tr C + J^2, so
/// that c10 and c01 act as their sum, mu / 2, on the shape of an element, and c01 alone on its area:
///
///     psi = mu/2 (tr C - 2) - mu ln J + c01 (J^2 - 1 - 2 ln J) + (lambda - 4 c01) / 2 (ln J)^2.
///
/// Needs 0 <= c01 <= mu / 2 and 4 c01 <= lambda; otherwise the energy is not bounded from below.
/// For J <= 0 everything is not-a-number: the solid solver finds and names such points.
struct MooneyRivlin {
  static constexpr std::string_view name = "mooney_rivlin";
  static constexpr bool objective = true;

  double lambda = 0;  ///< Lame constant of the rest state [pressure]
  double mu = 0;      ///< shear modulus of the rest state, 2 (c10 + c01) [pressure]
  double c01 = 0;     ///< coefficient of I2 - 3 [pressure]

  static constexpr std::array<OwnNumber<MooneyRivlin>, 1> own_numbers{{{.key = "c01",
                                                                        .meaning = "coefficient of I2 - 3",
                                                                        .unit = "pressure",
                                                                        .member = &MooneyRivlin::c01,
                                                                        .typical = 0.3}}};

  constexpr std::optional<BrokenBound> broken_bound() const {
    if (c01 > 0.5 * mu * (1 + round_off))
      return {{.key = "c01",
               .what = "must be at most mu / 2 = ",
               .bound = 0.5 * mu,
               .why = ": mu / 2 is c10 + c01"}};
    if (4 * c01 > lambda * (1 + round_off))
      return {{.key = "c01",
               .what = "must be at most lambda / 4 = ",
               .bound = 0.25 * lambda,
               .why = ", or the energy has no lower bound; lambda is bulk - 4/3 (c10 + c01)"}};
    return {};
  }

  /// Energy per unit reference volume.
  double psi(const Tensor2& F) const {
    const double J = determinant_of(F);
    const double log_J = logarithm(J);
    return 0.5 * mu * stretch_of(F) - mu * log_J + c01 * (J * J - 1.0 - 2.0 * log_J) +
           0.5 * (lambda - 4.0 * c01) * log_J * log_J;
  }

  /// Nominal stress, paper eq. (7): mu F^T + c F^-1, c = J dU/dJ of the part U(J) of psi.
  [[gnu::always_inline]] Tensor2 P(const Tensor2& F) const {
    return stress_of_shape_and_area(F, mu, area_stress(determinant_of(F)));
  }

  /// paper eq. (8): K_ijkl = mu d_il d_jk + k G_ij G_lk - c G_ik G_lj, G = F^-1, c as in P, k = J dc/dJ.
  [[gnu::always_inline]] Stiffness K(const Tensor2& F) const {
    const double J = determinant_of(F);
    return stiffness_of_shape_and_area(F, mu, -area_stress(J), lambda + 4.0 * c01 * (J * J - 1.0));
  }

 private:
  static constexpr double round_off = 1e-12;

  /// J dU/dJ of U(J) = c01 (J^2 - 1 - 2 ln J) + (lambda - 4 c01) / 2 (ln J)^2 - mu ln J.
  [[gnu::always_inline]] double area_stress(double J) const {
    return 2.0 * c01 * (J * J - 1.0) + (lambda - 4.0 * c01) * logarithm(J) - mu;
  }
};

static_assert(Law<MooneyRivlin>);

}  // namespace fsi::solid
