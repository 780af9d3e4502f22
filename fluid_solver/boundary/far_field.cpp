#include "fluid_solver/boundary/far_field.hpp"

#include <algorithm>
#include <cmath>

namespace fsi::fluid {

namespace {

double sound(const StateVector& q, double gamma) {
  return std::sqrt(gamma * q[3] / q[0]);
}

}  // namespace

BoundedState between(const StateVector& inside, const StateVector& beyond, const OpenSide& side) {
  const double gamma = side.gamma, per_a = 2 / (gamma - 1);
  const Vec2 v(inside[1], inside[2]);
  const double a = sound(inside, gamma), u = side.n.dot(v), through = u - side.speed;
  const double change_u = side.n.dot(Vec2(beyond[1], beyond[2]) - v), change_a = sound(beyond, gamma) - a;
  // Changes against the state inside, so that two equal states stay equal to the bit.
  const double plus = through + a > 0 ? 0 : change_u + per_a * change_a;
  const double minus = through - a > 0 ? 0 : change_u - per_a * change_a;
  const bool leaves = through > 0;
  const StateVector& source = leaves ? inside : beyond;
  const double of_waves = a + (plus - minus) / (2 * per_a), a_side = std::max(of_waves, least_sound * a);
  const Vec2 v_source(source[1], source[2]);
  const Vec2 v_side = v_source + (u + 0.5 * (plus + minus) - side.n.dot(v_source)) * side.n;
  const double ratio = a_side / sound(source, gamma);  // at the entropy of the source
  const double rho = source[0] * std::pow(ratio, per_a);
  return {.q = {rho, v_side[0], v_side[1], source[3] * std::pow(ratio, gamma * per_a)},
          .bounded = of_waves < least_sound * a};
}

}  // namespace fsi::fluid
