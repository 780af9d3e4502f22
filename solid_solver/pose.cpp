#include "solid_solver/pose.hpp"

#include <cmath>

namespace fsi::solid {

namespace {

/// Sums over the cells of a component grid, each weighted by its area and represented by its middle.
template <class Function>
void for_each_cell(ConstFieldView x, ConstFieldView q, const Function& visit) {
  for (int j = 0; j + 1 < x.layout.n2; ++j) {
    for (int i = 0; i + 1 < x.layout.n1; ++i) {
      const auto middle = [i, j](ConstFieldView f, int c) {
        return 0.25 * (f(c, i, j) + f(c, i + 1, j) + f(c, i, j + 1) + f(c, i + 1, j + 1));
      };
      const double a1 = x(0, i + 1, j + 1) - x(0, i, j), a2 = x(1, i + 1, j + 1) - x(1, i, j);
      const double b1 = x(0, i, j + 1) - x(0, i + 1, j), b2 = x(1, i, j + 1) - x(1, i + 1, j);
      visit(0.5 * (a1 * b2 - a2 * b1), Vec2(middle(x, 0), middle(x, 1)), Vec2(middle(q, 0), middle(q, 1)),
            Vec2(middle(q, 2), middle(q, 3)));
    }
  }
}

}  // namespace

Pose pose_of(ConstFieldView reference, ConstFieldView state) {
  double area = 0;
  Vec2 centre_bar = Vec2::Zero(), shift = Vec2::Zero(), velocity = Vec2::Zero();
  for_each_cell(reference, state, [&](double dA, const Vec2& x, const Vec2& u, const Vec2& v) {
    area += dA;
    centre_bar += dA * x;
    shift += dA * u;
    velocity += dA * v;
  });
  centre_bar /= area;
  shift /= area;
  velocity /= area;
  // Least squares over rotations: the angle of sum dA (x_bar x x, x_bar . x) about the centres.
  double sine = 0, cosine = 0;
  for_each_cell(reference, state, [&](double dA, const Vec2& x, const Vec2& u, const Vec2& /*v*/) {
    const Vec2 a = x - centre_bar;
    const Vec2 b = a + u - shift;
    sine += dA * (a[0] * b[1] - a[1] * b[0]);
    cosine += dA * a.dot(b);
  });
  return {.centre = centre_bar + shift, .velocity = velocity, .angle = std::atan2(sine, cosine)};
}

}  // namespace fsi::solid
