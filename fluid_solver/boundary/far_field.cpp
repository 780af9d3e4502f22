#include "fluid_solver/boundary/far_field.hpp"

#include <algorithm>
#include <cmath>

namespace fsi::fluid {

namespace {

double sound(const StateVector& q, double gamma) {
  return std::sqrt(gamma * q[3] / q[0]);
}

/// Mach number of the front of a wave over which the pressure changes by this ratio: of a shock, or 1 of a rarefaction.
double shock_mach(double ratio, double gamma) {
  return std::sqrt(1 + std::max(0.0, (gamma + 1) / (2 * gamma) * (ratio - 1)));
}

}  // namespace

BoundedState between(const StateVector& inside, const StateVector& beyond, const OpenSide& side) {
  const double gamma = side.gamma, half = 0.5 * (gamma - 1), z = half / gamma;
  const Vec2 v(inside[1], inside[2]), v_beyond(beyond[1], beyond[2]);
  const double a = sound(inside, gamma), u = side.n.dot(v), a_beyond = sound(beyond, gamma);
  if (u - side.speed - a > 0) return {.q = inside, .bounded = false};
  // (p / p_inside)^z - 1 where both families end at one p and u. In changes, so that equal states stay equal to the bit.
  const double change_u = side.n.dot(v_beyond - v), lack = -std::expm1(-z * std::log(beyond[3] / inside[3]));
  const double of_waves = (a_beyond * lack - half * change_u) / (a + a_beyond * (1 - lack));
  const double change = std::max(of_waves, least_sound - 1);
  const double p = inside[3] * std::exp(std::log1p(change) / z), u_side = u - a * change / half;
  const double outermost = u + change_u + a_beyond * shock_mach(p / beyond[3], gamma);
  if (u - side.speed + a <= 0 || outermost <= side.speed) return {.q = beyond, .bounded = false};
  const StateVector& source = u_side > side.speed ? inside : beyond;
  const Vec2 v_source(source[1], source[2]), v_side = v_source + (u_side - side.n.dot(v_source)) * side.n;
  return {.q = {source[0] * std::pow(p / source[3], 1 / gamma), v_side[0], v_side[1], p},
          .bounded = of_waves < least_sound - 1};
}

}  // namespace fsi::fluid
