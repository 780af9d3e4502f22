#pragma once
/// The largest stable time step from the eigenvalue of the discrete operator.

#include <cmath>

namespace fsi::fluid {

/// Time-stepping eigenvalue Lambda = -damping + i waves; the
/// gas has no part proportional to 1/dt. paper eq. (44)
struct Eigenvalue {
  double damping = 0;  ///< -Lambda_r, not negative [1/time]
  double waves = 0;    ///< Lambda_i, positive [1/time]
};

/// 1 / dt of the largest dt for which Lambda dt lies in the ellipse with semi-axes l_r = 2 and l_i = 1.
/// paper eq. (45). By value: a reference to a temporary has an address in every iteration of a loop.
[[gnu::always_inline]] inline double stable_rate(Eigenvalue lambda) {
  constexpr double l_r = 2, l_i = 1;
  const double real = lambda.damping / l_r, imaginary = lambda.waves / l_i;
  return std::sqrt(real * real + imaginary * imaginary);
}

}  // namespace fsi::fluid
