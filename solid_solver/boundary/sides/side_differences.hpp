#pragma once
/// Derivatives at a point of a side from its four neighbours, the ghost point among them, and ghost points from derivatives.
/// Vectors u (first = plane::u1), v (plane::v1), or positions (0).

#include "solid_solver/boundary/sides/sides.hpp"
#include "solid_solver/boundary/traction_ghost.hpp"

namespace fsi::solid {

inline constexpr Tensor2 identity = {1.0, 0.0, 0.0, 1.0};

/// Central differences along the side over one index.
inline Vec2 difference_along(ConstFieldView q, const SideIndex& line, int first, int k) {
  const std::ptrdiff_t next = line.at(k + 1, 0), last = line.at(k - 1, 0);
  return {0.5 * (q.plane(first)[next] - q.plane(first)[last]),
          0.5 * (q.plane(first + 1)[next] - q.plane(first + 1)[last])};
}

/// Across it. @param sign of the metrics there
inline Vec2 difference_across(ConstFieldView q, const SideIndex& line, int first, int k, double sign) {
  const std::ptrdiff_t ghost = line.at(k, -1), inner = line.at(k, 1);
  return {0.5 * sign * (q.plane(first)[ghost] - q.plane(first)[inner]),
          0.5 * sign * (q.plane(first + 1)[ghost] - q.plane(first + 1)[inner])};
}

/// The gradient in the reference configuration.
Tensor2 gradient(const Sides& sides, ConstFieldView q, const SidePoint& p, int first);

/// F without the derivative across the side.
inline BoundaryStrain strain_along(const Sides& sides, ConstFieldView q, const SidePoint& p) {
  const SideMetrics& m = sides.at(p.side, p.k);
  return {.F = plus_dyad(identity, difference_along(q, sides.line(p.side), plane::u1, p.k), m.along),
          .across = m.across,
          .n0 = m.n0,
          .sign = m.sign};
}

/// First ghost point := first inner point + change.
inline void set_ghost(FieldView q, const SideIndex& line, int k, int first, const Vec2& change) {
  for (int c = 0; c < 2; ++c)
    q.plane(first + c)[line.at(k, -1)] = q.plane(first + c)[line.at(k, 1)] + change[c];
}

/// Ghost points on both sides of a corner from the gradient there.
void set_corner_ghosts(const Sides& sides, FieldView q, const SidePoint& corner, int first,
                       const Tensor2& gradient);

/// F with its stretch along a closed or mirrored interface from fourth-order differences, of the reference
/// positions and of u alike, so that a turned body is not stretched. Central ones of second order, which stay
/// on other sides, make the largest error of P. One-sided differences would make free corners unstable, and a
/// lower order only beside them would cost the rate.
Tensor2 with_sharper_tangent(const Sides& sides, ConstFieldView q, const SidePoint& p, const Tensor2& F);

}  // namespace fsi::solid
