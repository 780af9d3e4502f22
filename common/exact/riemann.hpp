#pragma once
/// Exact solution of the Riemann problem of the Euler equations (after Toro, Riemann Solvers and Numerical
/// Methods for Fluid Dynamics, ch. 4): two constant gas states side by side at t = 0, then for all time a
/// left wave, a contact and a right wave, each wave a shock or a rarefaction.
///
///        left wave   contact   right wave
///             \         |       /
///      left    \  p,v   | p,v  /    right
///               \ star  | star/
///   -------------\------|----/---------------> x

#include "common/exact/solution.hpp"

namespace fsi::exact {

/// One-dimensional state beside the initial jump.
struct TubeState {
  double rho = 1, v = 0, p = 1;  ///< [mass/volume], [velocity], [pressure]
};

class Riemann {
 public:
  /// @throws std::invalid_argument when the two states move apart so fast that a vacuum opens
  Riemann(const TubeState& left, const TubeState& right, double gamma);

  double p_star() const { return p_star_; }
  double v_star() const { return v_star_; }
  /// State on the ray x / t = speed.
  TubeState sample(double speed) const;

 private:
  TubeState left_, right_;
  double gamma_;                    ///< [-]
  double p_star_ = 0, v_star_ = 0;  ///< [pressure], [velocity]

  TubeState sample_side(const TubeState& outer, double speed, double direction) const;
};

/// The tube problem as a solution: the jump stands at x =
/// x_0 at t = 0; the same for every y. It knows no solid.
class RiemannTube final : public Solution {
 public:
  RiemannTube(const Riemann& riemann, const TubeState& left, const TubeState& right, double x_0)
      : riemann_(riemann), left_(left), right_(right), x_0_(x_0) {}
  GasState gas(double x, double y, double t) const override;
  SolidState solid(double x_bar, double y_bar, double t) const override;

 private:
  Riemann riemann_;
  TubeState left_, right_;
  double x_0_;  ///< [length]
};

}  // namespace fsi::exact
