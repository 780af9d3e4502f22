#pragma once
/// The row kernels of one step: predict face states, solve Riemann problems, update. Templates over limiter,
/// Riemann solver and metric; whole rows, no branches, no side effects besides their output rows.

#include <cmath>

#include "fluid_solver/kernels/geometry_rows.hpp"
#include "fluid_solver/kernels/limiter.hpp"
#include "fluid_solver/kernels/riemann/face_state.hpp"

namespace fsi::fluid {

/// Metrics of a Cartesian grid at rest: two numbers.
struct CartesianMetric {
  double dt_dx, dt_dy;  ///< [time/length]

  double advect1(int /*i*/, double v1, double /*v2*/) const { return dt_dx * v1; }
  double advect2(int /*i*/, double /*v1*/, double v2) const { return dt_dy * v2; }
  double divergence(int /*i*/, double v1_r1, double /*v2_r1*/, double /*v1_r2*/, double v2_r2) const {
    return dt_dx * v1_r1 + dt_dy * v2_r2;
  }
  double gradient1(int /*i*/, double p_r1, double /*p_r2*/) const { return dt_dx * p_r1; }
  double gradient2(int /*i*/, double /*p_r1*/, double p_r2) const { return dt_dy * p_r2; }
  double volume(int /*i*/) const { return 1.0; }
};

/// Metrics of a mapped grid: dt times those of (30), at half time.
struct MappedMetric {
  MetricRow m;

  double advect1(int i, double v1, double v2) const { return m.r1_x[i] * v1 + m.r1_y[i] * v2 - m.drift1[i]; }
  double advect2(int i, double v1, double v2) const { return m.r2_x[i] * v1 + m.r2_y[i] * v2 - m.drift2[i]; }
  double divergence(int i, double v1_r1, double v2_r1, double v1_r2, double v2_r2) const {
    return (m.r1_x[i] * v1_r1 + m.r1_y[i] * v2_r1) + (m.r2_x[i] * v1_r2 + m.r2_y[i] * v2_r2);
  }
  double gradient1(int i, double p_r1, double p_r2) const { return m.r1_x[i] * p_r1 + m.r2_x[i] * p_r2; }
  double gradient2(int i, double p_r1, double p_r2) const { return m.r1_y[i] * p_r1 + m.r2_y[i] * p_r2; }
  double volume(int i) const { return m.volume[i]; }
};

/// Rows j - 1, j, j + 1 of the state.
struct StateRows {
  StateRow<const double> below, here, above;
  StateRows(ConstFieldView q, int j) : below(q, j - 1), here(q, j), above(q, j + 1) {}
};

/// Predicted states at the four faces of every point of a row, at half time.
struct PredictedRows {
  StateRow<double> left, right, lower, upper;
  double* first_order;  ///< 1 where the point fell back to first-order states, else 0
};

/// A predicted density or pressure below this part of the present one counts as not positive.
inline constexpr double smallest_part = 1e-8;

/// Half a time step of the quasi-linear form of (31) from limited slopes, then out to the faces. Where a face
/// state would have no positive density or pressure, the point
/// keeps its present state on all faces (first order).
template <class Limiter, class Metric>
[[gnu::noinline]] void predict_row(const StateRows& rows, Metric metric, double gamma,
                                   const PredictedRows& out, Range range) {
  const auto [below, here, above] = rows;
  const auto [left, right, lower, upper, first_order] = out;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double rho = here.rho[i], v1 = here.v1[i], v2 = here.v2[i], p = here.p[i];
    double rho_1 = Limiter::half_slope(rho - here.rho[i - 1], here.rho[i + 1] - rho);
    double v1_1 = Limiter::half_slope(v1 - here.v1[i - 1], here.v1[i + 1] - v1);
    double v2_1 = Limiter::half_slope(v2 - here.v2[i - 1], here.v2[i + 1] - v2);
    double p_1 = Limiter::half_slope(p - here.p[i - 1], here.p[i + 1] - p);
    double rho_2 = Limiter::half_slope(rho - below.rho[i], above.rho[i] - rho);
    double v1_2 = Limiter::half_slope(v1 - below.v1[i], above.v1[i] - v1);
    double v2_2 = Limiter::half_slope(v2 - below.v2[i], above.v2[i] - v2);
    double p_2 = Limiter::half_slope(p - below.p[i], above.p[i] - p);

    const double c1 = metric.advect1(i, v1, v2), c2 = metric.advect2(i, v1, v2);
    const double divergence = metric.divergence(i, v1_1, v2_1, v1_2, v2_2), specific = 1.0 / rho;
    double rho_h = rho - ((c1 * rho_1 + c2 * rho_2) + rho * divergence);
    double v1_h = v1 - ((c1 * v1_1 + c2 * v1_2) + specific * metric.gradient1(i, p_1, p_2));
    double v2_h = v2 - ((c1 * v2_1 + c2 * v2_2) + specific * metric.gradient2(i, p_1, p_2));
    double p_h = p - ((c1 * p_1 + c2 * p_2) + gamma * p * divergence);

    const double rho_least = rho_h - larger(std::fabs(rho_1), std::fabs(rho_2));
    const double p_least = p_h - larger(std::fabs(p_1), std::fabs(p_2));
    const bool positive = (rho_least > smallest_part * rho) & (p_least > smallest_part * p);
    rho_h = positive ? rho_h : rho;
    v1_h = positive ? v1_h : v1;
    v2_h = positive ? v2_h : v2;
    p_h = positive ? p_h : p;
    const double keep = positive ? 1.0 : 0.0;
    rho_1 *= keep, v1_1 *= keep, v2_1 *= keep, p_1 *= keep;
    rho_2 *= keep, v1_2 *= keep, v2_2 *= keep, p_2 *= keep;

    left.rho[i] = rho_h - rho_1, left.v1[i] = v1_h - v1_1, left.v2[i] = v2_h - v2_1, left.p[i] = p_h - p_1;
    right.rho[i] = rho_h + rho_1, right.v1[i] = v1_h + v1_1, right.v2[i] = v2_h + v2_1,
    right.p[i] = p_h + p_1;
    lower.rho[i] = rho_h - rho_2, lower.v1[i] = v1_h - v1_2, lower.v2[i] = v2_h - v2_2,
    lower.p[i] = p_h - p_2;
    upper.rho[i] = rho_h + rho_2, upper.v1[i] = v1_h + v1_2, upper.v2[i] = v2_h + v2_2,
    upper.p[i] = p_h + p_2;
    first_order[i] = 1.0 - keep;
  }
}

/// Fluxes through faces at rest whose normal is the direction
/// of v1; `area` is dt / (spacing along the normal).
template <class Riemann>
[[gnu::noinline]] void flux_row(StateRow<const double> L, StateRow<const double> R, Riemann solve,
                                double area, FluxRow out, Range range) {
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const FaceFlux flux =
        solve({L.rho[i], L.v1[i], L.v2[i], L.p[i]}, {R.rho[i], R.v1[i], R.v2[i], R.p[i]}, 0.0);
    out.mass[i] = area * flux.mass;
    out.momentum1[i] = area * flux.normal;
    out.momentum2[i] = area * flux.tangential;
    out.energy[i] = area * flux.energy;
  }
}

/// Fluxes through moving faces: into the frame of the face, Riemann problem, and back.
template <class Riemann>
[[gnu::noinline]] void flux_row(StateRow<const double> L, StateRow<const double> R, Riemann solve,
                                const FaceRow& faces, FluxRow out, Range range) {
  const FaceRow face = faces;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double n1 = face.n1[i], n2 = face.n2[i], area = face.area[i];
    const FaceFlux flux =
        solve({L.rho[i], n1 * L.v1[i] + n2 * L.v2[i], n1 * L.v2[i] - n2 * L.v1[i], L.p[i]},
              {R.rho[i], n1 * R.v1[i] + n2 * R.v2[i], n1 * R.v2[i] - n2 * R.v1[i], R.p[i]}, face.speed[i]);
    out.mass[i] = area * flux.mass;
    out.momentum1[i] = area * (n1 * flux.normal - n2 * flux.tangential);
    out.momentum2[i] = area * (n2 * flux.normal + n1 * flux.tangential);
    out.energy[i] = area * flux.energy;
  }
}

/// Fluxes through the four faces of the points of a row.
struct FluxRows {
  FluxRow along, lower, upper;
};

/// Volumes of a row at both times; not read on a Cartesian grid, where both are 1.
struct VolumeRow {
  const double *old, *now;
};

/// A step with positive fluxes leaves a point at least the part of its density and pressure that lies beyond
/// the reach of its waves; one that leaves less than this is looked at again.
inline constexpr double thin_part = 1e-2;

/// What the gas law and the floor contribute to an update.
struct UpdateLaw {
  double gamma, p_floor;  ///< [-], [pressure]
};

/// V^{n+1} q^{n+1} = V^n q^n - dt * (sum of fluxes), the conservative form of (31). paper eq. (31)
/// @returns the number of points that are left less than `thin_part` of their density or pressure, less than
/// the floor, or no number
template <bool mapped>
[[gnu::noinline]] double update_row(StateRow<const double> old, const FluxRows& flux, VolumeRow volume,
                                    UpdateLaw law, StateRow<double> out, Range range) {
  const auto [along, lower, upper] = flux;
  const double gamma_1 = law.gamma - 1.0, internal = 1.0 / gamma_1;
  double thin = 0;
#pragma omp simd reduction(+ : thin)
  for (int i = range.first; i < range.last; ++i) {
    double q0 = old.rho[i], q1 = q0 * old.v1[i], q2 = q0 * old.v2[i];
    double q3 = internal * old.p[i] + 0.5 * (q1 * old.v1[i] + q2 * old.v2[i]);
    const double change0 = (along.mass[i] - along.mass[i - 1]) + (upper.mass[i] - lower.mass[i]);
    const double change1 =
        (along.momentum1[i] - along.momentum1[i - 1]) + (upper.momentum1[i] - lower.momentum1[i]);
    const double change2 =
        (along.momentum2[i] - along.momentum2[i - 1]) + (upper.momentum2[i] - lower.momentum2[i]);
    const double change3 = (along.energy[i] - along.energy[i - 1]) + (upper.energy[i] - lower.energy[i]);
    if constexpr (mapped) {
      const double inverse = 1.0 / volume.now[i], V_old = volume.old[i];
      q0 = inverse * (V_old * q0 - change0);
      q1 = inverse * (V_old * q1 - change1);
      q2 = inverse * (V_old * q2 - change2);
      q3 = inverse * (V_old * q3 - change3);
    } else {
      q0 -= change0, q1 -= change1, q2 -= change2, q3 -= change3;
    }
    const double specific = 1.0 / q0, v1 = specific * q1, v2 = specific * q2;
    const double p = gamma_1 * (q3 - 0.5 * (q1 * v1 + q2 * v2));
    const double p_least = larger(thin_part * old.p[i], law.p_floor);
    const bool sound = (q0 > thin_part * old.rho[i]) & (p > p_least) & (p < 1e300);
    thin += sound ? 0.0 : 1.0;
    out.rho[i] = q0;
    out.v1[i] = v1;
    out.v2[i] = v2;
    out.p[i] = p;
  }
  return thin;
}

}  // namespace fsi::fluid
