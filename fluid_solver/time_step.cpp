#include "fluid_solver/time_step.hpp"

#include <cmath>

namespace fsi::fluid {

double largest_stable_step(const Eigenvalue& lambda) {
  constexpr double l_r = 2, l_i = 1;
  const double real = lambda.damping / l_r, imaginary = lambda.waves / l_i, beta = lambda.beta / l_r;
  const double a = real * real + imaginary * imaginary, half_b = real * beta, c = beta * beta - 1;
  return (-half_b + std::sqrt(half_b * half_b - a * c)) / a;
}

}  // namespace fsi::fluid
