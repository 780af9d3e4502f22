#pragma once
/// The largest stable time step.

#include "solid_solver/options.hpp"

namespace fsi::solid {

/// Time-stepping eigenvalue Lambda = Lambda_r + i Lambda_i - beta / dt, paper eq. (44).
struct TimeSteppingEigenvalue {
  double real = 0;       ///< Lambda_r <= 0 [1/time]
  double imaginary = 0;  ///< Lambda_i [1/time]
  double beta = 0;       ///< [-]
};

/// Lambda of the scheme with waves that cross a cell at `wave_rate` = sum over directions of c_p |grad r|
/// [1/time]. u carries beta^u; P carries beta^P and beta^r together; bulk diffusion acts on v and P with
/// symbol -8 in 2-D.
TimeSteppingEigenvalue time_stepping_eigenvalue(double wave_rate, const SolidOptions& options);

/// The dt that reaches the boundary of the stability ellipse with semi-axes 2 and 1, paper eq. (45); 0 when
/// beta >= 2.
double largest_time_step(const TimeSteppingEigenvalue& lambda);

/// Rates at which upwinding acts [1/time].
struct UpwindRates {
  double velocity = 0;  ///< sum over directions of c_p |grad r| [1/time]
  /// Largest eigenvalue of sum over directions of K Z^-1 n^T |grad r|, or a bound of it [1/time]
  double stress = 0;
};

/// The dt at which a sawtooth in both directions reaches the amplification -1. There all first differences
/// vanish and decay is all that is left: per step 2 dt times the upwind rate, beta^r and half of beta^P for
/// the stress (paper eq. (39) shares it among the directions), and 8 dt times the bulk diffusion. The ellipse
/// of paper eq. (45) has no such term, since (44) leaves upwinding out of Lambda_r: it ends at c_p dt / h =
/// 1, where upwinding alone has used up the real axis.
double largest_decay_step(const UpwindRates& rates, const SolidOptions& options);

}  // namespace fsi::solid
