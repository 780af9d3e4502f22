#include "solid_solver/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fsi::solid {

TimeSteppingEigenvalue time_stepping_eigenvalue(double wave_rate, const SolidOptions& options) {
  constexpr double diffusion_symbol = 8;
  const double stress_rate =
      options.tangential_stress.rate + options.relaxation.rate + diffusion_symbol * options.bulk_diffusion;
  const double stress_beta = options.tangential_stress.scaled + options.relaxation.scaled;
  return {.real = -std::max(stress_rate, options.displacement.rate),
          .imaginary = wave_rate,
          .beta = std::max(stress_beta, options.displacement.scaled)};
}

double largest_time_step(const TimeSteppingEigenvalue& lambda) {
  constexpr double l_r = 2, l_i = 1;
  const double r = lambda.real / l_r, i = lambda.imaginary / l_i, beta = lambda.beta / l_r;
  const double a = r * r + i * i, b = -2.0 * r * beta, c = beta * beta - 1.0;
  if (c >= 0) return 0;
  if (a == 0) return std::numeric_limits<double>::infinity();
  // The root (-b + sqrt(b^2 - 4 a c)) / (2 a) without cancellation: b >= 0, c < 0.
  return -2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c));
}

double largest_decay_step(const UpwindRates& rates, const SolidOptions& options) {
  constexpr double diffusion_symbol = 8, limit = 2;
  const double bulk = diffusion_symbol * options.bulk_diffusion;
  const double relaxation = options.relaxation.rate + 0.5 * options.tangential_stress.rate;
  const double left = limit - options.relaxation.scaled - 0.5 * options.tangential_stress.scaled;
  const double velocity_step = limit / (limit * rates.velocity + bulk);
  const double stress_step = left / (limit * rates.stress + relaxation + bulk);
  return std::min(velocity_step, stress_step);
}

}  // namespace fsi::solid
