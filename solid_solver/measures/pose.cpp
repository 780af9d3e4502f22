#include "solid_solver/measures/pose.hpp"

#include <cmath>

namespace fsi::solid {

namespace {

/// Sums over the pieces of a body, each weighted by its area. Positions are taken from the first point, so
/// that bodies far from the origin lose no digits.
struct Sums {
  double area = 0;
  Vec2 x = Vec2::Zero(), u = Vec2::Zero(), v = Vec2::Zero();
  double x_cross_u = 0, x_dot_u = 0, x_dot_x = 0;

  void add(double dA, const Vec2& at, const Vec2& its_u, const Vec2& its_v) {
    area += dA;
    x += dA * at;
    u += dA * its_u;
    v += dA * its_v;
    x_cross_u += dA * (at[0] * its_u[1] - at[1] * its_u[0]);
    x_dot_u += dA * at.dot(its_u);
    x_dot_x += dA * at.squaredNorm();
  }
};

/// Over cells, each represented by its middle.
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
      sums.add(dA, {middle(x, 0, i) - o1, middle(x, 1, i) - o2}, {middle(q, 0, i), middle(q, 1, i)},
               {middle(q, 2, i), middle(q, 3, i)});
    }
  }
  return sums;
}

/// Over points.
void add_points(const PosePart& part, const Vec2& origin, Sums& sums) {
  const ConstFieldView x = part.reference, q = part.state;
  for (int j = 0; j < x.layout.n2; ++j) {
    for (const auto& [begin, end] : part.points->row(j)) {
      for (int i = begin; i < end; ++i) {
        sums.add(part.areas(0, i, j), Vec2(x(0, i, j), x(1, i, j)) - origin, {q(0, i, j), q(1, i, j)},
                 {q(2, i, j), q(3, i, j)});
      }
    }
  }
}

Vec2 first_point(ConstFieldView x) {
  return {x(0, 0, 0), x(1, 0, 0)};
}

Pose pose_from(const Sums& sums, const Vec2& origin) {
  const Vec2 x = sums.x / sums.area, u = sums.u / sums.area;
  // Least squares over rotations: the angle of (sum dA a x b, sum dA a . b) with a, b the positions about the
  // centres before and after, b = a + u - mean u.
  const double sine = sums.x_cross_u - (x[0] * sums.u[1] - x[1] * sums.u[0]);
  const double cosine = sums.x_dot_x - x.dot(sums.x) + sums.x_dot_u - x.dot(sums.u);
  return {.centre = origin + x + u, .velocity = sums.v / sums.area, .angle = std::atan2(sine, cosine)};
}

}  // namespace

Pose pose_of(ConstFieldView reference, ConstFieldView state) {
  return pose_from(sums_of(reference, state), first_point(reference));
}

Pose pose_of(std::span<const PosePart> parts) {
  const Vec2 origin = first_point(parts.front().reference);
  Sums sums;
  for (const PosePart& part : parts) add_points(part, origin, sums);
  return pose_from(sums, origin);
}

}  // namespace fsi::solid
