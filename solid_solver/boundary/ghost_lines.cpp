#include "solid_solver/boundary/ghost_lines.hpp"

#include <type_traits>

namespace fsi::solid {

SideIndex::SideIndex(const Layout& layout, Side side) {
  const bool upper = at_upper_end(side);
  if (direction_of(side) == 0) {
    origin = layout.at(upper ? layout.n1 - 1 : 0, 0);
    along = layout.stride;
    inward = upper ? -1 : 1;
    n = layout.n2;
    lines = layout.n1;
  } else {
    origin = layout.at(0, upper ? layout.n2 - 1 : 0);
    along = 1;
    inward = upper ? -layout.stride : layout.stride;
    n = layout.n1;
    lines = layout.n2;
  }
}

Side neighbour(Side side, bool last) {
  if (direction_of(side) == 0) return last ? Side::top : Side::bottom;
  return last ? Side::right : Side::left;
}

GridPoint grid_point(const Layout& layout, Side side, int k) {
  switch (side) {
    case Side::left:
      return {0, k};
    case Side::right:
      return {layout.n1 - 1, k};
    case Side::bottom:
      return {k, 0};
    case Side::top:
      return {k, layout.n2 - 1};
  }
  return {};
}

SideMetrics side_metrics(const ReferenceMetrics& metrics, const Layout& layout, Side side, int k) {
  const GridPoint p = grid_point(layout, side, k);
  const PointMetrics m = metrics.at(p.i, p.j);
  SideMetrics s;
  s.across = direction_of(side) == 0 ? m.r1 : m.r2;
  s.along = direction_of(side) == 0 ? m.r2 : m.r1;
  s.sign = at_upper_end(side) ? 1.0 : -1.0;
  s.n0 = s.sign * s.across / s.across.norm();
  s.t0 = {-s.n0.y(), s.n0.x()};
  s.spacing = m.jacobian * s.across.norm();
  return s;
}

namespace {

/// `along`: how far apart the points of the side lie, where the compiler is to know.
template <class Along>
void extrapolate_line(double* ghost, std::ptrdiff_t inward, Along along, int n, Limiter limiter) {
#pragma omp simd
  for (int k = 0; k < n; ++k) {
    double* to = ghost + k * along;
    *to = extrapolated(to[inward], to[2 * inward], to[3 * inward], to[4 * inward], limiter);
  }
}

}  // namespace

void extrapolate(FieldView q, const SideIndex& side, const GhostRange& range, Limiter limiter) {
  for (int p = range.first_plane; p <= range.last_plane; ++p) {
    double* ghost = q.plane(p) + side.at(range.begin, range.m);
    const int n = range.end - range.begin;
    if (side.along == 1) {
      extrapolate_line(ghost, side.inward, std::integral_constant<std::ptrdiff_t, 1>(), n, limiter);
    } else {
      extrapolate_line(ghost, side.inward, side.along, n, limiter);
    }
  }
}

SolidState reflected(const SolidState& s, const Vec2& n) {
  const Mat2 R = Mat2::Identity() - 2.0 * n * n.transpose();
  const Mat2 P = R * (Mat2() << s.P.a11, s.P.a12, s.P.a21, s.P.a22).finished() * R;
  return {.u = R * s.u, .v = R * s.v, .P = {P(0, 0), P(0, 1), P(1, 0), P(1, 1)}};
}

SolidState sum_of(const SolidState& a, double weight, const SolidState& b) {
  return {.u = a.u + weight * b.u,
          .v = a.v + weight * b.v,
          .P = {a.P.a11 + weight * b.P.a11, a.P.a12 + weight * b.P.a12, a.P.a21 + weight * b.P.a21,
                a.P.a22 + weight * b.P.a22}};
}

void reflect(FieldView q, const SideIndex& side, const GhostRange& range, const Vec2& n) {
  for (int k = range.begin; k < range.end; ++k)
    store(q, side.at(k, range.m), reflected(load(q, side.at(k, -range.m)), n));
}

void copy_period(FieldView q, const SideIndex& side, const GhostRange& range) {
  for (int p = range.first_plane; p <= range.last_plane; ++p) {
    double* values = q.plane(p);
    for (int k = range.begin; k < range.end; ++k) {
      values[side.at(k, range.m)] = values[side.at(k, side.lines - 1 + range.m)];
    }
  }
}

}  // namespace fsi::solid
