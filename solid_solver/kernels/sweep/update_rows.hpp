#pragma once
/// The step of one row of points from what the sweep knows of it.

#include "solid_solver/kernels/sweep/sweep_rows.hpp"

namespace fsi::solid {

/// What moves u in paper eq. (37): this share of the mean of the old and the new velocity, and of the
/// predicted one at t + dt/2 what is left. The paper takes the latter alone; with the relaxation (41) long
/// waves then grow. At 2/3 the integral of v is of third order in time, from 3/4 on no wave grows
/// (docs/theory_solid.md, stability).
inline constexpr double mean_velocity_share = 0.8;

/// Unknowns of a point as plain numbers.
struct PointState {
  double u1, u2, v1, v2, P11, P12, P21, P22;  ///< as in `plane`
};

/// Row j of all unknowns; T is double or const double.
template <class T>
struct StateRow {
  T *u1, *u2, *v1, *v2, *P11, *P12, *P21, *P22;
  [[gnu::always_inline]] PointState at(int i) const {
    return {u1[i], u2[i], v1[i], v2[i], P11[i], P12[i], P21[i], P22[i]};
  }
  [[gnu::always_inline]] void set(int i, PointState s) const {
    u1[i] = s.u1;
    u2[i] = s.u2;
    v1[i] = s.v1;
    v2[i] = s.v2;
    P11[i] = s.P11;
    P12[i] = s.P12;
    P21[i] = s.P21;
    P22[i] = s.P22;
  }
};

template <class T>
StateRow<T> state_row(BasicFieldView<T> q, int j) {
  return {q.row(plane::u1, j),  q.row(plane::u2, j),  q.row(plane::v1, j),  q.row(plane::v2, j),
          q.row(plane::P11, j), q.row(plane::P12, j), q.row(plane::P21, j), q.row(plane::P22, j)};
}

/// Row j of the stress.
template <class T>
struct BasicStressRow {
  T *P11, *P12, *P21, *P22;

  BasicStressRow(T* p11, T* p12, T* p21, T* p22) : P11(p11), P12(p12), P21(p21), P22(p22) {}
  BasicStressRow(BasicFieldView<T> q, int j)
      : P11(q.row(plane::P11, j)),
        P12(q.row(plane::P12, j)),
        P21(q.row(plane::P21, j)),
        P22(q.row(plane::P22, j)) {}
  operator BasicStressRow<const double>() const { return {P11, P12, P21, P22}; }
  [[gnu::always_inline]] void subtract(int i, double a11, double a12, double a21, double a22) const {
    P11[i] -= a11;
    P12[i] -= a12;
    P21[i] -= a21;
    P22[i] -= a22;
  }
};
using StressRow = BasicStressRow<double>;
using ConstStressRow = BasicStressRow<const double>;

/// Nothing is added to the step of a point.
struct NoTerms {
  [[gnu::always_inline]] NoTerms at(int /*i*/) const { return {}; }
  [[gnu::always_inline]] PointState to(PointState s) const { return s; }
};

/// What the update of a row reads.
template <class Row>
struct UpdateRows {
  Row row;
  StateRow<const double> q;
  FaceRows along1, low, high;  ///< solutions at the faces i - 1/2 and on both sides of the row
  StiffnessRows stiff;
  const double *centre1, *centre2;  ///< velocity at t + dt/2
  const double *b1, *b2;            ///< body force
  double dt, dt_rho, dt_mean,
      dt_centre;  ///< the step, over the density, and the shares of it in paper eq. (37)

  /// paper eq. (35): momentum from the forces on the four faces; paper eq. (36): stress from the face
  /// velocities with the point's own K and grad r, exactly zero for a uniform velocity; paper eq. (37): what
  /// the mean of the old and the new velocity brings to the displacement.
  [[gnu::always_inline]] PointState updated(int i) const {
    const PointState s = q.at(i);
    const double per_area = row.inverse_area(i);
    const double f1 = (along1.f1[i + 1] - along1.f1[i]) + (high.f1[i] - low.f1[i]);
    const double f2 = (along1.f2[i + 1] - along1.f2[i]) + (high.f2[i] - low.f2[i]);
    const double v1 = s.v1 + dt_rho * (per_area * f1 + b1[i]);
    const double v2 = s.v2 + dt_rho * (per_area * f2 + b2[i]);
    const Pair L1 = row.gradient(i, along1.v1[i + 1] - along1.v1[i], high.v1[i] - low.v1[i]);
    const Pair L2 = row.gradient(i, along1.v2[i + 1] - along1.v2[i], high.v2[i] - low.v2[i]);
    const Tensor2 dP = contract(stiff.at(i), {L1.x, L1.y, L2.x, L2.y});
    return {.u1 = (s.u1 + dt_centre * centre1[i]) + dt_mean * (s.v1 + v1),
            .u2 = (s.u2 + dt_centre * centre2[i]) + dt_mean * (s.v2 + v2),
            .v1 = v1,
            .v2 = v2,
            .P11 = s.P11 + dt * dP.a11,
            .P12 = s.P12 + dt * dP.a12,
            .P21 = s.P21 + dt * dP.a21,
            .P22 = s.P22 + dt * dP.a22};
  }
};

}  // namespace fsi::solid
