#include "fluid_solver/kernels/rates.hpp"

#include <cmath>

namespace fsi::fluid {

namespace {

void cartesian_rate_row(StateRow<const double> q, Spacing spacing, double gamma, double* rate, Range range) {
  const double per_dx = 1.0 / spacing.dx, per_dy = 1.0 / spacing.dy;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double a = std::sqrt(gamma * q.p[i] / q.rho[i]);
    rate[i] = (std::fabs(q.v1[i]) + a) * per_dx + (std::fabs(q.v2[i]) + a) * per_dy;
  }
}

void mapped_rate_row(StateRow<const double> q, const PointRows& points, PointRow before, double per_dt,
                     double gamma, double* rate, Range range) {
  const auto [below, here, above] = points;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double x_r1 = 0.5 * (here.x[i + 1] - here.x[i - 1]), y_r1 = 0.5 * (here.y[i + 1] - here.y[i - 1]);
    const double x_r2 = 0.5 * (above.x[i] - below.x[i]), y_r2 = 0.5 * (above.y[i] - below.y[i]);
    const double w1 = q.v1[i] - per_dt * (here.x[i] - before.x[i]),
                 w2 = q.v2[i] - per_dt * (here.y[i] - before.y[i]);
    const double a = std::sqrt(gamma * q.p[i] / q.rho[i]);
    const double across1 = std::fabs(w1 * y_r2 - w2 * x_r2) + a * std::sqrt(x_r2 * x_r2 + y_r2 * y_r2);
    const double across2 = std::fabs(w2 * x_r1 - w1 * y_r1) + a * std::sqrt(x_r1 * x_r1 + y_r1 * y_r1);
    rate[i] = (across1 + across2) / std::fabs(x_r1 * y_r2 - x_r2 * y_r1);
  }
}

}  // namespace

void wave_rate_row(ConstFieldView q, const StepGrid& grid, double dt, double gamma, int j, double* rate,
                   Range range) {
  if (grid.cartesian) {
    cartesian_rate_row(StateRow<const double>(q, j), *grid.cartesian, gamma, rate, range);
  } else {
    mapped_rate_row(StateRow<const double>(q, j), PointRows(grid.x, j), PointRow(grid.x_old, j),
                    dt > 0 ? 1 / dt : 0.0, gamma, rate, range);
  }
}

void diffusion_rate_row(ConstFieldView q, const StepGrid& grid, Viscosity viscosity, int j, double* rate,
                        Range range) {
  const auto [below, here, above] = StateRows(q, j);
  const auto [x_below, x, x_above] = PointRows(grid.x, j);
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double x_r1 = x.x[i + 1] - x.x[i - 1], y_r1 = x.y[i + 1] - x.y[i - 1];
    const double x_r2 = x_above.x[i] - x_below.x[i], y_r2 = x_above.y[i] - x_below.y[i];
    const double dv1_1 = here.v1[i + 1] - here.v1[i - 1], dv2_1 = here.v2[i + 1] - here.v2[i - 1];
    const double dv1_2 = above.v1[i] - below.v1[i], dv2_2 = above.v2[i] - below.v2[i];
    const double divergence =
        (y_r2 * dv1_1 - x_r2 * dv2_1 + x_r1 * dv2_2 - y_r1 * dv1_2) / (x_r1 * y_r2 - x_r2 * y_r1);
    rate[i] = 8.0 * (viscosity.shock * larger(0.0, -divergence) + viscosity.linear);
  }
}

double largest(const double* values, Range range) {
  double most = 0;
#pragma omp simd reduction(max : most)
  for (int i = range.first; i < range.last; ++i) most = most < values[i] ? values[i] : most;
  return most;
}

}  // namespace fsi::fluid
