#include "solid_solver/measures/pose.hpp"

#include <cmath>

namespace fsi::solid {

void PoseSums::add(const PoseSums& row) {
  area += row.area;
  x += row.x;
  u += row.u;
  v += row.v;
  x_cross_u += row.x_cross_u;
  x_dot_u += row.x_dot_u;
  x_dot_x += row.x_dot_x;
}

void PoseSums::write(std::vector<double>& to) const {
  to.insert(to.end(), {area, x[0], x[1], u[0], u[1], v[0], v[1], x_cross_u, x_dot_u, x_dot_x});
}

PoseSums PoseSums::read(std::span<const double> from) {
  return {.area = from[0],
          .x = {from[1], from[2]},
          .u = {from[3], from[4]},
          .v = {from[5], from[6]},
          .x_cross_u = from[7],
          .x_dot_u = from[8],
          .x_dot_x = from[9]};
}

PoseSums pose_sums(ConstFieldView x, ConstFieldView q, int j) {
  const double o1 = x(0, 0, 0), o2 = x(1, 0, 0);
  PoseSums sums;
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
  return sums;
}

PoseSums pose_sums(const PosePart& part, const Vec2& origin, int j) {
  const ConstFieldView x = part.reference, q = part.state;
  PoseSums sums;
  for (const auto& [begin, end] : part.points->row(j)) {
    for (int i = begin; i < end; ++i) {
      sums.add(part.areas(0, i, j), Vec2(x(0, i, j), x(1, i, j)) - origin, {q(0, i, j), q(1, i, j)},
               {q(2, i, j), q(3, i, j)});
    }
  }
  return sums;
}

Vec2 origin_of_sums(ConstFieldView x) {
  return {x(0, 0, 0), x(1, 0, 0)};
}

Pose pose_from(const PoseSums& sums, const Vec2& origin) {
  const Vec2 x = sums.x / sums.area, u = sums.u / sums.area;
  // Least squares over rotations: the angle of (sum dA a x b, sum dA a . b) with a, b the positions about the
  // centres before and after, b = a + u - mean u.
  const double sine = sums.x_cross_u - (x[0] * sums.u[1] - x[1] * sums.u[0]);
  const double cosine = sums.x_dot_x - x.dot(sums.x) + sums.x_dot_u - x.dot(sums.u);
  return {.centre = origin + x + u, .velocity = sums.v / sums.area, .angle = std::atan2(sine, cosine)};
}

Pose pose_of(ConstFieldView reference, ConstFieldView state) {
  PoseSums sums;
  for (int j = 0; j + 1 < reference.layout.n2; ++j) sums.add(pose_sums(reference, state, j));
  return pose_from(sums, origin_of_sums(reference));
}

Pose pose_of(std::span<const PosePart> parts) {
  const Vec2 origin = origin_of_sums(parts.front().reference);
  PoseSums sums;
  for (const PosePart& part : parts) {
    for (int j = 0; j < part.reference.layout.n2; ++j) sums.add(pose_sums(part, origin, j));
  }
  return pose_from(sums, origin);
}

}  // namespace fsi::solid
