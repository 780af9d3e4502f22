#include "fluid_solver/kernels/viscous_rows.hpp"

namespace fsi::fluid {

void conserved_row(StateRow<const double> q, double gamma, ConservedRow out, Range range) {
  const double internal = 1.0 / (gamma - 1.0);
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double momentum1 = q.rho[i] * q.v1[i], momentum2 = q.rho[i] * q.v2[i];
    out.mass[i] = q.rho[i];
    out.momentum1[i] = momentum1;
    out.momentum2[i] = momentum2;
    out.energy[i] = internal * q.p[i] + 0.5 * (momentum1 * q.v1[i] + momentum2 * q.v2[i]);
  }
}

void add_viscous_flux_row(const ViscousPair& pair, FluxRow flux, Range range) {
  const auto [a, b, kappa_a, kappa_b] = pair;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double kappa = 0.5 * (kappa_a[i] + kappa_b[i]);
    flux.mass[i] -= kappa * (b.mass[i] - a.mass[i]);
    flux.momentum1[i] -= kappa * (b.momentum1[i] - a.momentum1[i]);
    flux.momentum2[i] -= kappa * (b.momentum2[i] - a.momentum2[i]);
    flux.energy[i] -= kappa * (b.energy[i] - a.energy[i]);
  }
}

}  // namespace fsi::fluid
