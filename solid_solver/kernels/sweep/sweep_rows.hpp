#pragma once
/// Rows of unknowns, faces and stiffnesses as the loops of the sweep see them. Whatever a loop calls is
/// inlined by force, here and in the other headers of the kernels:
/// a loop with one call left in it does not vectorise.

#include <algorithm>
#include <cmath>

#include "common/core/field.hpp"
#include "solid_solver/kernels/metrics_rows.hpp"
#include "solid_solver/kernels/riemann.hpp"
#include "solid_solver/kernels/state.hpp"
#include "solid_solver/options.hpp"

namespace fsi::solid {

/// The middle one of three values.
[[gnu::always_inline]] inline double median(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/// Half of the undivided slope at the middle one of three values: centred, `mc` up to twice the smaller difference,
/// `minmod` the smaller difference.
template <Limiter limiter>
[[gnu::always_inline]] inline double half_slope(double lower, double middle, double upper) {
  if constexpr (limiter == Limiter::none) {
    return 0.25 * (upper - lower);
  } else {
    const double a = middle - lower, b = upper - middle;
    const double smaller = median(a, b, 0.0);  // the smaller difference where they agree in sign, else zero
    return limiter == Limiter::minmod ? 0.5 * smaller : median(0.25 * (upper - lower), smaller, 0.0);
  }
}

/// A row of one unknown with its two neighbours.
struct StencilRow {
  const double *below, *here, *above;

  [[gnu::always_inline]] StencilRow(ConstFieldView q, int plane, int j)
      : below(q.row(plane, j - 1)), here(q.row(plane, j)), above(q.row(plane, j + 1)) {}
  [[gnu::always_inline]] double operator[](int i) const { return here[i]; }
  /// Half slopes along r1 and r2.
  template <Limiter limiter>
  [[gnu::always_inline]] Pair half_slopes(int i) const {
    return {half_slope<limiter>(here[i - 1], here[i], here[i + 1]),
            half_slope<limiter>(below[i], here[i], above[i])};
  }
};

/// Central differences of u + time * v over one index along r1 and r2.
[[gnu::always_inline]] inline Pair displacement_difference(const StencilRow& u, const StencilRow& v, int i,
                                                           double time) {
  return {0.5 * ((u.here[i + 1] - u.here[i - 1]) + time * (v.here[i + 1] - v.here[i - 1])),
          0.5 * ((u.above[i] - u.below[i]) + time * (v.above[i] - v.below[i]))};
}

/// Row j of all unknowns with its two neighbours.
struct StateRows {
  StencilRow u1, u2, v1, v2, P11, P12, P21, P22;

  [[gnu::always_inline]] StateRows(ConstFieldView q, int j)
      : u1(q, plane::u1, j),
        u2(q, plane::u2, j),
        v1(q, plane::v1, j),
        v2(q, plane::v2, j),
        P11(q, plane::P11, j),
        P12(q, plane::P12, j),
        P21(q, plane::P21, j),
        P22(q, plane::P22, j) {}
};

/// F at point i of a row for the displacement u + time * v by second-order differences, paper eq. (33), a
/// discrete paper eq. (3).
template <class Row>
[[gnu::always_inline]] inline Tensor2 deformation_gradient(const Row& row, const StateRows& q, int i,
                                                           double time) {
  const Pair d1 = displacement_difference(q.u1, q.v1, i, time),
             d2 = displacement_difference(q.u2, q.v2, i, time);
  const Pair g1 = row.gradient(i, d1.x, d1.y), g2 = row.gradient(i, d2.x, d2.y);
  return {1.0 + g1.x, g1.y, g2.x, 1.0 + g2.y};
}

/// Velocities and forces along a row of faces. Temporaries go in by value: a reference to one has an address
/// in every iteration, and the loop does not vectorise.
struct FaceRows {
  double *v1, *v2, *f1, *f2;

  [[gnu::always_inline]] void set(int i, double w1, double w2, Pair force) const {
    v1[i] = w1;
    v2[i] = w2;
    f1[i] = force.x;
    f2[i] = force.y;
  }
  [[gnu::always_inline]] void set(int i, const FaceState& s) const { set(i, s.v1, s.v2, {s.f1, s.f2}); }
  [[gnu::always_inline]] FaceState at(int i) const { return {v1[i], v2[i], f1[i], f2[i]}; }
};

/// Acoustic matrices along a row.
struct AcousticRows {
  double *a11, *a12, *a22;

  [[gnu::always_inline]] void set(int i, const SymmetricTensor2& A) const {
    a11[i] = A.a11;
    a12[i] = A.a12;
    a22[i] = A.a22;
  }
  [[gnu::always_inline]] SymmetricTensor2 at(int i) const {
    return {.a11 = a11[i], .a12 = a12[i], .a22 = a22[i]};
  }
};

/// Stiffnesses along a row.
struct StiffnessRows {
  double *k1111, *k1112, *k1121, *k1122, *k1221, *k1222, *k2112, *k2121, *k2122, *k2222;

  [[gnu::always_inline]] void set(int i, const Stiffness& K) const {
    k1111[i] = K.k1111;
    k1112[i] = K.k1112;
    k1121[i] = K.k1121;
    k1122[i] = K.k1122;
    k1221[i] = K.k1221;
    k1222[i] = K.k1222;
    k2112[i] = K.k2112;
    k2121[i] = K.k2121;
    k2122[i] = K.k2122;
    k2222[i] = K.k2222;
  }
  [[gnu::always_inline]] Stiffness at(int i) const {
    return {k1111[i], k1112[i], k1121[i], k1122[i], k1221[i],
            k1222[i], k2112[i], k2121[i], k2122[i], k2222[i]};
  }
};

/// Largest and smallest eigenvalue of an acoustic matrix:
/// phi_p and phi_s, paper eq. (16) and the text after it.
[[gnu::always_inline]] inline Pair wave_eigenvalues(const SymmetricTensor2& A) {
  const double mean = 0.5 * (A.a11 + A.a22), difference = 0.5 * (A.a11 - A.a22);
  const double radius = std::sqrt(difference * difference + A.a12 * A.a12);
  return {mean + radius, mean - radius};
}

/// Whether all waves are real: A is positive definite. False for what is no number.
[[gnu::always_inline]] inline bool bears_waves(const SymmetricTensor2& A) {
  return (A.a11 > 0.0) & (A.a11 * A.a22 - A.a12 * A.a12 > 0.0);
}

}  // namespace fsi::solid
