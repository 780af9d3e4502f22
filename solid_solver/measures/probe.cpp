#include "solid_solver/measures/probe.hpp"

#include <algorithm>
#include <optional>

#include "solid_solver/kernels/state.hpp"

namespace fsi::solid {

namespace {

double bilinear(ConstFieldView q, int k, const ProbePoint& p) {
  return (1 - p.b) * ((1 - p.a) * q(k, p.i, p.j) + p.a * q(k, p.i + 1, p.j)) +
         p.b * ((1 - p.a) * q(k, p.i, p.j + 1) + p.a * q(k, p.i + 1, p.j + 1));
}

/// Newton's inverse of the bilinear map of one cell; nothing when the point lies outside.
std::optional<ProbePoint> find_in_cell(ConstFieldView x, int i, int j, const Vec2& target) {
  constexpr double rim = 1e-9;
  const Vec2 p00(x(0, i, j), x(1, i, j)), p10(x(0, i + 1, j), x(1, i + 1, j));
  const Vec2 p01(x(0, i, j + 1), x(1, i, j + 1)), p11(x(0, i + 1, j + 1), x(1, i + 1, j + 1));
  const Vec2 low = p00.cwiseMin(p10).cwiseMin(p01).cwiseMin(p11),
             high = p00.cwiseMax(p10).cwiseMax(p01).cwiseMax(p11);
  const double size = (high - low).norm();
  if (((target - low).array() < -rim * size).any() || ((high - target).array() < -rim * size).any())
    return {};
  ProbePoint p = {.i = i, .j = j, .a = 0.5, .b = 0.5};
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Vec2 d1 = (1 - p.b) * (p10 - p00) + p.b * (p11 - p01),
               d2 = (1 - p.a) * (p01 - p00) + p.a * (p11 - p10);
    const Vec2 miss =
        target - (1 - p.b) * ((1 - p.a) * p00 + p.a * p10) - p.b * ((1 - p.a) * p01 + p.a * p11);
    const double area = d1.x() * d2.y() - d1.y() * d2.x();
    p.a += (miss.x() * d2.y() - miss.y() * d2.x()) / area;
    p.b += (d1.x() * miss.y() - d1.y() * miss.x()) / area;
  }
  if (!(p.a >= -rim && p.a <= 1 + rim && p.b >= -rim && p.b <= 1 + rim)) return {};
  p.a = std::clamp(p.a, 0.0, 1.0);
  p.b = std::clamp(p.b, 0.0, 1.0);
  return p;
}

}  // namespace

std::optional<ProbePoint> locate_probe(ConstFieldView reference, const SolidPoints& points, double x,
                                       double y) {
  const auto has_values = [&](int i, int j) {
    return points.is_valid(i, j) && points.is_valid(i + 1, j) && points.is_valid(i, j + 1) &&
           points.is_valid(i + 1, j + 1);
  };
  for (int j = 0; j + 1 < reference.layout.n2; ++j) {
    for (int i = 0; i + 1 < reference.layout.n1; ++i) {
      const auto found = find_in_cell(reference, i, j, {x, y});
      if (found && has_values(i, j)) return found;
    }
  }
  return {};
}

SolidState value_at_probe(ConstFieldView q, const ProbePoint& probe) {
  const auto value = [&](int k) { return bilinear(q, k, probe); };
  return {.u = {value(plane::u1), value(plane::u2)},
          .v = {value(plane::v1), value(plane::v2)},
          .P = {value(plane::P11), value(plane::P12), value(plane::P21), value(plane::P22)}};
}

}  // namespace fsi::solid
