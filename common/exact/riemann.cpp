#include "common/exact/riemann.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/exact/root.hpp"

namespace fsi::exact {

namespace {

double sound_speed(const TubeState& state, double gamma) {
  return std::sqrt(gamma * state.p / state.rho);
}

/// Change of velocity through the wave that takes the pressure of `outer` to p, and its derivative by p: the
/// Hugoniot relation for a shock, the Riemann invariant for a rarefaction.
std::pair<double, double> velocity_change(double p, const TubeState& outer, double gamma) {
  const double a = sound_speed(outer, gamma);
  if (p > outer.p) {
    const double A = 2 / ((gamma + 1) * outer.rho);
    const double B = (gamma - 1) / (gamma + 1) * outer.p;
    const double root = std::sqrt(A / (p + B));
    return {(p - outer.p) * root, root * (1 - 0.5 * (p - outer.p) / (p + B))};
  }
  const double ratio = p / outer.p;
  const double exponent = 0.5 * (gamma - 1) / gamma;
  return {2 * a / (gamma - 1) * (std::pow(ratio, exponent) - 1),
          std::pow(ratio, exponent - 1) / (outer.rho * a)};
}

}  // namespace

Riemann::Riemann(const TubeState& left, const TubeState& right, double gamma)
    : left_(left), right_(right), gamma_(gamma) {
  const double a_sum = sound_speed(left, gamma) + sound_speed(right, gamma);
  if (!(2 / (gamma - 1) * a_sum > right.v - left.v)) {
    throw std::invalid_argument("the two states of the Riemann problem leave a vacuum between them");
  }
  const auto mismatch = [&](double p) {
    const auto [left_change, left_slope] = velocity_change(p, left_, gamma_);
    const auto [right_change, right_slope] = velocity_change(p, right_, gamma_);
    return std::pair{left_change + right_change + right_.v - left_.v, left_slope + right_slope};
  };
  double high = std::max(left.p, right.p);
  while (mismatch(high).first < 0) high *= 2;
  double low = std::min(left.p, right.p);
  while (mismatch(low).first > 0) low *= 0.5;
  p_star_ = low == high ? low : root_between(mismatch, low, high, 0.5 * (left.p + right.p));
  v_star_ = 0.5 * (left.v + right.v) + 0.5 * (velocity_change(p_star_, right, gamma).first -
                                              velocity_change(p_star_, left, gamma).first);
}

/// State on the ray `speed` on one side of the contact; direction is -1 on the left, +1 on the right.
TubeState Riemann::sample_side(const TubeState& outer, double speed, double direction) const {
  const double a = sound_speed(outer, gamma_);
  const double relative = direction * (speed - outer.v);  // seen from the outer gas, outward
  const double ratio = p_star_ / outer.p;
  if (ratio > 1) {
    const double k = (gamma_ - 1) / (gamma_ + 1);
    const double shock = a * std::sqrt(0.5 / gamma_ * ((gamma_ + 1) * ratio + gamma_ - 1));
    if (relative >= shock) return outer;
    return {.rho = outer.rho * (ratio + k) / (k * ratio + 1), .v = v_star_, .p = p_star_};
  }
  const double a_star = a * std::pow(ratio, 0.5 * (gamma_ - 1) / gamma_);
  if (relative >= a) return outer;
  double v = v_star_;
  double a_here = a_star;
  if (direction * (speed - v_star_) > a_star) {  // inside the fan
    a_here = 2 / (gamma_ + 1) * (a + 0.5 * (gamma_ - 1) * relative);
    v = speed - direction * a_here;
  }
  const double rho = outer.rho * std::pow(a_here / a, 2 / (gamma_ - 1));
  return {.rho = rho, .v = v, .p = rho * a_here * a_here / gamma_};
}

TubeState Riemann::sample(double speed) const {
  return speed < v_star_ ? sample_side(left_, speed, -1) : sample_side(right_, speed, 1);
}

GasState RiemannTube::gas(double x, double /*y*/, double t) const {
  const double distance = x - x_0_;
  const TubeState state = t > 0 ? riemann_.sample(distance / t) : (distance < 0 ? left_ : right_);
  return {.rho = state.rho, .v1 = state.v, .v2 = 0, .p = state.p};
}

SolidState RiemannTube::solid(double /*x_bar*/, double /*y_bar*/, double /*t*/) const {
  throw std::logic_error("the shock tube has no solid");
}

}  // namespace fsi::exact
