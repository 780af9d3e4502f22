#pragma once
/// The gas's side of an interface with its whole wave curve: the pressure that answers any velocity of the
/// wall, not only a small change of it.
///
///     p - p_0 |            /   shock: the wall moves into the gas
///             |          /
///             |       _/
///     --------+----.-'-------- u = v_n - n.v_f          tangent at u = 0: w_n + z_f v_n = const, paper
///     eq. (19)
///           .-'|
///      ____/   |   rarefaction, down to vacuum at u = -2 a / (gamma - 1)
///
/// Numbers only: density, impedance and the exponent gamma, with P = rho a^2 / gamma the pressure above that
/// of vacuum. An ideal gas has P = p, a stiffened one p + p_inf.

#include <cmath>

#include "common/interface/riemann.hpp"

namespace fsi {

/// Curve through a state at rest: change of pressure [pressure] against the velocity u [velocity] at which a
/// wall moves into the gas.
struct WaveCurve {
  double z = 0;      ///< impedance rho a [pressure/velocity]
  double rho = 0;    ///< density; 0: not known [mass/volume]
  double gamma = 0;  ///< exponent of its simple waves [-]; 0: none, the curve is its tangent

  /// A wall that leaves the gas so fast that the speed of sound at it would fall below this part of the
  /// gas's own has a vacuum beside it: the pressure falls no further.
  static constexpr double least_sound = 0.1;  ///< [-]

  double sound() const { return rho == 0 ? 0 : z / rho; }

  struct Point {
    double dp = 0;  ///< change of pressure [pressure]
    /// Its derivative by u, positive: the impedance against further changes [pressure/velocity]
    double slope = 0;
    bool vacuum = false;
  };

  /// Shock: Rankine-Hugoniot, dp^2 = rho u^2 (gamma P + (gamma + 1)/2 dp). Rarefaction: the Riemann
  /// invariant, 1 + (gamma - 1)/2 u/a being the ratio of the speeds of sound. Both have the slope z and the
  /// same curvature at u = 0.
  Point at(double u) const {
    if (gamma == 0) return {.dp = z * u, .slope = z};
    if (u > 0) {
      const double m = 0.25 * (gamma + 1) * rho * u, root = std::sqrt(m * m + z * z);
      return {.dp = u * (m + root), .slope = (m + root) * (m + root) / root};
    }
    const double a = sound(), P = z * a / gamma, change = 0.5 * (gamma - 1) * u / a;
    const bool vacuum = change < least_sound - 1;
    const double ratio = std::log1p(vacuum ? least_sound - 1 : change);
    return {.dp = P * std::expm1(2 * gamma / (gamma - 1) * ratio),
            .slope = z * std::exp((gamma + 1) / (gamma - 1) * ratio),
            .vacuum = vacuum};
  }
};

/// What a vacuum leaves of the pressure of a gas at a wall [-].
inline double least_pressure_ratio(double gamma) {
  return std::pow(WaveCurve::least_sound, 2 * gamma / (gamma - 1));
}

/// Of an ideal gas through the wave that changes its pressure so many times [-]: behind a shock by Rankine and Hugoniot,
/// else at constant entropy.
inline double density_ratio(double gamma, double pressure_ratio) {
  const double k = (gamma - 1) / (gamma + 1);
  if (pressure_ratio > 1) return (pressure_ratio + k) / (k * pressure_ratio + 1);
  return std::pow(pressure_ratio, 1 / gamma);
}

/// The gas at one interface point.
struct GasSide {
  NormalSide state;  ///< predicted, with z_f
  WaveCurve curve;

  /// The same as one characteristic that touches the curve where the wall moves with v_n.
  NormalSide tangent(double v_n) const {
    const WaveCurve::Point point = curve.at(v_n - state.v_n);
    return {.z = point.slope, .v_n = v_n, .w_n = state.w_n - point.dp};
  }
};

/// The state of the gas at a wall that moves with the normal velocity `v_n`.
inline NormalState at_wall(double v_n, const GasSide& gas) {
  return {.v_n = v_n, .w_n = gas.state.w_n - gas.curve.at(v_n - gas.state.v_n).dp};
}

/// The state between a solid's characteristic and the wave curve of the gas. Differs from the paper: (28) and
/// (29) take the tangent of the curve, which is the same up to the square of the jump.
///
/// Newton's iteration from the state of (28): the curve is convex and rises, so it converges from anywhere.
/// Works on the correction of the solid's velocity, so that two equal sides stay equal to the last bit.
inline NormalState between(const NormalSide& solid, const GasSide& gas) {
  const NormalState linear = between(solid, gas.state);
  if (gas.curve.gamma == 0) return linear;
  constexpr double round_off = 1e-15;  ///< [-]
  constexpr int most = 100;
  const double scale = gas.curve.sound() + std::fabs(solid.v_n);
  double correction = linear.v_n - solid.v_n;
  for (int k = 0; k < most; ++k) {
    const NormalSide here = gas.tangent(solid.v_n + correction);
    const double change = (here.w_n - solid.w_n - solid.z * correction) / (here.z + solid.z);
    correction += change;
    if (std::fabs(change) <= round_off * scale) break;
  }
  return at_wall(solid.v_n + correction, gas);
}

/// Projected normal velocity and traction of one interface point, with the wave curve of the gas. `n` is the
/// unit normal from the solid to the gas.
template <int D>
NormalState project(const SolidPoint<D>& solid, const GasSide& gas, const Vector<D>& n, Projection how) {
  if (how == Projection::traditional) return {.v_n = n.dot(solid.v), .w_n = gas.state.w_n};
  return between(how == Projection::full ? normal_side(solid, n) : simplified_side(solid, n), gas);
}

}  // namespace fsi
