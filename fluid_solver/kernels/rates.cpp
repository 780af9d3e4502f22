#include "fluid_solver/kernels/rates.hpp"

#include <cmath>

#include "fluid_solver/kernels/time_step.hpp"

namespace fsi::fluid {

namespace {

constexpr double diffusion_symbol = 8;  ///< of undivided second differences in two directions

/// Undivided central differences of the velocity at point i in both directions.
struct VelocityDifferences {
  double v1_r1, v2_r1, v1_r2, v2_r2;
  [[gnu::always_inline]] VelocityDifferences(const StateRows& rows, int i)
      : v1_r1(0.5 * (rows.here.v1[i + 1] - rows.here.v1[i - 1])),
        v2_r1(0.5 * (rows.here.v2[i + 1] - rows.here.v2[i - 1])),
        v1_r2(0.5 * (rows.above.v1[i] - rows.below.v1[i])),
        v2_r2(0.5 * (rows.above.v2[i] - rows.below.v2[i])) {}
};

[[gnu::always_inline]] inline double damping(const Viscosity& viscosity, double divergence) {
  return diffusion_symbol * (viscosity.shock * larger(0.0, -divergence) + viscosity.linear);
}

/// A grid at rest: two spacings.
template <bool viscous>
void cartesian_rates(const StateRows& rows, Spacing spacing, const Scheme& scheme, double* rate,
                     Range range) {
  const auto q = rows.here;
  const double per_dx = 1.0 / spacing.dx, per_dy = 1.0 / spacing.dy, gamma = scheme.gamma;
  const Viscosity viscosity = scheme.viscosity;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double a = std::sqrt(gamma * q.p[i] / q.rho[i]);
    const double waves = (std::fabs(q.v1[i]) + a) * per_dx + (std::fabs(q.v2[i]) + a) * per_dy;
    if constexpr (viscous) {
      const VelocityDifferences d(rows, i);
      rate[i] = stable_rate({damping(viscosity, per_dx * d.v1_r1 + per_dy * d.v2_r2), waves});
    } else {
      rate[i] = waves;
    }
  }
}

struct MovedRow {
  PointRows points;
  PointRow before;
  double per_dt;
};

template <bool viscous>
void mapped_rates(const StateRows& rows, const MovedRow& grid, const Scheme& scheme, double* rate,
                  Range range) {
  const auto q = rows.here;
  const auto [below, here, above] = grid.points;
  const PointRow before = grid.before;
  const double per_dt = grid.per_dt, gamma = scheme.gamma;
  const Viscosity viscosity = scheme.viscosity;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double x_r1 = 0.5 * (here.x[i + 1] - here.x[i - 1]), y_r1 = 0.5 * (here.y[i + 1] - here.y[i - 1]);
    const double x_r2 = 0.5 * (above.x[i] - below.x[i]), y_r2 = 0.5 * (above.y[i] - below.y[i]);
    const double J = x_r1 * y_r2 - x_r2 * y_r1;
    const double w1 = q.v1[i] - per_dt * (here.x[i] - before.x[i]),
                 w2 = q.v2[i] - per_dt * (here.y[i] - before.y[i]);
    const double a = std::sqrt(gamma * q.p[i] / q.rho[i]);
    const double across1 = std::fabs(w1 * y_r2 - w2 * x_r2) + a * std::sqrt(x_r2 * x_r2 + y_r2 * y_r2);
    const double across2 = std::fabs(w2 * x_r1 - w1 * y_r1) + a * std::sqrt(x_r1 * x_r1 + y_r1 * y_r1);
    const double waves = (across1 + across2) / std::fabs(J);
    if constexpr (viscous) {
      const VelocityDifferences d(rows, i);
      const double divergence = (y_r2 * d.v1_r1 - x_r2 * d.v2_r1 + x_r1 * d.v2_r2 - y_r1 * d.v1_r2) / J;
      rate[i] = stable_rate({damping(viscosity, divergence), waves});
    } else {
      rate[i] = waves;
    }
  }
}

}  // namespace

void step_rate_row(ConstFieldView q, const StepGrid& grid, double dt, const Scheme& scheme, int j,
                   double* rate, Range range) {
  const StateRows rows(q, j);
  const bool viscous = scheme.viscosity.any();
  if (grid.cartesian) {
    (viscous ? cartesian_rates<true> : cartesian_rates<false>)(rows, *grid.cartesian, scheme, rate, range);
  } else {
    const MovedRow moved{PointRows(grid.x, j), PointRow(grid.x_old, j), dt > 0 ? 1 / dt : 0.0};
    (viscous ? mapped_rates<true> : mapped_rates<false>)(rows, moved, scheme, rate, range);
  }
}

double largest(const double* values, Range range) {
  double most = 0;
#pragma omp simd reduction(max : most)
  for (int i = range.first; i < range.last; ++i) most = most < values[i] ? values[i] : most;
  return most;
}

}  // namespace fsi::fluid
