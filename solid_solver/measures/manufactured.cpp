#include "solid_solver/measures/manufactured.hpp"

#include <cmath>
#include <utility>

#include "solid_solver/boundary/ghost_lines.hpp"
#include "solid_solver/boundary/traction_ghost.hpp"

namespace fsi::solid {

namespace {

/// Steps of the differences, parts of the body and of the time in which a wave crosses it.
constexpr double step_part = 4e-3, delta_part = 1e-5;

SolidState difference(const SolidState& after, const SolidState& before, double d) {
  return sum_of(SolidState{}, 0.5 / d, sum_of(after, -1.0, before));
}

/// Values on a line at -2, -1, 1 and 2 steps from its centre.
struct Stencil {
  Vec2 low2, low1, high1, high2;
};

template <class Function>
Stencil around(const Function& f, double d) {
  return {f(-2 * d), f(-d), f(d), f(2 * d)};
}

Vec2 first(const Stencil& s, double d) {
  return (8 * (s.high1 - s.low1) - (s.high2 - s.low2)) / (12 * d);
}

Vec2 second(const Stencil& s, const Vec2& centre, double d) {
  return (16 * (s.high1 + s.low1) - (s.high2 + s.low2) - 30 * centre) / (12 * d * d);
}

Tensor2 gradient(const Stencil& in_x, const Stencil& in_y, double d) {
  const Vec2 u_x = first(in_x, d), u_y = first(in_y, d);
  return {1 + u_x[0], u_y[0], u_x[1], 1 + u_y[1]};
}

}  // namespace

Manufactured::Manufactured(ChosenFields fields, AnyLaw law, double rho, double size)
    : u_(std::move(fields.u)),
      v_(std::move(fields.v)),
      P_(std::move(fields.P)),
      law_(std::move(law)),
      rho_(rho),
      size_(size),
      time_(size * std::sqrt(rho / (law_.lambda + 2 * law_.mu))) {}

Vec2 Manufactured::velocity(double x, double y, double t) const {
  if (v_) return v_(x, y, t);
  const double d = step_part * time_;
  return first(around([&](double s) { return u_(x, y, t + s); }, d), d);
}

Tensor2 Manufactured::deformation_gradient(double x, double y, double t) const {
  const double d = step_part * size_;
  return gradient(around([&](double s) { return u_(x + s, y, t); }, d),
                  around([&](double s) { return u_(x, y + s, t); }, d), d);
}

Tensor2 Manufactured::stress(double x, double y, double t) const {
  return P_ ? P_(x, y, t) : law_.P(deformation_gradient(x, y, t));
}

SolidState Manufactured::state(double x, double y, double t) const {
  return {.u = u_(x, y, t), .v = velocity(x, y, t), .P = stress(x, y, t)};
}

SolidState Manufactured::source(double x, double y, double t) const {
  const double d = delta_part * size_, dt = delta_part * time_;
  const SolidState in_t = difference(state(x, y, t + dt), state(x, y, t - dt), dt);
  const SolidState in_x = difference(state(x + d, y, t), state(x - d, y, t), d);
  const SolidState in_y = difference(state(x, y + d, t), state(x, y - d, t), d);
  const Vec2 div(in_x.P.a11 + in_y.P.a21, in_x.P.a12 + in_y.P.a22);
  const Tensor2 rate =
      contract(law_.K(deformation_gradient(x, y, t)), {in_x.v.x(), in_y.v.x(), in_x.v.y(), in_y.v.y()});
  SolidState source = in_t;
  source.u -= velocity(x, y, t);
  source.v -= div / rho_;
  source.P = minus(source.P, rate);
  return source;
}

Tensor2 Manufactured::offset(double x, double y, double t) const {
  return P_ ? minus(P_(x, y, t), law_.P(deformation_gradient(x, y, t))) : Tensor2{};
}

Vec2 Manufactured::body_force(double x, double y, double t) const {
  const Vec2 centre = u_(x, y, t);
  const double d = step_part * size_, dt = step_part * time_;
  const Stencil in_x = around([&](double s) { return u_(x + s, y, t); }, d),
                in_y = around([&](double s) { return u_(x, y + s, t); }, d);
  const Stencil diagonal = around([&](double s) { return u_(x + s, y + s, t); }, d);
  const Stencil in_t = around([&](double s) { return u_(x, y, t + s); }, dt);
  const Vec2 u_tt = second(in_t, centre, dt), u_xx = second(in_x, centre, d), u_yy = second(in_y, centre, d);
  const Vec2 u_xy = 0.5 * (second(diagonal, centre, d) - u_xx - u_yy);
  const Stiffness K = law_.K(gradient(in_x, in_y, d));
  // K_j1kl and K_j2kl summed with the second derivatives;
  // K2111 = K1112, K2212 = K2122, ... by K_ijkl = K_lkji
  const double f1 = K.k1111 * u_xx[0] + 2 * K.k1112 * u_xy[0] + K.k2112 * u_yy[0] + K.k1121 * u_xx[1] +
                    (K.k1122 + K.k2121) * u_xy[1] + K.k2122 * u_yy[1];
  const double f2 = K.k1121 * u_xx[0] + (K.k1122 + K.k2121) * u_xy[0] + K.k2122 * u_yy[0] +
                    K.k1221 * u_xx[1] + 2 * K.k1222 * u_xy[1] + K.k2222 * u_yy[1];
  return rho_ * u_tt - Vec2(f1, f2);
}

}  // namespace fsi::solid
