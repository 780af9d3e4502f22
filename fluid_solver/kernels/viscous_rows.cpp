#include "fluid_solver/kernels/viscous_rows.hpp"

namespace fsi::fluid {

void add_viscous_flux_row(const ViscousPair& pair, double gamma, FluxRow flux, Range range) {
  const auto [a, b, kappa_a, kappa_b] = pair;
  const double internal = 1.0 / (gamma - 1.0);
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double kappa = 0.5 * (kappa_a[i] + kappa_b[i]);
    const double a1 = a.rho[i] * a.v1[i], a2 = a.rho[i] * a.v2[i], b1 = b.rho[i] * b.v1[i],
                 b2 = b.rho[i] * b.v2[i];
    const double a3 = internal * a.p[i] + 0.5 * (a1 * a.v1[i] + a2 * a.v2[i]);
    const double b3 = internal * b.p[i] + 0.5 * (b1 * b.v1[i] + b2 * b.v2[i]);
    flux.mass[i] -= kappa * (b.rho[i] - a.rho[i]);
    flux.momentum1[i] -= kappa * (b1 - a1);
    flux.momentum2[i] -= kappa * (b2 - a2);
    flux.energy[i] -= kappa * (b3 - a3);
  }
}

}  // namespace fsi::fluid
