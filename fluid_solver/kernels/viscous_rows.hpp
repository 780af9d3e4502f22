#pragma once
/// Artificial viscosity: a flux -kappa (q_after - q_before) of the conserved variables through every face,
/// with the mean of
///
///     kappa = dt V [ shock_viscosity max(0, -div v) + linear_diffusion ]
///
/// of the two points beside the face: undivided second differences.

#include "fluid_solver/kernels/flow_rows.hpp"

namespace fsi::fluid {

struct Viscosity {
  double shock = 0;   ///< coefficient of max(0, -div v) [-]
  double linear = 0;  ///< rate [1/time]
  bool any() const { return shock > 0 || linear > 0; }
};

/// kappa at the points of a row.
template <class Metric>
[[gnu::noinline]] void viscosity_row(const StateRows& rows, Metric metric, Viscosity viscosity, double dt,
                                     double* kappa, Range range) {
  const auto [below, here, above] = rows;
  const double linear = dt * viscosity.linear, shock = 0.5 * viscosity.shock;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double divergence =
        metric.divergence(i, here.v1[i + 1] - here.v1[i - 1], here.v2[i + 1] - here.v2[i - 1],
                          above.v1[i] - below.v1[i], above.v2[i] - below.v2[i]);
    kappa[i] = metric.volume(i) * (shock * larger(0.0, -divergence) + linear);
  }
}

/// Conserved variables at the points of a row.
void conserved_row(StateRow<const double> q, double gamma, ConservedRow out, Range range);

/// Adds the viscous fluxes between the points of rows `before` and `after` (a row and itself shifted by one
/// for direction 1).
struct ViscousPair {
  ConservedRow before, after;
  const double *kappa_before, *kappa_after;
};
void add_viscous_flux_row(const ViscousPair& pair, FluxRow flux, Range range);

}  // namespace fsi::fluid
