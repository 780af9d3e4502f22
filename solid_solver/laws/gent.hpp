#pragma once
/// The compressible Gent law in plane strain: a neo-Hookean solid whose chains have a limiting stretch.
/// Objective; it locks where I1 - 3 reaches J_m.

#include <array>
#include <limits>
#include <optional>
#include <string_view>

#include "solid_solver/laws/law.hpp"
#include "solid_solver/laws/logarithm.hpp"

namespace fsi::solid {

/// psi = -mu J_m / 2 ln(1 - (I1 - 3) / J_m) - mu ln J + (lambda / 2 - mu / J_m) (ln J)^2, I1 - 3 = tr C - 2
/// in plane strain.
///
/// The locking resists a change of area too, with 2 mu / J_m at rest, which the coefficient of (ln J)^2 takes
/// off again: lambda and mu are the Lame constants of the rest state. Needs J_m >= 2 mu / lambda; otherwise
/// the energy of an element that is squeezed to nothing has no lower bound. J_m -> infinity is the
/// neo-Hookean law. As I1 - 3 goes to J_m energy, stress and stiffness grow without bound; beyond, and for J
/// <= 0, everything is not-a-number: the solid solver finds and names such points.
struct Gent {
  static constexpr std::string_view name = "gent";
  static constexpr bool objective = true;
  /// What a failed run says where the stress is not a number.
  static constexpr std::string_view end_of_law =
      "no stress, as where I1 - 3 reaches J_m and the law `gent` locks";

  double lambda = 0;                                ///< Lame constant of the rest state [pressure]
  double mu = 0;                                    ///< shear modulus of the rest state [pressure]
  double J_m = std::numeric_limits<double>::max();  ///< largest I1 - 3 [-]

  static constexpr std::array<OwnNumber<Gent>, 1> own_numbers{
      {{.key = "J_m", .meaning = "largest I1 - 3", .unit = "-", .member = &Gent::J_m, .typical = 8}}};

  constexpr std::optional<BrokenBound> broken_bound() const {
    if (J_m * lambda >= 2 * mu * (1 - round_off)) return {};
    if (lambda == 0)
      return {{.key = "J_m", .what = "needs a solid that resists a change of area: lambda (or nu) above 0"}};
    return {{.key = "J_m",
             .what = "must be at least 2 mu / lambda = ",
             .bound = 2 * mu / lambda,
             .why = ", or the energy has no lower bound"}};
  }

  /// Energy per unit reference volume.
  double psi(const Tensor2& F) const {
    const double log_J = logarithm(F.a11 * F.a22 - F.a12 * F.a21);
    return -0.5 * mu * J_m * logarithm(1.0 / stiffening(F)) - mu * log_J +
           0.5 * area_modulus() * log_J * log_J;
  }

  /// Nominal stress, paper eq. (7): mu g F^T + (l ln J - mu) F^-1, g = J_m / (J_m - (I1 - 3)),
  /// l = lambda - 2 mu / J_m.
  [[gnu::always_inline]] Tensor2 P(const Tensor2& F) const {
    const double J = F.a11 * F.a22 - F.a12 * F.a21;
    const double shape = mu * stiffening(F);
    const double c = (area_modulus() * logarithm(J) - mu) / J;
    return {.a11 = shape * F.a11 + c * F.a22,
            .a12 = shape * F.a21 - c * F.a12,
            .a21 = shape * F.a12 - c * F.a21,
            .a22 = shape * F.a22 + c * F.a11};
  }

  /// paper eq. (8): K_ijkl = mu g d_il d_jk + 2 mu g^2 / J_m F_ji F_kl + l G_ij G_lk
  /// + (mu - l ln J) G_ik G_lj, G = F^-1.
  [[gnu::always_inline]] Stiffness K(const Tensor2& F) const {
    const double J = F.a11 * F.a22 - F.a12 * F.a21;
    const double g = stiffening(F);
    const double shape = mu * g;
    const double locking = 2.0 * shape * (g / J_m);
    const double l = area_modulus();
    const double c = mu - l * logarithm(J);
    const double inverse_J = 1.0 / J;
    const double g11 = inverse_J * F.a22;
    const double g12 = -inverse_J * F.a12;
    const double g21 = -inverse_J * F.a21;
    const double g22 = inverse_J * F.a11;
    const double both = l + c;
    return {.k1111 = shape + locking * F.a11 * F.a11 + both * g11 * g11,
            .k1112 = locking * F.a11 * F.a12 + both * g11 * g21,
            .k1121 = locking * F.a11 * F.a21 + both * g11 * g12,
            .k1122 = locking * F.a11 * F.a22 + l * g11 * g22 + c * g12 * g21,
            .k1221 = shape + locking * F.a21 * F.a21 + both * g12 * g12,
            .k1222 = locking * F.a21 * F.a22 + both * g12 * g22,
            .k2112 = shape + locking * F.a12 * F.a12 + both * g21 * g21,
            .k2121 = locking * F.a12 * F.a21 + l * g21 * g12 + c * g22 * g11,
            .k2122 = locking * F.a12 * F.a22 + both * g21 * g22,
            .k2222 = shape + locking * F.a22 * F.a22 + both * g22 * g22};
  }

 private:
  static constexpr double round_off = 1e-12;

  /// What (ln J)^2 / 2 is multiplied with.
  [[gnu::always_inline]] double area_modulus() const { return lambda - 2.0 * (mu / J_m); }

  /// g = J_m / (J_m - (I1 - 3)), by which the law is stiffer
  /// than the neo-Hookean one; not-a-number where it locks.
  [[gnu::always_inline]] double stiffening(const Tensor2& F) const {
    const double stretch = F.a11 * F.a11 + F.a12 * F.a12 + F.a21 * F.a21 + F.a22 * F.a22 - 2.0;
    const double reserve = 1.0 - stretch / J_m;
    return reserve > 0.0 ? 1.0 / reserve : std::numeric_limits<double>::quiet_NaN();
  }
};

static_assert(Law<Gent>);

}  // namespace fsi::solid
