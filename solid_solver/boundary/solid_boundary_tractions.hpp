#pragma once
/// SolidBoundary, second part: the tractions of the sides, given
/// and projected, and what they do to stress and velocity.

#include "solid_solver/boundary/solid_boundary.hpp"

namespace fsi::solid {

template <Law L>
void SolidBoundary<L>::set_tractions(FieldView q, double t, std::span<const InterfaceValues> projected) {
  for (const Side side : all_sides) {
    if (loaded(side)) find_traction(q, side, t);
  }
  for (const InterfaceValues& values : projected) {
    if (values.grid != grid_.index) continue;
    find_projected_traction(q, t, values);
    slide_along_interface(q, values);
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
  set_corner_stress(q);
  for (const Side side : all_sides) {
    if (kind(side) == Kind::dirichlet) set_exact(q, side, t, 0);
  }
}

/// Nominal traction T = tau / eta of a side with given traction tau per unit current area, paper eq. (42),
/// and its rate; eta = |dx_bar/ds| / |dx/ds| is Nanson's factor, paper eq. (13). An interface keeps its
/// present T until projected values come.
template <Law L>
void SolidBoundary<L>::find_traction(ConstFieldView q, Side side, double t) {
  const SideIndex& line = line_of(side);
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
  const SideIndex& line = line_of(side);
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
  if (!present(values.side)) return;
  const SideIndex& line = line_of(values.side);
  const auto n = static_cast<std::size_t>(line.n);
  for (std::size_t k = 0; k < n; ++k) {
    const int point = static_cast<int>(k);
    const double eta = 1.0 / stretch_along(q, values.side, point);
    const Vec2 normal = follows(values.side) ? Vec2(values.n[k], values.n[n + k]) : at(values.side, point).n0;
    if (end_of(line, point) && values.goes_on[point == 0 ? 0 : 1]) {
      T_[index(values.side)][k] = pressed_at_corner(q, t, values, point);
      continue;
    }
    T_[index(values.side)][k] =
        values.w_n[k] / eta * normal + traction_of(chosen(line.at(point, 0), t).P, at(values.side, point).n0);
  }
}

/// The same where an interface turns round the corner k of a side: w_n acts along the side's own normal.
template <Law L>
Vec2 SolidBoundary<L>::pressed_at_corner(ConstFieldView q, double t, const InterfaceValues& values,
                                         int k) const {
  const SideIndex& line = line_of(values.side);
  const SideMetrics& m = at(values.side, k);
  const Vec2 along = difference_along(grid_.x, line, 0, k);
  const Vec2 now = follows(values.side) ? Vec2(along + difference_along(q, line, plane::u1, k)) : along;
  const double turn = m.t0.dot(along) > 0 ? 1.0 : -1.0;  // n0 is t0 turned by -90 degrees
  const Vec2 area = turn / along.norm() * Vec2(now.y(), -now.x());
  return values.w_n[static_cast<std::size_t>(k)] * area + traction_of(chosen(line.at(k, 0), t).P, m.n0);
}

template <Law L>
Stiffness SolidBoundary<L>::stiffness(ConstFieldView q, Side side, int k) const {
  return law_.K(plus(identity, gradient(q, side, k, plane::u1)));
}

/// Z of waves along the reference normal of a side, per unit reference area.
template <Law L>
Mat2 SolidBoundary<L>::impedance(const Stiffness& K, Side side, int k) const {
  return matrix(impedance_matrix(K, normal(side, k), rho_, 1.0));
}

/// The predicted traction w0 and velocity v0 of a side become w and v along the outgoing characteristics,
/// w - Z v = w0 - Z v0, the vector form of paper eq. (18): given v changes w, given w changes v.
/// Differs from the paper, which overwrites the given half only: the other half then keeps a mode that
/// nothing damps, and corners of sides with given displacement are
/// unstable. The change is of the size of the truncation error. Beside given motion all of P changes that the
/// waves carry: a traction that changes alone leaves tangential stress of its own behind, which grows. Slip sides
/// change the traction alone: with the rest, ripples grow where they meet an interface behind a strong shock.
template <Law L>
void SolidBoundary<L>::follow_characteristics(FieldView q, Side side, double t) const {
  const SideIndex& line = line_of(side);
  for (const int k : points(side)) {
    if (!inner(side, k)) continue;
    const std::ptrdiff_t a = line.at(k, 0);
    const SideMetrics& m = at(side, k);
    SolidState s = load(q, a);
    const Stiffness K = stiffness(q, side, k);
    const Mat2 Z = impedance(K, side, k);
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
      s.P = behind_waves(s.P, K, m.n0, Z * dv);
    } else {
      const Vec2 shear = w - traction_of(chosen(a, t).P, m.n0);
      const Vec2 slide = -m.t0 * (m.t0.dot(shear + Z * dv) / m.t0.dot(Z * m.t0));
      s.v += slide;
      s.P = plus_dyad(s.P, m.n0, Z * (dv + slide));
    }
    store(q, a, s);
  }
}

/// What w - Z v = w0 - Z v0 says along the tangent of an interface, whose gas takes no shear: the projection
/// gives n . v, and the shear that the prediction left changes t . v. Differs from the paper, which leaves t
/// . v as predicted; nothing damps it then, and with the relaxation (41) ripples of it grow from round-off.
template <Law L>
void SolidBoundary<L>::slide_along_interface(FieldView q, const InterfaceValues& values) {
  const Side side = values.side;
  const SideIndex& line = line_of(side);
  const SideRows rows = rows_of(side);
  const auto n = static_cast<std::size_t>(line.n);
  if (points(side).empty()) return;
  for (const int k : points(side)) {
    const Tensor2 F = plus(identity, gradient(q, side, k, plane::u1));
    rows.F().set(static_cast<int>(slot(side, k)), F.a11, F.a12, F.a21, F.a22);
  }
  find_impedances(law_, rows, rho_);
  const double *Z11 = rows[SideRows::B11], *Z12 = rows[SideRows::B12], *Z22 = rows[SideRows::B22];
  for (const int point : points(side)) {
    const Kind other = kind(neighbour(side, point != 0));
    if (end_of(line, point) && other != Kind::periodic) continue;
    const auto k = static_cast<std::size_t>(point);
    const std::size_t m = slot(side, point);
    const std::ptrdiff_t a = line.at(point, 0);
    SolidState s = load(q, a);
    const Mat2 Z = matrix({Z11[m], Z12[m], Z22[m]});
    if (!Z.allFinite()) continue;
    const Vec2 t(-values.n[n + k], values.n[k]);
    const Vec2 missing =
        T_[index(side)][k] - traction_of(s.P, normal(side, point)) - Z * v_change_[index(side)][k];
    s.v += t * (t.dot(missing) / t.dot(Z * t));
    store(q, a, s);
  }
}

/// Normal of the neighbour at the end k of a side.
template <Law L>
Vec2 SolidBoundary<L>::side_normal_at_end(Side side, int k) const {
  const Side other = neighbour(side, k != 0);
  return at(other, at_upper_end(side) ? line_of(other).n - 1 : 0).n0;
}

/// n0^T P := T on loaded sides, no shear on slip and symmetry sides; the rest of P stays.
template <Law L>
void SolidBoundary<L>::set_normal_stress(FieldView q, Side side, double t) const {
  const SideIndex& line = line_of(side);
  for (const int k : points(side)) {
    const std::ptrdiff_t a = line.at(k, 0);
    const SideMetrics& m = at(side, k);
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

/// Two loaded sides: both tractions hold. Two sides with given displacement: the change of the velocity goes
/// out along the characteristics of both.
template <Law L>
void SolidBoundary<L>::set_corner_stress(FieldView q) const {
  for (const Side side : {Side::left, Side::right}) {
    const SideIndex& line = line_of(side);
    for (const int k : {0, line.n - 1}) {
      if (!advanced(side, k)) continue;
      const Side other = neighbour(side, k != 0);
      const int k_other = at_upper_end(side) ? line_of(other).n - 1 : 0;
      const std::ptrdiff_t a = line.at(k, 0);
      SolidState s = load(q, a);
      if (loaded(side) && loaded(other)) {
        s.P = stress_of_tractions(at(side, k).n0, T_[index(side)][static_cast<std::size_t>(k)],
                                  at(other, k_other).n0, T_[index(other)][static_cast<std::size_t>(k_other)]);
      } else if (kind(side) == Kind::displacement && kind(other) == Kind::displacement) {
        share_change_at_corner(q, s, {side, k}, {other, k_other});
      }
      store(q, a, s);
    }
  }
}

/// The given velocity of a corner of two sides changes its stress as on either of them, each with a share of the
/// change: the force that made the predicted velocity acts across the shorter way the more, in proportion to
/// |grad r|. P(F) here, whose one-sided differences of u answer to P again, makes waves grow beside the corner,
/// and equal shares do on long cells.
template <Law L>
void SolidBoundary<L>::share_change_at_corner(ConstFieldView q, SolidState& s, const SidePoint& one,
                                              const SidePoint& other) const {
  const Stiffness K = stiffness(q, one.side, one.k);
  const auto change = [&](const SidePoint& p) {
    return v_change_[index(p.side)][static_cast<std::size_t>(p.k)];
  };
  const auto rate = [&](const SidePoint& p) { return at(p.side, p.k).across.norm(); };
  const Vec2 dv = (change(one) + change(other)) / (rate(one) + rate(other));
  for (const SidePoint& p : {one, other}) {
    const Mat2 Z = impedance(K, p.side, p.k);
    if (Z.allFinite()) s.P = behind_waves(s.P, K, normal(p.side, p.k), rate(p) * (Z * dv));
  }
}

/// At a corner of a loaded side with a side of given displacement or slip, and of a slip side with one of
/// given displacement: P by extrapolation along the loaded or slip side, where it is P(F) or free to evolve;
/// a given traction still holds, and so does slip. Differences of u are only of first order there.
template <Law L>
void SolidBoundary<L>::extend_stress_to_corners(FieldView q, Side side, double t) const {
  const SideIndex& line = line_of(side);
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

}  // namespace fsi::solid
