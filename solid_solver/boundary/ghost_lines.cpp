#include "solid_solver/boundary/ghost_lines.hpp"

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

void extrapolate(FieldView q, const SideIndex& side, const GhostRange& range, Limiter limiter) {
  for (int p = range.first_plane; p <= range.last_plane; ++p) {
    double* values = q.plane(p);
    for (int k = range.begin; k < range.end; ++k) {
      values[side.at(k, range.m)] =
          extrapolated(values[side.at(k, range.m + 1)], values[side.at(k, range.m + 2)],
                       values[side.at(k, range.m + 3)], limiter);
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

SolidState load(ConstFieldView q, std::ptrdiff_t at) {
  return {.u = {q.plane(plane::u1)[at], q.plane(plane::u2)[at]},
          .v = {q.plane(plane::v1)[at], q.plane(plane::v2)[at]},
          .P = {q.plane(plane::P11)[at], q.plane(plane::P12)[at], q.plane(plane::P21)[at],
                q.plane(plane::P22)[at]}};
}

void store(FieldView q, std::ptrdiff_t at, const SolidState& state) {
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
