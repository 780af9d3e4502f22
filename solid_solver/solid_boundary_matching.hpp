#pragma once
/// SolidBoundary, second half: tractions, and ghost points that make stress and displacement fit together.

#include "solid_solver/solid_boundary.hpp"

namespace fsi::solid {

template <Law L>
void SolidBoundary<L>::apply(FieldView q, double t, std::span<const InterfaceValues> projected) {
  set_motion(q, t, projected);
  fill_line(q, t, {.first_plane = plane::u1, .last_plane = plane::v2, .m = -1});
  fill_line(q, t, {.first_plane = plane::u1, .last_plane = plane::u2, .m = -2});
  set_tractions(q, t, projected);
  fill_line(q, t, {.first_plane = plane::v1, .last_plane = plane::P22, .m = -1});
  // A loaded side takes the difference along it at a slip wall from the ghost point below the wall.
  for (const Side side : all_sides) {
    if (kind(side) == Kind::slip) match_side(q, side, t);
  }
  for (const Side side : all_sides) {
    if (loaded(side)) match_side(q, side, t);
  }
  match_corners(q, t);
  for (const Side side : all_sides) extend_stress_to_corners(q, side, t);
  fill_line(q, t, {.first_plane = plane::P11, .last_plane = plane::P22, .m = -1});
  fill_line(q, t, {.m = -2});
  fill_frame(q, t);
}

template <Law L>
void SolidBoundary<L>::set_tractions(FieldView q, double t, std::span<const InterfaceValues> projected) {
  for (const Side side : all_sides) {
    if (loaded(side)) find_traction(q, side, t);
  }
  for (const InterfaceValues& values : projected) {
    if (values.grid == grid_.index) find_projected_traction(q, t, values);
  }
  for (const Side side : all_sides) {
    if (kind(side) == Kind::traction || kind(side) == Kind::displacement || kind(side) == Kind::slip) {
      follow_characteristics(q, side, t);
    }
  }
  for (const Side side : all_sides) {
    if (loaded(side) || kind(side) == Kind::slip || kind(side) == Kind::symmetry)
      set_normal_stress(q, side, t);
  }
  set_corner_stress(q, t);
  for (const Side side : all_sides) {
    if (kind(side) == Kind::dirichlet) set_exact(q, side, t, 0);
  }
}

/// Nominal traction T = tau / eta of a side with given traction tau per unit current area, paper eq. (42),
/// and its rate; eta = |dx_bar/ds| / |dx/ds| is Nanson's factor, paper eq. (13). An interface keeps its
/// present T until projected values come.
template <Law L>
void SolidBoundary<L>::find_traction(ConstFieldView q, Side side, double t) {
  const SideIndex line(layout(), side);
  const VectorFunction& tau = boundaries_[index(side)].vector;
  const double delta = 1e-3 * time_scale_;
  for (const int k : points(side)) {
    Vec2 &T = T_[index(side)][static_cast<std::size_t>(k)],
         &rate = T_rate_[index(side)][static_cast<std::size_t>(k)];
    const std::ptrdiff_t a = line.at(k, 0);
    T = rate = Vec2::Zero();
    if (kind(side) == Kind::interface) T = traction_of(load(q, a).P, at(side, k).n0);
    if (kind(side) == Kind::interface || !tau) continue;
    const Vec2 x = position(a), along = difference_along(grid_.x, line, 0, k);
    const Vec2 stretched = along + difference_along(q, line, plane::u1, k);
    const double per_reference_area = stretch_along(q, side, k);
    const double its_rate = follows(side) ? stretched.dot(difference_along(q, line, plane::v1, k)) /
                                                (stretched.norm() * along.norm())
                                          : 0.0;
    const Vec2 now = tau(x.x(), x.y(), t);
    const Vec2 now_rate = (tau(x.x(), x.y(), t + delta) - tau(x.x(), x.y(), t - delta)) / (2.0 * delta);
    T = now * per_reference_area;
    rate = now_rate * per_reference_area + now * its_rate;
  }
}

/// |dx/ds| / |dx_bar/ds| = 1 / eta at point k of a side, 1 for tractions per reference area. At the corner
/// with a side of given displacement or slip it is extrapolated along the side: one-sided differences of u
/// are only of first order there.
template <Law L>
double SolidBoundary<L>::stretch_along(ConstFieldView q, Side side, int k) const {
  if (!follows(side)) return 1.0;
  const SideIndex line(layout(), side);
  const auto stretch = [&](int at_k) {
    const Vec2 along = difference_along(grid_.x, line, 0, at_k);
    return (along + difference_along(q, line, plane::u1, at_k)).norm() / along.norm();
  };
  const Kind other = kind(neighbour(side, k != 0));
  if (!end_of(line, k) || (other != Kind::displacement && other != Kind::slip)) return stretch(k);
  const int step = k == 0 ? 1 : -1;
  return extrapolated(stretch(k + step), stretch(k + 2 * step), stretch(k + 3 * step), limiter_);
}

/// T = (w_n / eta) n, or w_n n0 for loads on the reference configuration; besides the chosen traction.
template <Law L>
void SolidBoundary<L>::find_projected_traction(ConstFieldView q, double t, const InterfaceValues& values) {
  const SideIndex line(layout(), values.side);
  const auto n = static_cast<std::size_t>(line.n);
  for (std::size_t k = 0; k < n; ++k) {
    const double eta = 1.0 / stretch_along(q, values.side, static_cast<int>(k));
    const Vec2 normal =
        follows(values.side) ? Vec2(values.n[k], values.n[n + k]) : at(values.side, static_cast<int>(k)).n0;
    const int point = static_cast<int>(k);
    T_[index(values.side)][k] =
        values.w_n[k] / eta * normal + traction_of(chosen(line.at(point, 0), t).P, at(values.side, point).n0);
  }
}

/// The predicted traction w0 and velocity v0 of a side become w and v along the outgoing characteristics,
/// w - Z v = w0 - Z v0, the vector form of paper eq. (18): given v changes w, given w changes v.
/// Differs from the paper, which overwrites the given half only: the other half then keeps a mode that
/// nothing damps, and corners of sides with given displacement are unstable. The change is of the size of the
/// truncation error.
template <Law L>
void SolidBoundary<L>::follow_characteristics(FieldView q, Side side, double t) const {
  const SideIndex line(layout(), side);
  for (const int k : points(side)) {
    if (!inner(side, k)) continue;
    const std::ptrdiff_t a = line.at(k, 0);
    const SideMetrics m = at(side, k);
    SolidState s = load(q, a);
    const Stiffness K = law_.K(plus(identity, gradient(q, side, k, plane::u1)));
    const Mat2 Z = matrix(impedance_matrix(K, m.n0, rho_, 1.0));
    if (!Z.allFinite()) continue;
    const Vec2 w = traction_of(s.P, m.n0), dv = v_change_[index(side)][static_cast<std::size_t>(k)];
    if (kind(side) == Kind::traction) {
      Vec2 change = Z.inverse() * (T_[index(side)][static_cast<std::size_t>(k)] - w);
      if (end_of(line, k) && kind(neighbour(side, k != 0)) == Kind::slip) {
        const Vec2 wall = side_normal_at_end(side, k);
        change -= wall * wall.dot(change);
      }
      s.v += change;
    } else if (kind(side) == Kind::displacement) {
      s.P = plus_dyad(s.P, m.n0, Z * dv);
    } else {
      const Vec2 shear = w - traction_of(chosen(a, t).P, m.n0);
      const Vec2 slide = -m.t0 * (m.t0.dot(shear + Z * dv) / m.t0.dot(Z * m.t0));
      s.v += slide;
      s.P = plus_dyad(s.P, m.n0, Z * (dv + slide));
    }
    store(q, a, s);
  }
}

/// Normal of the neighbour at the end k of a side.
template <Law L>
Vec2 SolidBoundary<L>::side_normal_at_end(Side side, int k) const {
  const Side other = neighbour(side, k != 0);
  return at(other, at_upper_end(side) ? SideIndex(layout(), other).n - 1 : 0).n0;
}

/// n0^T P := T on loaded sides, no shear on slip and symmetry sides; the rest of P stays.
template <Law L>
void SolidBoundary<L>::set_normal_stress(FieldView q, Side side, double t) const {
  const SideIndex line(layout(), side);
  for (const int k : points(side)) {
    const std::ptrdiff_t a = line.at(k, 0);
    const SideMetrics m = at(side, k);
    SolidState s = load(q, a);
    Vec2 change = T_[index(side)][static_cast<std::size_t>(k)] - traction_of(s.P, m.n0);
    const Tensor2 exact = chosen(a, t).P;
    if (!loaded(side)) change = -m.t0 * m.t0.dot(traction_of(minus(s.P, exact), m.n0));
    s.P = plus(s.P,
               {m.n0.x() * change.x(), m.n0.x() * change.y(), m.n0.y() * change.x(), m.n0.y() * change.y()});
    if (kind(side) == Kind::symmetry) {
      const double shear = m.n0.dot(traction_of(minus(s.P, exact), m.t0));
      s.P = plus(s.P, {-shear * m.t0.x() * m.n0.x(), -shear * m.t0.x() * m.n0.y(),
                       -shear * m.t0.y() * m.n0.x(), -shear * m.t0.y() * m.n0.y()});
    }
    store(q, a, s);
  }
}

/// Two loaded sides: both tractions hold. Two sides with given displacement: P(F).
template <Law L>
void SolidBoundary<L>::set_corner_stress(FieldView q, double t) const {
  for (const Side side : {Side::left, Side::right}) {
    const SideIndex line(layout(), side);
    for (const int k : {0, line.n - 1}) {
      if (!advanced(side, k)) continue;
      const Side other = neighbour(side, k != 0);
      const int k_other = at_upper_end(side) ? SideIndex(layout(), other).n - 1 : 0;
      const std::ptrdiff_t a = line.at(k, 0);
      SolidState s = load(q, a);
      if (loaded(side) && loaded(other)) {
        s.P = stress_of_tractions(at(side, k).n0, T_[index(side)][static_cast<std::size_t>(k)],
                                  at(other, k_other).n0, T_[index(other)][static_cast<std::size_t>(k_other)]);
      } else if (kind(side) == Kind::displacement && kind(other) == Kind::displacement) {
        s.P = plus(law_.P(plus(identity, gradient(q, side, k, plane::u1))), chosen_offset(a, t));
      }
      store(q, a, s);
    }
  }
}

/// At a corner of a loaded side with a side of given displacement or slip, and of a slip side with one of
/// given displacement: P by extrapolation along the loaded or slip side, where it is P(F) or free to evolve;
/// a given traction still holds, and so does slip. Differences of u are only of first order there.
template <Law L>
void SolidBoundary<L>::extend_stress_to_corners(FieldView q, Side side, double t) const {
  const SideIndex line(layout(), side);
  for (const int k : {0, line.n - 1}) {
    if (!advanced(side, k)) continue;
    const Kind other = kind(neighbour(side, k != 0));
    const bool to_slip = loaded(side) && other == Kind::slip;
    const bool to_displacement = (loaded(side) || kind(side) == Kind::slip) && other == Kind::displacement;
    if (!to_slip && !to_displacement) continue;
    const int step = k == 0 ? 1 : -1;
    for (int p = plane::P11; p <= plane::P22; ++p) {
      double* P = q.plane(p);
      P[line.at(k, 0)] = extrapolated(P[line.at(k + step, 0)], P[line.at(k + 2 * step, 0)],
                                      P[line.at(k + 3 * step, 0)], limiter_);
    }
    if (!loaded(side)) continue;
    SolidState s = load(q, line.at(k, 0));
    const Vec2 n0 = at(side, k).n0;
    const Vec2 T = T_[index(side)][static_cast<std::size_t>(k)];
    if (to_slip) {
      const Vec2 wall = side_normal_at_end(side, k);
      const Vec2 exact = traction_of(chosen(line.at(k, 0), t).P, wall);
      const double pressing = wall.dot(traction_of(s.P, wall) - exact);
      s.P = stress_of_tractions(n0, T, wall, exact + pressing * wall);
    } else {
      s.P = plus_dyad(s.P, n0, T - traction_of(s.P, n0));
    }
    store(q, line.at(k, 0), s);
  }
}

/// Derivatives of u or v (first = plane::u1, plane::v1) at a boundary point from its four neighbours.
template <Law L>
Tensor2 SolidBoundary<L>::gradient(ConstFieldView q, Side side, int k, int first) const {
  const SideIndex line(layout(), side);
  const SideMetrics m = at(side, k);
  const Tensor2 along = plus_dyad({}, difference_along(q, line, first, k), m.along);
  return plus_dyad(along, difference_across(q, line, first, k, m.sign), m.across);
}

template <Law L>
void SolidBoundary<L>::match_side(FieldView q, Side side, double t) const {
  const SideIndex line(layout(), side);
  for (const int k : points(side)) {
    const bool slip_at_load = kind(side) == Kind::slip && end_of(line, k) && loaded(neighbour(side, k != 0));
    if (!inner(side, k) && !slip_at_load) continue;
    if (loaded(side)) {
      match_point(q, side, k, t);
    } else {
      match_slip_point(q, side, k, t);
    }
  }
}

template <Law L>
void SolidBoundary<L>::match_point(FieldView q, Side side, int k, double t) const {
  const SideIndex line(layout(), side);
  const SideMetrics m = at(side, k);
  SolidState s = load(q, line.at(k, 0));
  const BoundaryStrain strain = {.F = plus_dyad(identity, difference_along(q, line, plane::u1, k), m.along),
                                 .across = m.across,
                                 .n0 = m.n0,
                                 .sign = m.sign};
  const std::ptrdiff_t a = line.at(k, 0);
  const Tensor2 offset = chosen_offset(a, t);
  const auto du = match_traction(law_, strain, traction_of(minus(s.P, offset), m.n0),
                                 difference_across(q, line, plane::u1, k, m.sign));
  if (!du) broke(side, k, t);
  set_ghost(q, line, k, plane::u1, 2.0 * m.sign * *du);
  if (kind(side) == Kind::traction) {
    const Tensor2 along = plus_dyad({}, difference_along(q, line, plane::v1, k), m.along);
    const Vec2 rate =
        T_rate_[index(side)][static_cast<std::size_t>(k)] - traction_of(chosen_source(a, t), m.n0);
    const Vec2 dv = match_traction_rate(law_, strain, *du, along, rate);
    set_ghost(q, line, k, plane::v1, 2.0 * m.sign * dv);
  }
  const Tensor2 F = with_sharper_tangent(q, side, k, plus_dyad(strain.F, *du, m.across));
  const Tensor2 P = plus(law_.P(F), offset);
  const Vec2 change = traction_of(P, m.t0) - traction_of(s.P, m.t0);
  s.P = plus_dyad(s.P, m.t0, change);
  store(q, line.at(k, 0), s);
}

/// F with its stretch along a closed or mirrored interface from fourth-order differences, of the reference
/// positions and of u alike, so that a turned body is not stretched. Central ones of second order, which stay
/// on other sides, make the largest error of P. One-sided differences would make free corners unstable, and a
/// lower order only beside them would cost the rate.
template <Law L>
Tensor2 SolidBoundary<L>::with_sharper_tangent(ConstFieldView q, Side side, int k, const Tensor2& F) const {
  const SideIndex line(layout(), side);
  if (kind(side) != Kind::interface || !imaged(side, 0) || !imaged(side, line.n - 1)) return F;
  const auto difference = [&](ConstFieldView field, int first) -> Vec2 {
    const auto value = [&](int at) {
      const std::ptrdiff_t a = line.at(at, 0);
      return Vec2(field.plane(first)[a], field.plane(first + 1)[a]);
    };
    return (8.0 * (value(k + 1) - value(k - 1)) - (value(k + 2) - value(k - 2))) / 12.0;
  };
  const Vec2 along = difference(grid_.x, 0), change = difference(q, plane::u1);
  const Vec2 image = {F.a11 * along.x() + F.a12 * along.y(), F.a21 * along.x() + F.a22 * along.y()};
  return plus_dyad(F, along + change - image, along / along.squaredNorm());
}

/// The shear of P(F) vanishes: ghost u and v are moved along the side, their normal parts stay extrapolated.
template <Law L>
void SolidBoundary<L>::match_slip_point(FieldView q, Side side, int k, double t) const {
  const SideIndex line(layout(), side);
  const SideMetrics m = at(side, k);
  const BoundaryStrain strain = {.F = plus_dyad(identity, difference_along(q, line, plane::u1, k), m.along),
                                 .across = m.across,
                                 .n0 = m.n0,
                                 .sign = m.sign};
  const std::ptrdiff_t a = line.at(k, 0);
  const double shear = m.t0.dot(traction_of(minus(chosen(a, t).P, chosen_offset(a, t)), m.n0));
  const auto du = match_shear(law_, strain, shear, difference_across(q, line, plane::u1, k, m.sign));
  if (!du) broke(side, k, t);
  set_ghost(q, line, k, plane::u1, 2.0 * m.sign * *du);
  const Stiffness K = law_.K(plus_dyad(strain.F, *du, m.across));
  const Tensor2 strain_rate = contract(K, gradient(q, side, k, plane::v1));
  const double rate = m.t0.dot(traction_of(minus(strain_rate, chosen_strain_rate(a, t)), m.n0));
  const double stiffness = m.t0.dot(matrix(acoustic_matrix(K, m.n0)) * m.t0) * m.across.norm() * m.sign;
  const Vec2 dv = difference_across(q, line, plane::v1, k, m.sign) - rate / stiffness * m.t0;
  set_ghost(q, line, k, plane::v1, 2.0 * m.sign * dv);
}

/// Corners of two loaded sides: ghost u, and ghost v where both tractions are given functions.
template <Law L>
void SolidBoundary<L>::match_corners(FieldView q, double t) const {
  for (const Side side : {Side::left, Side::right}) {
    const SideIndex line(layout(), side);
    for (const int k : {0, line.n - 1}) {
      if (!advanced(side, k)) continue;
      const Side other = neighbour(side, k != 0);
      if (!loaded(side) || !loaded(other)) continue;
      const SideIndex other_line(layout(), other);
      const int k_other = at_upper_end(side) ? other_line.n - 1 : 0;
      const SideMetrics m = at(side, k), m_other = at(other, k_other);
      const std::ptrdiff_t a = line.at(k, 0);
      const Tensor2 P = minus(load(q, a).P, chosen_offset(a, t));
      const Tensor2 start = gradient(q, side, k, plane::u1);
      const auto F = match_corner(law_, P, plus(identity, start));
      if (!F) broke(side, k, t);
      set_corner_ghosts(q, side, k, plane::u1, minus(*F, identity));
      if (kind(side) != Kind::traction || kind(other) != Kind::traction) continue;
      const Stiffness K = law_.K(*F);
      const Tensor2 velocity = gradient(q, side, k, plane::v1);
      const Tensor2 rate =
          minus(stress_of_tractions(m.n0, T_rate_[index(side)][static_cast<std::size_t>(k)], m_other.n0,
                                    T_rate_[index(other)][static_cast<std::size_t>(k_other)]),
                chosen_source(a, t));
      set_corner_ghosts(q, side, k, plane::v1,
                        plus(velocity, least_change(K, minus(rate, contract(K, velocity)))));
    }
  }
}

/// Ghost points on both sides of a corner from the gradient of u or v there.
template <Law L>
void SolidBoundary<L>::set_corner_ghosts(FieldView q, Side side, int k, int first,
                                         const Tensor2& gradient) const {
  const SideIndex line(layout(), side);
  const Side other = neighbour(side, k != 0);
  const SideIndex other_line(layout(), other);
  const int k_other = at_upper_end(side) ? other_line.n - 1 : 0;
  for (const auto& [of, at_k, points] : {std::tuple(side, k, line), std::tuple(other, k_other, other_line)}) {
    const SideMetrics m = at(of, at_k);
    // Dual of grad r: the step in reference space over one index across the side.
    const Vec2 step =
        Vec2(m.along.y(), -m.along.x()) / (m.across.x() * m.along.y() - m.across.y() * m.along.x());
    const Vec2 d = {gradient.a11 * step.x() + gradient.a12 * step.y(),
                    gradient.a21 * step.x() + gradient.a22 * step.y()};
    set_ghost(q, points, at_k, first, 2.0 * m.sign * d);
  }
}

/// First ghost point := first inner point + change.
template <Law L>
void SolidBoundary<L>::set_ghost(FieldView q, const SideIndex& line, int k, int first, const Vec2& change) {
  for (int c = 0; c < 2; ++c)
    q.plane(first + c)[line.at(k, -1)] = q.plane(first + c)[line.at(k, 1)] + change[c];
}

template <Law L>
Vec2 SolidBoundary<L>::difference_across(ConstFieldView q, const SideIndex& line, int first, int k,
                                         double sign) {
  const std::ptrdiff_t ghost = line.at(k, -1), inner = line.at(k, 1);
  return {0.5 * sign * (q.plane(first)[ghost] - q.plane(first)[inner]),
          0.5 * sign * (q.plane(first + 1)[ghost] - q.plane(first + 1)[inner])};
}

template <Law L>
void SolidBoundary<L>::broke(Side side, int k, double t) const {
  const GridPoint p = grid_point(layout(), side, k);
  const Vec2 T = T_[index(side)][static_cast<std::size_t>(k)];
  throw NumbersBroke(
      fmt::format("t = {:.6g}, grid \"{}\", point ({}, {}) on side {}: no displacement of the ghost point "
                  "gives the traction",
                  t, grid_.name, p.i, p.j, name_of(side)));
}

}  // namespace fsi::solid
