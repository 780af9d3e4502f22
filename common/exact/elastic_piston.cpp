#include "common/exact/elastic_piston.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "common/exact/root.hpp"

namespace fsi::exact {

namespace {

/// Above this drop of the sound speed (part of a_0) the power series of the impulse needs too many terms.
constexpr double largest_drop_of_series = 0.5;

/// Eight Gauss-Legendre nodes on [-1, 1], the positive half, and their weights.
constexpr std::array<double, 4> gauss_nodes{0.18343464249564980, 0.52553240991632899, 0.79666647741362674,
                                            0.96028985649753623};
constexpr std::array<double, 4> gauss_weights{0.36268378337836198, 0.31370664587788729, 0.22238103445337447,
                                              0.10122853629037626};

template <class Function>
double integral(Function f, double from, double to, double widest) {
  constexpr double most_panels = 1000;  // and wider ones, rather than to be at it for ever
  const int panels = static_cast<int>(std::clamp(std::ceil((to - from) / widest), 1.0, most_panels));
  const double half = 0.5 * (to - from) / panels;
  double sum = 0;
  for (int k = 0; k < panels; ++k) {
    const double middle = from + (2 * k + 1) * half;
    for (std::size_t m = 0; m < gauss_nodes.size(); ++m) {
      const double distance = half * gauss_nodes[m];
      sum += gauss_weights[m] * half * (f(middle - distance) + f(middle + distance));
    }
  }
  return sum;
}

/// Coefficients c_n / (3 n + 1), n = 1, 2, ..., of the integral of (1 + z)^k - 1 over tau with z proportional
/// to tau^3. A whole exponent (k = 7 for gamma = 1.4) ends the series by itself.
std::vector<double> impulse_series(double k) {
  std::vector<double> coefficients;
  double binomial = 1;
  for (int n = 1; n <= 64; ++n) {
    binomial *= (k - n + 1) / n;
    if (std::fabs(binomial) < 1e-14) break;
    coefficients.push_back(binomial / (3 * n + 1));
  }
  return coefficients;
}

}  // namespace

ElasticPiston::ElasticPiston(const ElasticPistonData& data)
    : data_(data), cos_(std::cos(data.rotation)), sin_(std::sin(data.rotation)) {
  if (!(data.density_ratio > 0)) throw std::invalid_argument("density_ratio must be positive");
  if (!(data.c_p > 0)) throw std::invalid_argument("c_p must be positive");
  if (!(data.gamma > 1)) throw std::invalid_argument("gamma must be greater than 1");
  series_ = impulse_series(2 * data.gamma / (data.gamma - 1));
  const double drop_rate = 0.5 * (data.gamma - 1) * std::fabs(data.amplitude) / data.a_0;
  const bool ends = series_.size() < 64;
  series_end_ = ends || drop_rate == 0 ? std::numeric_limits<double>::infinity()
                                       : std::cbrt(largest_drop_of_series / drop_rate);
}

double ElasticPiston::path(double t) const {
  return t > 0 ? -0.25 * data_.amplitude * t * t * t * t : 0;
}

double ElasticPiston::path_velocity(double t) const {
  return t > 0 ? -data_.amplitude * t * t * t : 0;
}

double ElasticPiston::path_acceleration(double t) const {
  return t > 0 ? -3 * data_.amplitude * t * t : 0;
}

double ElasticPiston::sound_speed(double tau) const {
  return data_.a_0 + 0.5 * (data_.gamma - 1) * path_velocity(tau);
}

double ElasticPiston::p_I(double t) const {
  return p_e() * std::pow(sound_speed(t) / data_.a_0, 2 * data_.gamma / (data_.gamma - 1));
}

/// Time tau at which the state found at (x, t) left the interface, along the axis of the piston.
double ElasticPiston::departure(double x, double t) const {
  if (x >= data_.a_0 * t) return 0;
  const auto distance = [&](double tau) {
    const double speed = path_velocity(tau) + sound_speed(tau);
    return std::pair{path(tau) + speed * (t - tau) - x,
                     0.5 * (data_.gamma + 1) * path_acceleration(tau) * (t - tau) - sound_speed(tau)};
  };
  double late = std::max(t, 0.0);
  // on the interface itself the distance is round-off and must still move the bracket
  const double least = 8 * std::numeric_limits<double>::epsilon() * late;
  for (int k = 0; distance(late).first > 0 && k < 32; ++k)
    late += std::max(2 * distance(late).first / data_.a_0, least);
  return root_between(distance, 0, late, t - (x - path(t)) / sound_speed(t));
}

GasState ElasticPiston::gas(double x, double y, double t) const {
  const double tau = departure(cos_ * x + sin_ * y, t);
  const double v = path_velocity(tau);
  const double a = sound_speed(tau);
  const double rho = data_.rho_0 * std::pow(a / data_.a_0, 2 / (data_.gamma - 1));
  return {.rho = rho, .v1 = v * cos_, .v2 = v * sin_, .p = rho * a * a / data_.gamma};
}

/// Integral of p_I - p_e from 0 to t.
double ElasticPiston::impulse(double t) const {
  if (!(sound_speed(t) > 0))
    return std::numeric_limits<double>::quiet_NaN();  // the gas cannot follow any more
  const double until = std::min(t, series_end_);
  const double z = 0.5 * (data_.gamma - 1) * path_velocity(until) / data_.a_0;
  double sum = 0;
  for (std::size_t n = series_.size(); n-- > 0;) sum = (sum + series_[n]) * z;
  double result = p_e() * until * sum;
  if (t > until) {
    constexpr double part = 0.02;  // of the time in which the speed of sound falls to a half
    result += integral([this](double tau) { return p_I(tau) - p_e(); }, until, t, part * until);
  }
  return result;
}

SolidState ElasticPiston::solid(double x_bar, double y_bar, double t) const {
  const double x = cos_ * x_bar + sin_ * y_bar;
  const double c_p = this->c_p();
  const double stiffness = rho_bar() * c_p * c_p;  // lambda + 2 mu
  const double left = std::max(
      0.0, t - x / c_p);  // when the wave that moves on to the right will be, or was, at the interface
  const double right = std::max(0.0, t + x / c_p);  // the same for the wave that moves to the left
  const double f_slope = -0.5 * (path_velocity(left) / c_p + (p_I(left) - p_e()) / stiffness);
  const double g_slope = 0.5 * (path_velocity(right) / c_p - (p_I(right) - p_e()) / stiffness);
  const double u =
      0.5 * (path(left) + path(right)) + 0.5 * c_p / stiffness * (impulse(left) - impulse(right));

  const double normal = stiffness * (f_slope + g_slope);
  const double across = normal / 3;  // lambda / (lambda + 2 mu) = 1/3
  const Vec2 axis(cos_, sin_);
  const Mat2 along = axis * axis.transpose();
  return {.u = u * axis,
          .v = c_p * (g_slope - f_slope) * axis,
          .P = normal * along + across * (Mat2::Identity() - along)};
}

}  // namespace fsi::exact
