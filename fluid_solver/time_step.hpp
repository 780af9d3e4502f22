#pragma once
/// The largest stable time step from the eigenvalue of the discrete operator.

namespace fsi::fluid {

/// Time-stepping eigenvalue Lambda = -damping + i waves - beta / dt. paper eq. (44)
struct Eigenvalue {
  double damping = 0;  ///< -Lambda_r, not negative [1/time]
  double waves = 0;    ///< Lambda_i, positive [1/time]
  double beta = 0;     ///< of terms proportional to 1/dt; the gas has none [-]
};

/// Largest dt for which Lambda dt lies in the ellipse with semi-axes l_r = 2 and l_i = 1. paper eq. (45)
double largest_stable_step(const Eigenvalue& lambda);

}  // namespace fsi::fluid
