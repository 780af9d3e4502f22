#include "solid_solver/pose.hpp"

#include <cmath>

namespace fsi::solid {

namespace {

/// Sums over the cells of a body, each weighted by its area and represented by its middle. Positions are
/// taken from the first point, so that bodies far from the origin lose no digits.
struct Sums {
  double area = 0;
  Vec2 x = Vec2::Zero(), u = Vec2::Zero(), v = Vec2::Zero();
  double x_cross_u = 0, x_dot_u = 0, x_dot_x = 0;
};

Sums sums_of(ConstFieldView x, ConstFieldView q) {
  const double o1 = x(0, 0, 0), o2 = x(1, 0, 0);
  Sums sums;
  for (int j = 0; j + 1 < x.layout.n2; ++j) {
    const auto middle = [j](ConstFieldView f, int c, int i) {
      const double *low = f.row(c, j), *high = f.row(c, j + 1);
      return 0.25 * ((low[i] + low[i + 1]) + (high[i] + high[i + 1]));
    };
    for (int i = 0; i + 1 < x.layout.n1; ++i) {
      const double a1 = x(0, i + 1, j + 1) - x(0, i, j), a2 = x(1, i + 1, j + 1) - x(1, i, j);
      const double b1 = x(0, i, j + 1) - x(0, i + 1, j), b2 = x(1, i, j + 1) - x(1, i + 1, j);
      const double dA = 0.5 * (a1 * b2 - a2 * b1);
      const Vec2 at(middle(x, 0, i) - o1, middle(x, 1, i) - o2), u(middle(q, 0, i), middle(q, 1, i));
      sums.area += dA;
      sums.x += dA * at;
      sums.u += dA * u;
      sums.v += dA * Vec2(middle(q, 2, i), middle(q, 3, i));
      sums.x_cross_u += dA * (at[0] * u[1] - at[1] * u[0]);
      sums.x_dot_u += dA * at.dot(u);
      sums.x_dot_x += dA * at.squaredNorm();
    }
  }
  return sums;
}

}  // namespace

Pose pose_of(ConstFieldView reference, ConstFieldView state) {
  const Sums sums = sums_of(reference, state);
  const Vec2 x = sums.x / sums.area, u = sums.u / sums.area;
  // Least squares over rotations: the angle of (sum dA a x b, sum dA a . b) with a, b the positions about the
  // centres before and after, b = a + u - mean u.
  const double sine = sums.x_cross_u - (x[0] * sums.u[1] - x[1] * sums.u[0]);
  const double cosine = sums.x_dot_x - x.dot(sums.x) + sums.x_dot_u - x.dot(sums.u);
  return {.centre = Vec2(reference(0, 0, 0), reference(1, 0, 0)) + x + u,
          .velocity = sums.v / sums.area,
          .angle = std::atan2(sine, cosine)};
}

}  // namespace fsi::solid
