#include "common/exact/wall_between_gases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace fsi::exact {

namespace {

/// w(s) = sum of weights[k] s^(4 + k): 4^4 times those of (1 - s)^4.
constexpr std::size_t lowest = 4;
constexpr std::array<double, 5> weights{256, -1024, 1536, -1024, 256};

double shape(double s) {
  return s > 0 && s < 1 ? std::pow(4 * s * (1 - s), 4) : 0;
}

/// Integral of w from 0 to s.
double shape_integral(double s) {
  s = std::clamp(s, 0.0, 1.0);
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const auto power = static_cast<double>(lowest + k + 1);
    sum += weights[k] * std::pow(s, power) / power;
  }
  return sum;
}

/// Answer of a wall with the rate K to the pulse, K times the integral of w(s') exp(-K (s - s')) from 0 to s,
/// for 0 <= s <= 1. Of the moments J_j, those of s'^j, one gives the next, K J_j = s^j - j J_(j-1): upwards
/// where K is large, downwards from a high one, which hardly counts, where it is small.
double delayed_shape(double s, double K) {
  constexpr std::size_t most = 60;
  constexpr double large = 8;
  std::array<double, most + 1> moment{};
  if (K >= large) {
    moment[0] = -std::expm1(-K * s) / K;
    for (std::size_t j = 1; j < lowest + weights.size(); ++j) {
      const auto power = static_cast<double>(j);
      moment[j] = (std::pow(s, power) - power * moment[j - 1]) / K;
    }
  } else {
    for (std::size_t j = most; j > lowest; --j) {
      const auto power = static_cast<double>(j);
      moment[j - 1] = (std::pow(s, power) - K * moment[j]) / power;
    }
  }
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * moment[lowest + k];
  return K * sum;
}

}  // namespace

WallBetweenGases::WallBetweenGases(const WallBetweenGasesData& data)
    : data_(data),
      a_left_(std::sqrt(data.gamma_left * data.p / data.rho_left)),
      a_right_(std::sqrt(data.gamma_right * data.p / data.rho_right)) {
  for (const double number : {data.gamma_left, data.gamma_right, data.rho_left, data.rho_right, data.p,
                              data.thickness, data.rho_bar, data.c_p, data.length}) {
    if (!(number > 0))
      throw std::invalid_argument("densities, speeds, pressure and lengths must be positive");
  }
  if (data.mass && !(*data.mass >= 0)) throw std::invalid_argument("the mass must not be negative");
  if (data.mass && data.clamped) throw std::invalid_argument("a wall that does not deform cannot be clamped");
  if (!(data.distance >= 0)) throw std::invalid_argument("the pulse must begin in front of the wall");
  constexpr double most_echoes = 1e4;
  if (!data.mass && !((data.distance + data.length) / a_left_ <= most_echoes * 2 * data.thickness / data.c_p))
    throw std::invalid_argument(
        "the wall is so thin that more than 1e4 echoes run through it while the pulse arrives; take a "
        "thicker one" +
        std::string(data.clamped ? "" : ", or give its `mass`, as of one that does not deform"));
}

double WallBetweenGases::z_left() const {
  return data_.rho_left * a_left_;
}
double WallBetweenGases::z_right() const {
  return data_.rho_right * a_right_;
}

/// r_1 and r_2
double WallBetweenGases::reflected_left() const {
  const double z_s = data_.rho_bar * data_.c_p;
  return (z_s - z_left()) / (z_s + z_left());
}
double WallBetweenGases::reflected_right() const {
  if (data_.clamped) return -1;
  const double z_s = data_.rho_bar * data_.c_p;
  return (z_s - z_right()) / (z_s + z_right());
}

/// s of the pulse that is at the left face.
double WallBetweenGases::place(double t) const {
  return (a_left_ * t - data_.distance) / data_.length;
}

double WallBetweenGases::pulse(double t) const {
  return data_.size * shape(place(t));
}

/// Time integral of the pressure of the pulse at the left face.
double WallBetweenGases::impulse(double t) const {
  return data_.size * data_.p * data_.length / a_left_ * shape_integral(place(t));
}

/// Sum of kept^k f(t - k returns), k = 0, 1, .. as long as the argument is positive; f is `passed` from the time on at
/// which the pulse is through.
template <class Function>
double WallBetweenGases::sum_of_echoes(double t, double passed, Function f) const {
  const double returns = 2 * data_.thickness / data_.c_p, kept = reflected_left() * reflected_right();
  const double through = (data_.distance + data_.length) / a_left_;
  const double gone = std::max(0.0, std::ceil((t - through) / returns));  // of whole pulses
  double part = std::pow(kept, gone), sum = passed * (kept == 1 ? gone : (1 - part) / (1 - kept));
  for (t = std::min(t - gone * returns, through); t > 0; t -= returns, part *= kept) sum += part * f(t);
  return sum;
}

/// f
double WallBetweenGases::forward(double t) const {
  const double enters = 2 / (data_.rho_bar * data_.c_p + z_left());
  return enters * data_.p * sum_of_echoes(t, 0, [this](double t_k) { return pulse(t_k); });
}

/// Time integral of f.
double WallBetweenGases::forward_way(double t) const {
  const double enters = 2 / (data_.rho_bar * data_.c_p + z_left());
  const double passed = impulse((data_.distance + data_.length) / a_left_);
  return enters * sum_of_echoes(t, passed, [this](double t_k) { return impulse(t_k); });
}

double WallBetweenGases::stiff_velocity(double t) const {
  const double z = z_left() + z_right(), s = place(t), scale = 2 * data_.size * data_.p / z;
  if (!(s > 0)) return 0;
  if (*data_.mass == 0) return scale * shape(s);
  const double K = z / *data_.mass * data_.length / a_left_;
  return scale * delayed_shape(std::min(s, 1.0), K) * std::exp(-K * std::max(0.0, s - 1));
}

/// From m v + z (way) = 2 (impulse of the pulse).
double WallBetweenGases::stiff_way(double t) const {
  return (2 * impulse(t) - *data_.mass * stiff_velocity(t)) / (z_left() + z_right());
}

double WallBetweenGases::left_face(double t) const {
  return data_.mass ? stiff_velocity(t) : solid(0, 0, t).v[0];
}

double WallBetweenGases::right_face(double t) const {
  return data_.mass ? stiff_velocity(t) : solid(data_.thickness, 0, t).v[0];
}

GasState WallBetweenGases::gas(double x, double /*y*/, double t) const {
  if (x > 0.5 * data_.thickness && !data_.clamped) {
    const double v = right_face(t - (x - data_.thickness) / a_right_), p = z_right() * v;
    return {.rho = data_.rho_right + p / (a_right_ * a_right_), .v1 = v, .v2 = 0, .p = data_.p + p};
  }
  const double coming = data_.p * pulse(t - x / a_left_), departed = t + x / a_left_;
  const double leaving = data_.p * pulse(departed) - z_left() * left_face(departed);
  const double p = coming + leaving;
  return {.rho = data_.rho_left + p / (a_left_ * a_left_),
          .v1 = (coming - leaving) / z_left(),
          .v2 = 0,
          .p = data_.p + p};
}

SolidState WallBetweenGases::solid(double x_bar, double /*y_bar*/, double t) const {
  if (data_.mass) return {.u = Vec2(stiff_way(t), 0), .v = Vec2(stiff_velocity(t), 0), .P = Mat2::Zero()};
  const double c = data_.c_p, z_s = data_.rho_bar * c;
  const double there = t - x_bar / c, back = t - (2 * data_.thickness - x_bar) / c;
  const double returned = reflected_right();
  const double f = forward(there), g = returned * forward(back), stress = z_s * (g - f);
  Mat2 P = Mat2::Zero();
  P(0, 0) = stress;
  P(1, 1) = stress / 3;  // lambda = mu
  return {.u = Vec2(forward_way(there) + returned * forward_way(back), 0), .v = Vec2(f + g, 0), .P = P};
}

}  // namespace fsi::exact
