#pragma once
/// Sound that meets a wall between two gases, in the linear limit: a piston that deforms, or a wall of which
/// only the mass counts (G. I. Taylor's plate). Or the far face of the wall is clamped, and there is one gas.
///
///      gas, z_1  ->      |   wall    |    -> gas, z_2
///      R  <-   -> P      0           d          T ->
///
/// The pulse P comes from the left, p = P(t - x/a_1) + R(t + x/a_1), and leaves to the right as T. A wall that
/// deforms carries v = f(t - x/c) + g(t + x/c) with the stress z_s (g - f): continuity of v and p at both
/// faces gives
///
///     f(t) = 2 P(t) / (z_s + z_1) + r_1 r_2 f(t - 2 d/c),   g(t + d/c) = r_2 f(t - d/c),
///     r_k = (z_s - z_k) / (z_s + z_k)
///
/// and a wall of mass m per area moves by m v' = 2 P - (z_1 + z_2) v. A clamped face does not move, f + g = 0 there:
/// it is a gas that does not give way, r_2 = -1, the limit of z_2 without end. The pulse is
/// P = size p w(s), w = (4 s (1 - s))^4 for 0 < s < 1, s = (a_1 t - distance) / length.

#include <optional>

#include "common/exact/solution.hpp"

namespace fsi::exact {

struct WallBetweenGasesData {
  double gamma_left = 1.4, gamma_right = 1.4;  ///< ratios of specific heats [-]
  double rho_left = 1, rho_right = 1;          ///< densities at rest [mass/volume]
  double p = 1;                                ///< pressure at rest, of both gases [force/area]
  double thickness = 1;                        ///< d [length]
  std::optional<double> mass;                  ///< m of a wall that does not deform [mass/area]
  double rho_bar = 1,
         c_p = 1;  ///< density and p-wave speed of a wall that does; lambda = mu [mass/volume], [velocity]
  bool clamped = false;   ///< the right face does not move, and has no gas
  double size = 1e-6;     ///< largest pressure of the pulse over p [-]
  double distance = 0.1;  ///< of its front from the wall at t = 0 [length]
  double length = 0.6;    ///< of the pulse at t = 0 [length]
};

class WallBetweenGases final : public Solution {
 public:
  /// @throws std::invalid_argument for data without a solution
  explicit WallBetweenGases(const WallBetweenGasesData& data);

  /// The gas to the left of the wall's middle, or that to the right of it; both also a little beyond the face.
  /// Where the right face is clamped, there is the left one alone.
  GasState gas(double x, double y, double t) const override;
  SolidState solid(double x_bar, double y_bar, double t) const override;

  /// Velocity of the left and of the right face.
  double left_face(double t) const;
  double right_face(double t) const;
  /// Pressure of the pulse, over the pressure at rest, where it meets the left face.
  double pulse(double t) const;
  double z_left() const;
  double z_right() const;

 private:
  WallBetweenGasesData data_;
  double a_left_, a_right_;  ///< [velocity]

  double reflected_left() const;
  double reflected_right() const;
  double place(double t) const;
  double impulse(double t) const;
  template <class Function>
  double sum_of_echoes(double t, double passed, Function f) const;
  double forward(double t) const;
  double forward_way(double t) const;
  double stiff_velocity(double t) const;
  double stiff_way(double t) const;
};

}  // namespace fsi::exact
