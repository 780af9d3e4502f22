#include "solid_solver/boundary/conditions/given_motion.hpp"

#include <cmath>

namespace fsi::solid {

namespace {

/// Of a side with given motion; at rest without functions.
Motion motion_at(const Boundary& boundary, const Vec2& x, double t) {
  Motion motion{.u = Vec2::Zero(), .v = Vec2::Zero()};
  if (boundary.vector) motion.u = boundary.vector(x.x(), x.y(), t);
  if (boundary.velocity) motion.v = boundary.velocity(x.x(), x.y(), t);
  return motion;
}

}  // namespace

std::optional<Motion> given_motion(const Sides& sides, Side side, int k, double t) {
  if (!sides.at_end(side, k)) return std::nullopt;
  const Condition& beyond = sides.condition_beyond(side, k);
  const Boundary& boundary = sides.boundary(neighbour(side, k != 0));
  const Vec2 x = sides.position(sides.line(side).at(k, 0));
  if (beyond.moved()) return motion_at(boundary, x, t);
  if (!beyond.has_state()) return std::nullopt;
  const SolidState given = boundary.state(x.x(), x.y(), t);
  return Motion{.u = given.u, .v = given.v};
}

std::optional<Vec2> wall_of(const Sides& sides, Side side, int k) {
  if (!sides.at_end(side, k) || !sides.condition_beyond(side, k).walled()) return std::nullopt;
  return sides.normal_around_corner(side, k);
}

void GivenMotion::set(FieldView q, double t, std::span<const InterfaceValues> projected,
                      SideMemory& memory) const {
  for (const InterfaceValues& values : projected) {
    if (values.grid == sides_.grid().index) project_velocity(q, t, values, memory);
  }
  // What each wall takes is found before any has taken its own: at a corner of two, neither comes first.
  for (const Side side : all_sides) {
    if (sides_.condition(side).walled()) find_normal_motion(q, side, t, memory);
  }
  for (const Side side : all_sides) {
    if (sides_.condition(side).walled()) remove_normal_motion(q, side, t);
  }
  for (const Side side : all_sides) {
    if (sides_.condition(side).moved()) move(q, side, t, memory);
    if (sides_.condition(side).repeated() && at_upper_end(side)) {
      const SideIndex& line = sides_.line(side);
      copy_period(q, line, {.m = 0, .begin = 0, .end = line.n});
    }
  }
}

/// v := v + (v_n - n.v) n.
void GivenMotion::project_velocity(FieldView q, double t, const InterfaceValues& values,
                                   SideMemory& memory) const {
  if (!sides_.present(values.side)) return;
  const SideIndex& line = sides_.line(values.side);
  const auto n = static_cast<std::size_t>(line.n);
  for (std::size_t k = 0; k < n; ++k) {
    const auto point = static_cast<int>(k);
    const std::ptrdiff_t a = line.at(point, 0);
    double &v1 = q.plane(plane::v1)[a], &v2 = q.plane(plane::v2)[a];
    const Vec2 exact = chosen_.state(a, t).v;
    const double change =
        values.v_n[k] - (values.n[k] * (v1 - exact.x()) + values.n[n + k] * (v2 - exact.y()));
    v1 += change * values.n[k];
    v2 += change * values.n[n + k];
    memory.v_change(values.side, point) = change * Vec2(values.n[k], values.n[n + k]);
  }
}

void GivenMotion::move(FieldView q, Side side, double t, SideMemory& memory) const {
  const SideIndex& line = sides_.line(side);
  for (const int k : sides_.points(side)) {
    const std::ptrdiff_t a = line.at(k, 0);
    const auto [u, v] = motion_at(sides_.boundary(side), sides_.position(a), t);
    Vec2& change = memory.v_change(side, k);
    for (int c = 0; c < 2; ++c) {
      q.plane(plane::u1 + c)[a] = u[c];
      change[c] = v[c] - q.plane(plane::v1 + c)[a];
      q.plane(plane::v1 + c)[a] = v[c];
    }
  }
}

void GivenMotion::find_normal_motion(ConstFieldView q, Side side, double t, SideMemory& memory) const {
  const SideIndex& line = sides_.line(side);
  for (const int k : sides_.points(side)) {
    const std::ptrdiff_t a = line.at(k, 0);
    const Vec2 n = sides_.at(side, k).n0;
    memory.v_change(side, k) = -n * n.dot(load(q, a).v - chosen_.state(a, t).v);
  }
}

/// n0 . u = n0 . v = 0 for the difference to the chosen solution; where two such sides meet at an angle the
/// corner does not move at all.
void GivenMotion::remove_normal_motion(FieldView q, Side side, double t) const {
  constexpr double parallel = 1e-6;
  const SideIndex& line = sides_.line(side);
  for (const int k : sides_.points(side)) {
    const std::ptrdiff_t a = line.at(k, 0);
    const Vec2 n = sides_.at(side, k).n0;
    const SolidState exact = chosen_.state(a, t);
    SolidState s = sum_of(load(q, a), -1.0, exact);
    s.u -= n * n.dot(s.u);
    s.v -= n * n.dot(s.v);
    if (const std::optional<Vec2> m = wall_of(sides_, side, k)) {
      if (std::abs(n.x() * m->y() - n.y() * m->x()) > parallel) s.u = s.v = Vec2::Zero();
    }
    store(q, a, sum_of(s, 1.0, exact));
  }
}

}  // namespace fsi::solid
