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

}  // namespace fsi::solid
