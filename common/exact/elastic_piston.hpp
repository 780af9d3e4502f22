#pragma once
/// Exact solution of the elastic piston: a linear elastic solid pulled away from a gas.
///
///      solid: d'Alembert waves     |  gas: simple wave  . rest
///   x_bar = -1 ........... 0       |                  .
///                           x = F(t) --> n          x = a t
///
/// The path of the interface is given, F(t) = -A t^4 / 4; everything else follows from it. The gas, at rest
/// before, carries one simple wave: along x = F(tau) + (F'(tau) + a(tau)) (t - tau) the state is that of the
/// interface at tau. The solid carries u = f(x_bar - c_p t) + g(x_bar + c_p t) in uniaxial strain, with f and
/// g such that velocity and traction match those of the gas: initial data and left boundary come from the
/// solution. Exact for every density ratio.

#include <vector>

#include "common/exact/solution.hpp"

namespace fsi::exact {

struct ElasticPistonData {
  double density_ratio = 1;  ///< rho_bar / rho_0 [-]
  double c_p = 1.3;          ///< p-wave speed of the solid, in units of the gas's sound speed at rest [-]
  double amplitude = 0.25;   ///< A of F(t) = -A t^4 / 4 [length/time^4]; positive pulls away from the gas
  double rotation = 0;       ///< of the whole set-up about the origin [rad]
  double gamma = 1.4;        ///< ratio of specific heats [-]
  double rho_0 = 1;          ///< density of the gas at rest [mass/volume]
  double a_0 = 1;            ///< its speed of sound [velocity]
};

/// p_0 = p_e = rho_0 a_0^2 / gamma; the solid has lambda = mu = rho_bar c_p^2 / 3 with its own speed c_p.
class ElasticPiston final : public Solution {
 public:
  /// @throws std::invalid_argument for data without a solution
  explicit ElasticPiston(const ElasticPistonData& data);

  /// Also a little behind the interface (ghost points), where the simple wave continues smoothly.
  GasState gas(double x, double y, double t) const override;
  /// Also a little outside the solid (ghost points), where the waves continue smoothly.
  SolidState solid(double x_bar, double y_bar, double t) const override;

  /// F(t), F'(t), F''(t): distance of the interface from the origin along the axis of the piston.
  double path(double t) const;
  double path_velocity(double t) const;
  double path_acceleration(double t) const;
  /// Gas pressure at the interface, p_0 (1 + (gamma - 1)/2 F'/a_0)^(2 gamma/(gamma - 1)).
  double p_I(double t) const;
  double p_e() const { return data_.rho_0 * (data_.a_0 * data_.a_0) / data_.gamma; }
  double rho_bar() const { return data_.density_ratio * data_.rho_0; }
  /// lambda = mu of the solid.
  double lambda() const { return rho_bar() * c_p() * c_p() / 3; }

 private:
  ElasticPistonData data_;
  double cos_, sin_;            ///< [-]
  double series_end_;           ///< the power series of the impulse is used up to this time [time]
  std::vector<double> series_;  ///< its coefficients, in powers of the drop of the sound speed

  double c_p() const { return data_.c_p * data_.a_0; }
  double sound_speed(double tau) const;
  double departure(double x, double t) const;
  double impulse(double t) const;
};

}  // namespace fsi::exact
