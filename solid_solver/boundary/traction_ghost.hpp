#pragma once
/// Compatibility of stress and displacement at a boundary point: the derivative of u across a side whose
/// traction is known, and both derivatives at a corner where two such sides meet.

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "solid_solver/kernels/impedance.hpp"
#include "solid_solver/kernels/side_rows.hpp"
#include "solid_solver/kernels/state.hpp"

namespace fsi::solid {

inline Vec2 traction_of(const Tensor2& P, const Vec2& n0) {
  return {n0.x() * P.a11 + n0.y() * P.a21, n0.x() * P.a12 + n0.y() * P.a22};
}

/// F + d m^T.
inline Tensor2 plus_dyad(const Tensor2& F, const Vec2& d, const Vec2& m) {
  return {F.a11 + d.x() * m.x(), F.a12 + d.x() * m.y(), F.a21 + d.y() * m.x(), F.a22 + d.y() * m.y()};
}

inline Mat2 matrix(const SymmetricTensor2& A) {
  return (Mat2() << A.a11, A.a12, A.a12, A.a22).finished();
}

/// P behind waves along n that change its traction by `change`: P + K_ijkl g_k n_l with B g = change, where B is
/// the acoustic matrix of n. What no wave along n carries, the tangential stress that strain across n does not
/// account for, stays as it is.
inline Tensor2 behind_waves(const Tensor2& P, const Stiffness& K, const Vec2& n, const Vec2& change) {
  const Vec2 g = matrix(acoustic_matrix(K, n)).inverse() * change;
  const Tensor2 dP = contract(K, plus_dyad({}, g, n));
  return {P.a11 + dP.a11, P.a12 + dP.a12, P.a21 + dP.a21, P.a22 + dP.a22};
}

/// What the Newton iterations know of the point.
struct BoundaryStrain {
  Tensor2 F;    ///< F without the derivative across the side: I + (du/dalong) (grad along)^T
  Vec2 across;  ///< gradient of the index across the side
  Vec2 n0;      ///< outward unit normal
  double sign;  ///< across = sign |across| n0 [-]
};

/// What a derivative d of u across a side leaves of its traction T to be found.
struct TractionMiss {
  Vec2 miss;         ///< T - n0^T P(F)
  Mat2 B;            ///< acoustic matrix of n0
  bool bears_waves;  ///< B is positive definite, and det F > 0 where the law has finite strains
};

template <Law L>
TractionMiss traction_miss(const L& law, const BoundaryStrain& at, const Vec2& T, const Vec2& d) {
  const Tensor2 F = plus_dyad(at.F, d, at.across);
  const Mat2 B = matrix(acoustic_matrix(law.K(F), at.n0));
  const bool right_side_out = !L::objective || determinant(F) > 0;  // small strains know no inside out
  const bool bears_waves = right_side_out && B(0, 0) > 0 && B.determinant() > 0;
  return {.miss = T - traction_of(law.P(F), at.n0), .B = B, .bears_waves = bears_waves};
}

/// The derivative d for which the material is turned and stretched with the side, but not across it.
inline Vec2 unstrained_across(const BoundaryStrain& at) {
  const Vec2 t0(-at.n0.y(), at.n0.x());
  const Vec2 along = {at.F.a11 * t0.x() + at.F.a12 * t0.y(), at.F.a21 * t0.x() + at.F.a22 * t0.y()};
  const Vec2 normal = Vec2(along.y(), -along.x()).normalized();
  const Vec2 image = {at.F.a11 * at.n0.x() + at.F.a12 * at.n0.y(),
                      at.F.a21 * at.n0.x() + at.F.a22 * at.n0.y()};
  return (normal - image) * (at.sign / at.across.norm());
}

/// The derivative d of u over one index across the side for which n0^T P(F + d across^T) = T: paper eq. (43),
/// solved by Newton's method from `d`. The Jacobian is the acoustic matrix of n0, so it is regular while the
/// solid is hyperbolic. A step is halved until the material there can carry waves, and is not inside out, and
/// the traction comes nearer; where `d` itself, which was extrapolated, is not like that, the search begins
/// without a derivative across. Nothing when it does not converge:
/// then no state that carries waves has this traction.
template <Law L>
std::optional<Vec2> match_traction(const L& law, const BoundaryStrain& at, const Vec2& T, Vec2 d) {
  constexpr int most_iterations = 30;
  constexpr int most_halvings = 40;
  const double size = at.across.norm();
  TractionMiss now = traction_miss(law, at, T, d);
  if (!now.bears_waves) now = traction_miss(law, at, T, d = Vec2::Zero());
  if (!now.bears_waves) now = traction_miss(law, at, T, d = unstrained_across(at));
  if (!now.bears_waves) return std::nullopt;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Vec2 step = now.B.inverse() * now.miss * (at.sign / size);
    if (!step.allFinite()) return std::nullopt;
    if (step.norm() * size < newton_tolerance) return d + step;
    TractionMiss next = traction_miss(law, at, T, d + step);
    int halvings = 0;
    while (!(next.bears_waves && next.miss.norm() < now.miss.norm()) && ++halvings < most_halvings) {
      step *= 0.5;
      next = traction_miss(law, at, T, d + step);
    }
    if (halvings == most_halvings) {  // as near as rounding lets it come, or as the law does
      if (now.miss.norm() < newton_tolerance * now.B.norm()) return d;
      return std::nullopt;
    }
    d += step;
    now = next;
  }
  return std::nullopt;
}

/// The derivative d of v over one index across the side from the time derivative of paper eq. (43):
/// n0_i K_ijkl L_kl = dT_j/dt. `along` is L without the derivative across.
template <Law L>
Vec2 match_traction_rate(const L& law, const BoundaryStrain& at, const Vec2& d, const Tensor2& along,
                         const Vec2& T_rate) {
  const Stiffness K = law.K(plus_dyad(at.F, d, at.across));
  const Mat2 B = matrix(acoustic_matrix(K, at.n0));
  return B.inverse() * (T_rate - traction_of(contract(K, along), at.n0)) * (at.sign / at.across.norm());
}

/// As match_traction, but only the shear: t0 . n0^T P(F) = shear, d changed along t0 only.
template <Law L>
std::optional<Vec2> match_shear(const L& law, const BoundaryStrain& at, double shear, Vec2 d) {
  constexpr int most_iterations = 30;
  const double size = at.across.norm();
  const Vec2 t0(-at.n0.y(), at.n0.x());
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Tensor2 F = plus_dyad(at.F, d, at.across);
    const double stiffness = t0.dot(matrix(acoustic_matrix(law.K(F), at.n0)) * t0);
    if (!(stiffness > 0)) return std::nullopt;
    const double step = (shear - t0.dot(traction_of(law.P(F), at.n0))) * at.sign / (stiffness * size);
    d += step * t0;
    if (!d.allFinite()) return std::nullopt;
    if (std::abs(step) * size < newton_tolerance) return d;
  }
  return std::nullopt;
}

/// The least change of a gradient L that changes K_ijkl L_kl by `defect`, as far as stress can tell: a
/// rotation of the corner changes no stress of an unloaded objective solid, so the weakest of the four
/// directions is left as it is.
Tensor2 least_change(const Stiffness& K, const Tensor2& defect);

inline Tensor2 minus(const Tensor2& a, const Tensor2& b) {
  return {a.a11 - b.a11, a.a12 - b.a12, a.a21 - b.a21, a.a22 - b.a22};
}
inline Tensor2 plus(const Tensor2& a, const Tensor2& b) {
  return {a.a11 + b.a11, a.a12 + b.a12, a.a21 + b.a21, a.a22 + b.a22};
}

/// The F next to `start` for which P(F) is this stress; four unknowns, Newton's method. Nothing when it does not
/// converge or leaves det F > 0.
template <Law L>
std::optional<Tensor2> strain_with(const L& law, const Tensor2& P, const Tensor2& start) {
  constexpr int most_iterations = 20;
  constexpr double strain_tolerance = 1e-12;
  Tensor2 F = start;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Tensor2 step = least_change(law.K(F), minus(P, law.P(F)));
    F = plus(F, step);
    if (!(determinant(F) > 0)) return std::nullopt;
    const double size = std::abs(step.a11) + std::abs(step.a12) + std::abs(step.a21) + std::abs(step.a22);
    if (size < strain_tolerance) return F;
  }
  return std::nullopt;
}

/// The rotation nearest to F.
inline Tensor2 rotation_of(const Tensor2& F) {
  const double c = F.a11 + F.a22, s = F.a21 - F.a12, size = std::hypot(c, s);
  return {c / size, -s / size, s / size, c / size};
}

/// Corner of two sides with known traction: the F next to the given one for which P(F) is the stress that has
/// both tractions. `start` was extrapolated: it may stretch areas so far that the tension there, lambda ln J, takes the
/// stiffness against shear away (ln J = 2 mu / lambda for a neo-Hookean one, 4 % at a Poisson's ratio of 0.49), and
/// Newton's steps from there lead anywhere. The search then begins without strain, turned as `start` is.
template <Law L>
std::optional<Tensor2> match_corner(const L& law, const Tensor2& P, const Tensor2& start) {
  const std::optional<Tensor2> F = strain_with(law, P, start);
  return F ? F : strain_with(law, P, rotation_of(start));
}

/// Stress whose tractions on the normals n1 and n2 are T1 and T2: P = sum of dual normals times tractions.
inline Tensor2 stress_of_tractions(const Vec2& n1, const Vec2& T1, const Vec2& n2, const Vec2& T2) {
  const double cross = n1.x() * n2.y() - n1.y() * n2.x();
  const Vec2 m1 = Vec2(n2.y(), -n2.x()) / cross, m2 = Vec2(-n1.y(), n1.x()) / cross;
  return {m1.x() * T1.x() + m2.x() * T2.x(), m1.x() * T1.y() + m2.x() * T2.y(),
          m1.y() * T1.x() + m2.y() * T2.x(), m1.y() * T1.y() + m2.y() * T2.y()};
}

}  // namespace fsi::solid
