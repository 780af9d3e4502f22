#pragma once
/// A smooth motion written down in closed form, its exact
/// stress, and the body force that makes it a solution.

#include <cmath>

#include "solid_solver/kernels/state.hpp"
#include "solid_solver/options.hpp"

namespace fsi::solid::test {

/// Motion u1 = a cos(2x + p) cos(2y + q) cos(wt + 0.2), u2 = a cos(2x + q) sin(1.5y + q) cos(wt + 0.9). With
/// q = 0 the line y = 0 is a slip wall: u2 = 0 and no shear.
template <Law L>
class ManufacturedMotion {
 public:
  /// @param squeeze the body is squeezed uniformly to 1 - squeeze of its lengths besides
  ManufacturedMotion(const L& law, double rho, double q, double squeeze = 0)
      : law_(law), rho_(rho), q_(q), squeeze_(squeeze) {}

  Vec2 u(double x, double y, double t) const { return motion(x, y, t) - squeeze_ * Vec2(x, y); }
  Vec2 v(double x, double y, double t) const {
    return {-w * a * std::cos(2 * x + p) * std::cos(2 * y + q_) * std::sin(w * t + 0.2),
            -w * a * std::cos(2 * x + q_) * std::sin(1.5 * y + q_) * std::sin(w * t + 0.9)};
  }
  Tensor2 F(double x, double y, double t) const { return F(waves_at(x, y), amplitudes(t)); }
  SolidState state(double x, double y, double t) const {
    return {.u = u(x, y, t), .v = v(x, y, t), .P = law_.P(F(x, y, t))};
  }
  /// rho u_tt - dP_ji/dx_j, the divergence by fourth-order differences of the exact stress.
  Vec2 force(double x, double y, double t) const {
    constexpr double h = 2e-3;
    static const Waves one_x = steps(h, 0), two_x = steps(2 * h, 0), one_y = steps(0, h),
                       two_y = steps(0, 2 * h);
    const Waves here = waves_at(x, y);
    const Vec2 c = amplitudes(t);
    const auto P = [&](const Waves& waves) { return law_.P(F(waves, c)); };
    const Tensor2 e = P(here + one_x), o = P(here - one_x), ee = P(here + two_x), oo = P(here - two_x);
    const Tensor2 n = P(here + one_y), s = P(here - one_y), nn = P(here + two_y), ss = P(here - two_y);
    const auto d = [](double p1, double m1, double p2, double m2) {
      return (8 * (p1 - m1) - (p2 - m2)) / (12 * h);
    };
    return -rho_ * w * w * motion(x, y, t) -
           Vec2(d(e.a11, o.a11, ee.a11, oo.a11) + d(n.a21, s.a21, nn.a21, ss.a21),
                d(e.a12, o.a12, ee.a12, oo.a12) + d(n.a22, s.a22, nn.a22, ss.a22));
  }
  /// Traction per unit current area on the normal n0: n0^T P over the stretch of the tangent.
  Vec2 traction(const Vec2& n0, double x, double y, double t) const {
    const Tensor2 f = F(x, y, t), P = law_.P(f);
    const double stretch = std::hypot(f.a12 * n0.x() - f.a11 * n0.y(), f.a22 * n0.x() - f.a21 * n0.y());
    return Vec2(n0.x() * P.a11 + n0.y() * P.a21, n0.x() * P.a12 + n0.y() * P.a22) / stretch;
  }

  static constexpr double a = 0.03, w = 3.0, p = 0.3;

 private:
  /// Cosine and sine of an angle; of sums and differences of angles without any of a further one.
  struct Wave {
    double cos, sin;
    explicit Wave(double angle) : cos(std::cos(angle)), sin(std::sin(angle)) {}
    Wave(double c, double s) : cos(c), sin(s) {}
    Wave operator+(const Wave& d) const { return {cos * d.cos - sin * d.sin, sin * d.cos + cos * d.sin}; }
    Wave operator-(const Wave& d) const { return {cos * d.cos + sin * d.sin, sin * d.cos - cos * d.sin}; }
  };
  /// Of 2x + p, 2x + q, 2y + q and 1.5y + q.
  struct Waves {
    Wave x1, x2, y1, y2;
    Waves operator+(const Waves& d) const { return {x1 + d.x1, x2 + d.x2, y1 + d.y1, y2 + d.y2}; }
    Waves operator-(const Waves& d) const { return {x1 - d.x1, x2 - d.x2, y1 - d.y1, y2 - d.y2}; }
  };
  Waves waves_at(double x, double y) const {
    return {Wave(2 * x + p), Wave(2 * x + q_), Wave(2 * y + q_), Wave(1.5 * y + q_)};
  }
  /// By how much these angles grow over a way.
  static Waves steps(double dx, double dy) {
    return {Wave(2 * dx), Wave(2 * dx), Wave(2 * dy), Wave(1.5 * dy)};
  }
  static Vec2 amplitudes(double t) { return {a * std::cos(w * t + 0.2), a * std::cos(w * t + 0.9)}; }
  Tensor2 F(const Waves& k, const Vec2& c) const {
    const double size = 1 - squeeze_;
    return {size - 2 * c[0] * k.x1.sin * k.y1.cos, -2 * c[0] * k.x1.cos * k.y1.sin,
            -2 * c[1] * k.x2.sin * k.y2.sin, size + 1.5 * c[1] * k.x2.cos * k.y2.cos};
  }
  Vec2 motion(double x, double y, double t) const {
    return {a * std::cos(2 * x + p) * std::cos(2 * y + q_) * std::cos(w * t + 0.2),
            a * std::cos(2 * x + q_) * std::sin(1.5 * y + q_) * std::cos(w * t + 0.9)};
  }

  L law_;
  double rho_, q_, squeeze_;
};

}  // namespace fsi::solid::test
