#pragma once
/// Loops over the points of a side. What they work on is gathered into rows of one number per point, so that
/// they are vector code whichever way the side lies in memory.

#include <cmath>

#include "common/core/field.hpp"
#include "solid_solver/kernels/impedance.hpp"
#include "solid_solver/kernels/state.hpp"

namespace fsi::solid {

/// A tensor at the points of a side.
struct TensorRows {
  double *a11, *a12, *a21, *a22;

  [[gnu::always_inline]] Tensor2 at(int k) const { return {a11[k], a12[k], a21[k], a22[k]}; }
  [[gnu::always_inline]] void set(int k, double b11, double b12, double b21, double b22) const {
    a11[k] = b11;
    a12[k] = b12;
    a21[k] = b21;
    a22[k] = b22;
  }
};

/// The rows of a side: its geometry, which stays, and what its boundary conditions look for.
struct SideRows {
  enum Row {
    normal1,  ///< outward unit normal of the reference body
    normal2,
    across1,  ///< gradient of the index across the side [1/length]
    across2,
    size,   ///< |across| [1/length]
    scale,  ///< sign / size: across = sign size n0 [length]
    F11,    ///< without the derivative across, or all of it
    F12,
    F21,
    F22,
    T1,  ///< nominal traction that P(F) is to have
    T2,
    d1,  ///< derivative of u over one index across the side
    d2,
    next1,  ///< the derivative Newton's method tries next
    next2,
    miss1,  ///< T - n0^T P(F)
    miss2,
    B11,  ///< acoustic matrix of n0, or an impedance
    B12,
    B22,
    open,  ///< 1: searching; 0: found; -1: to be searched point by point
    P11,
    P12,
    P21,
    P22,
    gap1,  ///< by how much the extrapolated derivative across is more than `d`, per length [-]
    gap2,
    count
  };

  FieldView rows;  ///< layout (n, count), one plane

  double* operator[](Row row) const { return rows.row(0, row); }
  TensorRows F() const { return {(*this)[F11], (*this)[F12], (*this)[F21], (*this)[F22]}; }
  TensorRows P() const { return {(*this)[P11], (*this)[P12], (*this)[P21], (*this)[P22]}; }
  int n() const { return rows.layout.n1; }
};

/// Newton's method ends at steps that change strains by less [-].
inline constexpr double newton_tolerance = 1e-13;

/// T - n0^T P(F + d across^T) for the derivatives in `next`, and the acoustic matrices there. `open` becomes -1
/// where the material carries no waves, or where the traction came no nearer, unless it is the `first` look.
template <Law L>
[[gnu::noinline]] void find_misses(const L& law_at, const SideRows& side, bool first) {
  const L law = law_at;
  const TensorRows F0 = side.F();
  const double *n1 = side[SideRows::normal1], *n2 = side[SideRows::normal2], *a1 = side[SideRows::across1],
               *a2 = side[SideRows::across2], *T1 = side[SideRows::T1], *T2 = side[SideRows::T2];
  double *d1 = side[SideRows::d1], *d2 = side[SideRows::d2], *to1 = side[SideRows::next1],
         *to2 = side[SideRows::next2], *miss1 = side[SideRows::miss1], *miss2 = side[SideRows::miss2],
         *B11 = side[SideRows::B11], *B12 = side[SideRows::B12], *B22 = side[SideRows::B22],
         *open = side[SideRows::open];
  const double forgiven = first ? 1.0 : 0.0;
#pragma omp simd
  for (int k = 0; k < side.n(); ++k) {
    const Tensor2 F = {F0.a11[k] + to1[k] * a1[k], F0.a12[k] + to1[k] * a2[k], F0.a21[k] + to2[k] * a1[k],
                       F0.a22[k] + to2[k] * a2[k]};
    const Tensor2 P = law.P(F);
    const SymmetricTensor2 B = acoustic_matrix(law.K(F), n1[k], n2[k]);
    const double m1 = T1[k] - (n1[k] * P.a11 + n2[k] * P.a21), m2 = T2[k] - (n1[k] * P.a12 + n2[k] * P.a22);
    const double before = miss1[k] * miss1[k] + miss2[k] * miss2[k];
    const bool right_side_out = !L::objective || determinant(F) > 0.0;
    const bool bears_waves = right_side_out & (B.a11 > 0.0) & (B.a11 * B.a22 - B.a12 * B.a12 > 0.0);
    const bool nearer = (forgiven > 0.0) | (m1 * m1 + m2 * m2 < before);
    const bool searching = open[k] > 0.0;
    const bool good = searching & bears_waves & nearer;
    open[k] = (searching & !good) ? -1.0 : open[k];
    d1[k] = good ? to1[k] : d1[k];
    d2[k] = good ? to2[k] : d2[k];
    miss1[k] = m1;
    miss2[k] = m2;
    B11[k] = B.a11;
    B12[k] = B.a12;
    B22[k] = B.a22;
  }
}

/// Newton's steps from `d` to `next`; where they are small the search ends there. Returns how many go on.
[[gnu::noinline]] inline double take_newton_steps(const SideRows& side) {
  const double *scale = side[SideRows::scale], *size = side[SideRows::size], *miss1 = side[SideRows::miss1],
               *miss2 = side[SideRows::miss2], *B11 = side[SideRows::B11], *B12 = side[SideRows::B12],
               *B22 = side[SideRows::B22];
  double *d1 = side[SideRows::d1], *d2 = side[SideRows::d2], *to1 = side[SideRows::next1],
         *to2 = side[SideRows::next2], *open = side[SideRows::open];
  double searching = 0;
#pragma omp simd reduction(+ : searching)
  for (int k = 0; k < side.n(); ++k) {
    const double per_det = scale[k] / (B11[k] * B22[k] - B12[k] * B12[k]);
    const double s1 = per_det * (B22[k] * miss1[k] - B12[k] * miss2[k]),
                 s2 = per_det * (B11[k] * miss2[k] - B12[k] * miss1[k]);
    const bool is_open = open[k] > 0.0;
    const bool found = is_open & (std::sqrt(s1 * s1 + s2 * s2) * size[k] < newton_tolerance);
    to1[k] = d1[k] + s1;
    to2[k] = d2[k] + s2;
    d1[k] = found ? to1[k] : d1[k];
    d2[k] = found ? to2[k] : d2[k];
    open[k] = found ? 0.0 : open[k];
    searching += (is_open & !found) ? 1.0 : 0.0;
  }
  return searching;
}

/// Newton's method for paper eq. (43) at all points of a side at once, from the derivatives in `next`: those with
/// n0^T P(F + d across^T) = T. Where full steps do not lead there, `open` is not 0 afterwards, and
/// the search must be a more careful one.
template <Law L>
void match_tractions(const L& law, const SideRows& side) {
  constexpr int most_iterations = 12;
  find_misses(law, side, true);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    if (take_newton_steps(side) == 0) return;
    find_misses(law, side, false);
  }
}

/// P of F.
template <Law L>
[[gnu::noinline]] void find_stresses(const L& law_at, const SideRows& side) {
  const L law = law_at;
  const TensorRows F = side.F(), to = side.P();
#pragma omp simd
  for (int k = 0; k < side.n(); ++k) {
    const Tensor2 P = law.P(F.at(k));
    to.set(k, P.a11, P.a12, P.a21, P.a22);
  }
}

/// A pressure -w that follows the deformation is in T as the traction of a stress w J F^-1, which makes no force inside a body: the
/// derivative along the side of its tangential part cancels that of its traction across. Across, tractions are differenced from
/// inside. So the tangential part of P takes this stress with the derivative of u from inside, not with that of paper eq. (43), which
/// has no part in it: what is left of the two pushes the side, and the push grows what it comes from. Under tension it pulls the side
/// back, and stays (docs/theory_solid.md, *Solids under pressure*).
[[gnu::noinline]] inline void add_pressed_gaps(const SideRows& side) {
  const TensorRows F = side.F(), P = side.P();
  const double *n1 = side[SideRows::normal1], *n2 = side[SideRows::normal2], *T1 = side[SideRows::T1],
               *T2 = side[SideRows::T2], *gap1 = side[SideRows::gap1], *gap2 = side[SideRows::gap2];
#pragma omp simd
  for (int k = 0; k < side.n(); ++k) {
    const double area1 = F.a22[k] * n1[k] - F.a21[k] * n2[k], area2 = F.a11[k] * n2[k] - F.a12[k] * n1[k];
    const double load = (T1[k] * area1 + T2[k] * area2) / (area1 * area1 + area2 * area2);
    const double w = load < 0.0 ? load : 0.0;
    P.a11[k] += w * n2[k] * gap2[k];
    P.a12[k] -= w * n2[k] * gap1[k];
    P.a21[k] -= w * n1[k] * gap2[k];
    P.a22[k] += w * n1[k] * gap1[k];
  }
}

/// Impedance matrices of F per unit reference area, in the rows B; not a number where there is none.
template <Law L>
[[gnu::noinline]] void find_impedances(const L& law_at, const SideRows& side, double rho) {
  const L law = law_at;
  const TensorRows F = side.F();
  const double *n1 = side[SideRows::normal1], *n2 = side[SideRows::normal2];
  double *Z11 = side[SideRows::B11], *Z12 = side[SideRows::B12], *Z22 = side[SideRows::B22];
#pragma omp simd
  for (int k = 0; k < side.n(); ++k) {
    const SymmetricTensor2 Z = impedance_of(acoustic_matrix(law.K(F.at(k)), n1[k], n2[k]), rho, 1.0);
    Z11[k] = Z.a11;
    Z12[k] = Z.a12;
    Z22[k] = Z.a22;
  }
}

/// What the gas meets at the points of an interface.
struct InterfaceRows {
  TensorRows F;
  const double *normal1, *normal2;
  double *w1, *w2;  ///< traction per unit reference area, and then per unit current area
  double *Z11, *Z12, *Z22;
  int n;
  bool follows;  ///< the load belongs to the current area
};

/// Reference area / current area of an element with reference normal n0, paper eq. (13): the tangent is stretched
/// by |F t0|, and J^-1 n^T F n0 = 1 / |F t0| in the plane.
[[gnu::always_inline]] inline double area_ratio(const Tensor2& F, double n1, double n2) {
  const double t1 = F.a12 * n1 - F.a11 * n2, t2 = F.a22 * n1 - F.a21 * n2;
  return 1.0 / std::sqrt(t1 * t1 + t2 * t2);
}

/// Tractions and impedance matrices per unit current area.
template <Law L>
[[gnu::noinline]] void show_interface(const L& law_at, const InterfaceRows& rows_at, double rho) {
  const L law = law_at;
  const InterfaceRows rows = rows_at;
  const double share = rows.follows ? 1.0 : 0.0;
#pragma omp simd
  for (int k = 0; k < rows.n; ++k) {
    const Tensor2 F = rows.F.at(k);
    const double n1 = rows.normal1[k], n2 = rows.normal2[k];
    const double eta = share > 0.0 ? area_ratio(F, n1, n2) : 1.0;
    const SymmetricTensor2 Z = impedance_of(acoustic_matrix(law.K(F), n1, n2), rho, eta);
    rows.w1[k] *= eta;
    rows.w2[k] *= eta;
    rows.Z11[k] = Z.a11;
    rows.Z12[k] = Z.a12;
    rows.Z22[k] = Z.a22;
  }
}

}  // namespace fsi::solid
