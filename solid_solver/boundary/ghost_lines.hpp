#pragma once
/// Points of a side and of its ghost lines, and ways to fill ghost points that know nothing of the law.

#include <cmath>
#include <cstddef>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "solid_solver/kernels/reference_metrics.hpp"
#include "solid_solver/kernels/state.hpp"
#include "solid_solver/options.hpp"

namespace fsi::solid {

/// Addresses of the points of a side: k along it, m lines inward (m = -1, -2: ghost lines).
struct SideIndex {
  std::ptrdiff_t origin = 0, along = 0, inward = 0;
  int n = 0;      ///< points along the side
  int lines = 0;  ///< points across the grid

  SideIndex(const Layout& layout, Side side);
  std::ptrdiff_t at(int k, int m) const { return origin + k * along + m * inward; }
};

/// The side met at end k = 0 or k = n - 1 of a side.
Side neighbour(Side side, bool last);
/// Grid point k of a side.
struct GridPoint {
  int i = 0, j = 0;
};
GridPoint grid_point(const Layout& layout, Side side, int k);

/// Geometry of a boundary point.
struct SideMetrics {
  Vec2 n0;         ///< outward unit normal of the reference body
  Vec2 t0;         ///< unit tangent, n0 turned by +90 degrees
  Vec2 across;     ///< grad of the index that counts across the side
  Vec2 along;      ///< grad of the index along the side
  double sign;     ///< +1 when the index across the side grows outward [-]
  double spacing;  ///< |d x_bar| per index along the side [length]
};
SideMetrics side_metrics(const ReferenceMetrics& metrics, const Layout& layout, Side side, int k);

/// How far two differences agree [-]: 1 where they have one sign and one is at most three times the other, 0 where they have
/// different signs or one alone is zero.
inline double agreement(double a, double b) {
  const double apart = std::abs(a - b), both = std::abs(a) + std::abs(b);
  const double beyond = 2.0 * (apart / both - 0.5), weight = 1.0 - (beyond < 1.0 ? beyond : 1.0);
  return apart <= 0.5 * both ? 1.0 : weight;
}

/// Value beyond q0 from q0 .. q3 inward: third order; exact for constants to the last bit. With a limiter it turns into a constant
/// where neither the first differences agree nor the second ones, as beside a jump within a cell. A parabola has its ghost points also where its
/// top lies near the side: a body of four cells that is bent has one across it.
inline double extrapolated(double q0, double q1, double q2, double q3, Limiter limiter) {
  const double third_order = q2 + 3.0 * (q0 - q1);
  const double a = q0 - q1, b = q1 - q2, c = q2 - q3;
  const double by_slope = agreement(a, b), by_curvature = agreement(a - b, b - c);
  const double weight = by_slope > by_curvature ? by_slope : by_curvature;
  const double limited = q0 + weight * (third_order - q0);
  return ((limiter == Limiter::none) | (weight == 1.0)) ? third_order : limited;
}

/// The same from three values, where a fourth is not as good as these.
inline double extrapolated(double q0, double q1, double q2, Limiter limiter) {
  return extrapolated(q0, q1, q2, q2 - (q1 - q2), limiter);
}

/// Planes first .. last of ghost line m < 0 by extrapolation from the four lines inside it, points k = begin
/// .. end - 1.
struct GhostRange {
  int first_plane = 0, last_plane = plane::count - 1;
  int m = -1;
  int begin = 0, end = 0;
};
void extrapolate(FieldView q, const SideIndex& side, const GhostRange& range, Limiter limiter);
/// Vectors and stress reflected at the plane with unit normal n.
SolidState reflected(const SolidState& state, const Vec2& n);
/// Mirror images: vectors and stress reflected at the plane with unit normal n.
void reflect(FieldView q, const SideIndex& side, const GhostRange& range, const Vec2& n);
/// Values of the opposite side, whose boundary line is the same line.
void copy_period(FieldView q, const SideIndex& side, const GhostRange& range);

/// The state at an address.
inline SolidState load(ConstFieldView q, std::ptrdiff_t at) {
  return {.u = {q.plane(plane::u1)[at], q.plane(plane::u2)[at]},
          .v = {q.plane(plane::v1)[at], q.plane(plane::v2)[at]},
          .P = {q.plane(plane::P11)[at], q.plane(plane::P12)[at], q.plane(plane::P21)[at],
                q.plane(plane::P22)[at]}};
}
/// a + weight * b.
SolidState sum_of(const SolidState& a, double weight, const SolidState& b);
inline void store(FieldView q, std::ptrdiff_t at, const SolidState& state) {
  q.plane(plane::u1)[at] = state.u.x();
  q.plane(plane::u2)[at] = state.u.y();
  q.plane(plane::v1)[at] = state.v.x();
  q.plane(plane::v2)[at] = state.v.y();
  q.plane(plane::P11)[at] = state.P.a11;
  q.plane(plane::P12)[at] = state.P.a12;
  q.plane(plane::P21)[at] = state.P.a21;
  q.plane(plane::P22)[at] = state.P.a22;
}

}  // namespace fsi::solid
