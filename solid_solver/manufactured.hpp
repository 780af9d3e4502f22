#pragma once
/// A solution given by its displacement alone: velocity, stress and the body force that makes it exact follow
/// from the law. Derivatives of the displacement are sixth-order differences of its formula.

#include <cmath>
#include <utility>

#include "solid_solver/options.hpp"

namespace fsi::solid {

template <Law L>
class Manufactured {
 public:
  /// `u` must be smooth on the scale of `step_` also a little outside the body.
  Manufactured(VectorFunction u, const L& law, double rho) : u_(std::move(u)), law_(law), rho_(rho) {}

  Vec2 velocity(double x, double y, double t) const {
    return first([&](double d) { return u_(x, y, t + d); });
  }

  Tensor2 deformation_gradient(double x, double y, double t) const {
    const Vec2 u_x = first([&](double d) { return u_(x + d, y, t); });
    const Vec2 u_y = first([&](double d) { return u_(x, y + d, t); });
    return {1 + u_x[0], u_y[0], u_x[1], 1 + u_y[1]};
  }

  SolidState state(double x, double y, double t) const {
    return {.u = u_(x, y, t), .v = velocity(x, y, t), .P = law_.P(deformation_gradient(x, y, t))};
  }

  /// rho u_tt - div P per unit reference volume, with dP_ji/dx_j = K_jikl d2u_k/dx_j dx_l. paper eq. (2)
  Vec2 body_force(double x, double y, double t) const {
    const Vec2 u_tt = second([&](double d) { return u_(x, y, t + d); });
    const Vec2 u_xx = second([&](double d) { return u_(x + d, y, t); });
    const Vec2 u_yy = second([&](double d) { return u_(x, y + d, t); });
    const Vec2 along = second([&](double d) { return u_(x + d, y + d, t); });
    const Vec2 across = second([&](double d) { return u_(x + d, y - d, t); });
    const Vec2 u_xy = 0.25 * (along - across);
    const Stiffness K = law_.K(deformation_gradient(x, y, t));
    // K_j1kl and K_j2kl summed with the second derivatives; K2111 = K1112, K2212 = K2122, ... by K_ijkl =
    // K_lkji
    const double f1 = K.k1111 * u_xx[0] + 2 * K.k1112 * u_xy[0] + K.k2112 * u_yy[0] + K.k1121 * u_xx[1] +
                      (K.k1122 + K.k2121) * u_xy[1] + K.k2122 * u_yy[1];
    const double f2 = K.k1121 * u_xx[0] + (K.k1122 + K.k2121) * u_xy[0] + K.k2122 * u_yy[0] +
                      K.k1221 * u_xx[1] + 2 * K.k1222 * u_xy[1] + K.k2222 * u_yy[1];
    return rho_ * u_tt - Vec2(f1, f2);
  }

 private:
  static constexpr double step_ = 4e-3;

  template <class Function>
  static Vec2 first(const Function& f) {
    constexpr double h = step_;
    const Vec2 d1 = f(h) - f(-h);
    const Vec2 d2 = f(2 * h) - f(-2 * h);
    const Vec2 d3 = f(3 * h) - f(-3 * h);
    return (45 * d1 - 9 * d2 + d3) / (60 * h);
  }
  template <class Function>
  static Vec2 second(const Function& f) {
    constexpr double h = step_;
    const Vec2 centre = f(0);
    const Vec2 s1 = f(h) + f(-h);
    const Vec2 s2 = f(2 * h) + f(-2 * h);
    const Vec2 s3 = f(3 * h) + f(-3 * h);
    return (270 * s1 - 27 * s2 + 2 * s3 - 490 * centre) / (180 * h * h);
  }

  VectorFunction u_;
  L law_;
  double rho_;
};

}  // namespace fsi::solid
