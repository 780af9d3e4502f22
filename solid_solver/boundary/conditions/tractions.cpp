#include "solid_solver/boundary/conditions/tractions.hpp"

#include "solid_solver/boundary/sides/side_differences.hpp"

namespace fsi::solid {

void Tractions::find(ConstFieldView q, Side side, double t, SideMemory& memory) const {
  const SideIndex& line = sides_.line(side);
  const VectorFunction& tau = sides_.boundary(side).vector;
  const bool projected = sides_.condition(side).meets_gas();
  const double delta = 1e-3 * time_scale_;
  for (const int k : sides_.points(side)) {
    Vec2 &T = memory.T(side, k), &rate = memory.T_rate(side, k);
    const std::ptrdiff_t a = line.at(k, 0);
    T = rate = Vec2::Zero();
    if (projected) T = traction_of(load(q, a).P, sides_.at(side, k).n0);
    if (projected || !tau) continue;
    const Vec2 x = sides_.position(a), along = difference_along(sides_.grid().x, line, 0, k);
    const Vec2 stretched = along + difference_along(q, line, plane::u1, k);
    const double per_reference_area = stretch_along(q, side, k);
    const double its_rate = sides_.follows(side) ? stretched.dot(difference_along(q, line, plane::v1, k)) /
                                                       (stretched.norm() * along.norm())
                                                 : 0.0;
    const Vec2 now = tau(x.x(), x.y(), t);
    const Vec2 later = tau(x.x(), x.y(), t + delta), before = tau(x.x(), x.y(), t - delta);
    Vec2 now_rate = (later - before) / (2.0 * delta);
    if (!now_rate.allFinite()) {  // a formula without values before the start, or after the end
      const double step = later.allFinite() ? delta : -delta;
      const Vec2 next = later.allFinite() ? later : before;
      now_rate = (-3.0 * now + 4.0 * next - tau(x.x(), x.y(), t + 2.0 * step)) / (2.0 * step);
    }
    T = now * per_reference_area;
    rate = now_rate * per_reference_area + now * its_rate;
  }
}

/// |dx/ds| / |dx_bar/ds| = 1 / eta at point k of a side, 1 for tractions per reference area. At the corner
/// with a side of given displacement or slip it is extrapolated along the side: one-sided differences of u
/// are only of first order there.
double Tractions::stretch_along(ConstFieldView q, Side side, int k) const {
  if (!sides_.follows(side)) return 1.0;
  const SideIndex& line = sides_.line(side);
  const auto stretch = [&](int at_k) {
    const Vec2 along = difference_along(sides_.grid().x, line, 0, at_k);
    return (along + difference_along(q, line, plane::u1, at_k)).norm() / along.norm();
  };
  const Condition& beyond = sides_.condition_beyond(side, k);
  if (!sides_.at_end(side, k) || (!beyond.moved() && !beyond.slips())) return stretch(k);
  const int step = k == 0 ? 1 : -1;
  return extrapolated(stretch(k + step), stretch(k + 2 * step), stretch(k + 3 * step), sides_.limiter());
}

void Tractions::find_projected(ConstFieldView q, double t, const InterfaceValues& values,
                               SideMemory& memory) const {
  if (!sides_.present(values.side)) return;
  const SideIndex& line = sides_.line(values.side);
  const auto n = static_cast<std::size_t>(line.n);
  for (std::size_t k = 0; k < n; ++k) {
    const int point = static_cast<int>(k);
    const Vec2 n0 = sides_.at(values.side, point).n0;
    Vec2& T = memory.T(values.side, point);
    const double eta = 1.0 / stretch_along(q, values.side, point);
    const Vec2 normal = sides_.follows(values.side) ? Vec2(values.n[k], values.n[n + k]) : n0;
    if (sides_.at_end(values.side, point) && values.goes_on[point == 0 ? 0 : 1]) {
      T = pressed_at_corner(q, t, values, point);
      continue;
    }
    T = values.w_n[k] / eta * normal + traction_of(chosen_.state(line.at(point, 0), t).P, n0);
  }
}

/// The same where an interface turns round the corner k of a side: w_n acts along the side's own normal.
Vec2 Tractions::pressed_at_corner(ConstFieldView q, double t, const InterfaceValues& values, int k) const {
  const SideIndex& line = sides_.line(values.side);
  const SideMetrics& m = sides_.at(values.side, k);
  const Vec2 along = difference_along(sides_.grid().x, line, 0, k);
  const Vec2 now =
      sides_.follows(values.side) ? Vec2(along + difference_along(q, line, plane::u1, k)) : along;
  const double turn = m.t0.dot(along) > 0 ? 1.0 : -1.0;  // n0 is t0 turned by -90 degrees
  const Vec2 area = turn / along.norm() * Vec2(now.y(), -now.x());
  return values.w_n[static_cast<std::size_t>(k)] * area +
         traction_of(chosen_.state(line.at(k, 0), t).P, m.n0);
}

void Tractions::set_normal_stress(FieldView q, Side side, double t, const SideMemory& memory) const {
  const SideIndex& line = sides_.line(side);
  for (const int k : sides_.points(side)) {
    const std::ptrdiff_t a = line.at(k, 0);
    const SideMetrics& m = sides_.at(side, k);
    SolidState s = load(q, a);
    Vec2 change = memory.T(side, k) - traction_of(s.P, m.n0);
    const Tensor2 exact = chosen_.state(a, t).P;
    if (!sides_.loaded(side)) {
      const bool between_walls = sides_.at_end(side, k) && sides_.condition_beyond(side, k).walled();
      change = between_walls ? Vec2(0, 0) : Vec2(-m.t0 * m.t0.dot(traction_of(minus(s.P, exact), m.n0)));
    }
    s.P = plus(s.P,
               {m.n0.x() * change.x(), m.n0.x() * change.y(), m.n0.y() * change.x(), m.n0.y() * change.y()});
    if (sides_.condition(side).mirrored()) {
      const double shear = m.n0.dot(traction_of(minus(s.P, exact), m.t0));
      s.P = plus(s.P, {-shear * m.t0.x() * m.n0.x(), -shear * m.t0.x() * m.n0.y(),
                       -shear * m.t0.y() * m.n0.x(), -shear * m.t0.y() * m.n0.y()});
    }
    store(q, a, s);
  }
}

void Tractions::take_shear_of_corners(FieldView q, double t) const {
  for (const Side side : {Side::left, Side::right}) {
    for (const int k : {0, sides_.line(side).n - 1}) {
      const bool between_walls = sides_.condition(side).walled() && sides_.condition_beyond(side, k).walled();
      if (!between_walls || !sides_.advanced(side, k)) continue;
      const SidePoint other = sides_.around_corner(side, k);
      const SideMetrics &one = sides_.at(side, k), &two = sides_.at(other.side, other.k);
      const std::ptrdiff_t a = sides_.line(side).at(k, 0);
      SolidState s = load(q, a);
      const Tensor2 rest = minus(s.P, chosen_.state(a, t).P);
      const double shear1 = one.t0.dot(traction_of(rest, one.n0)),
                   shear2 = two.t0.dot(traction_of(rest, two.n0));
      const double shared = one.n0.dot(two.n0) * one.t0.dot(two.t0);  // of either in the other
      s.P = plus_dyad(s.P, one.n0, -(shear1 - 0.5 * shared * shear2) * one.t0);
      s.P = plus_dyad(s.P, two.n0, -(shear2 - 0.5 * shared * shear1) * two.t0);
      store(q, a, s);
    }
  }
}

void Tractions::extend_stress_to_corners(FieldView q, Side side, double t, const SideMemory& memory) const {
  const SideIndex& line = sides_.line(side);
  const bool loaded = sides_.loaded(side);
  for (const int k : {0, line.n - 1}) {
    if (!sides_.advanced(side, k)) continue;
    const Condition& beyond = sides_.condition_beyond(side, k);
    const bool to_slip = loaded && beyond.slips();
    const bool to_displacement = (loaded || sides_.condition(side).slips()) && beyond.moved();
    if (!to_slip && !to_displacement) continue;
    const int step = k == 0 ? 1 : -1;
    for (int p = plane::P11; p <= plane::P22; ++p) {
      double* P = q.plane(p);
      P[line.at(k, 0)] = extrapolated(P[line.at(k + step, 0)], P[line.at(k + 2 * step, 0)],
                                      P[line.at(k + 3 * step, 0)], sides_.limiter());
    }
    if (!loaded) continue;
    SolidState s = load(q, line.at(k, 0));
    const Vec2 n0 = sides_.at(side, k).n0;
    const Vec2& T = memory.T(side, k);
    if (to_slip) {
      const Vec2 wall = sides_.normal_around_corner(side, k);
      const Vec2 exact = traction_of(chosen_.state(line.at(k, 0), t).P, wall);
      const double pressing = wall.dot(traction_of(s.P, wall) - exact);
      s.P = stress_of_tractions(n0, T, wall, exact + pressing * wall);
    } else {
      s.P = plus_dyad(s.P, n0, T - traction_of(s.P, n0));
    }
    store(q, line.at(k, 0), s);
  }
}

}  // namespace fsi::solid
