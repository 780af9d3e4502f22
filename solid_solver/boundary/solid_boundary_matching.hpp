#pragma once
/// SolidBoundary, third part: the order of its work, and ghost
/// points that make stress and displacement fit together.

#include <algorithm>

#include "solid_solver/boundary/solid_boundary.hpp"
#include "solid_solver/kernels/dissipation.hpp"

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
    if (kind(side) == Kind::slip) match_slip_side(q, side, t);
  }
  for (const Side side : all_sides) {
    if (loaded(side)) match_loaded_side(q, side, t);
  }
  match_corners(q, t);
  for (const Side side : all_sides) extend_stress_to_corners(q, side, t);
  fill_line(q, t, {.first_plane = plane::P11, .last_plane = plane::P22, .m = -1});
  fill_line(q, t, {.m = -2});
  fill_frame(q, t);
}

/// 1 beside cells whose sides are as 1 to 1.1 or nearer, and less the longer or the flatter they are [-].
inline double squareness(const SideMetrics& m) {
  const double squared_ratio = m.across.squaredNorm() / m.along.squaredNorm();
  const double shape = std::min(squared_ratio, 1.0 / squared_ratio);
  return std::min(1.0, 1.5 * shape * shape);
}

/// How much of paper eq. (41) the traction of a loaded side takes [-]. The traction of P(F) is right with the second
/// differences of (43), (41) has fourth-order ones. What they differ by moves the side along the characteristics and
/// makes noise grow where cells are far from square, or where beta^r takes nearly all of it
/// (docs/theory_solid.md, stability).
inline double traction_share(const SideMetrics& m, double beta) {
  return squareness(m) * std::clamp(2.5 * (0.9 - beta), 0.0, 1.0);
}

/// A ghost point of paper eq. (43) contains differences along the side, times the cell's depth over its length:
/// what (40) makes of them on the side itself is no dissipation, and grows on deep cells. So the side's own
/// points take none across the side, and beside cells that are not square the next line takes it with an extrapolated
/// ghost point.
template <Law L>
void SolidBoundary<L>::correct_displacement_dissipation(ConstFieldView q, FieldView next, double beta) const {
  const double factor = 0.5 * beta;
  for (const Side side : all_sides) {
    if (!loaded(side)) continue;
    const SideIndex& line = line_of(side);
    for (const int k : points(side)) {
      const auto [i, j] = grid_point(layout(), side, k);
      const int step = at_upper_end(side) ? -1 : 1;
      const bool first = direction_of(side) == 0;
      const bool has_next = grid_.points->is_discretised(first ? i + step : i, first ? j : j + step);
      const double unlike = has_next ? factor * (1.0 - squareness(at(side, k))) : 0.0;
      for (int p = plane::u1; p <= plane::u2; ++p) {
        const double* values = q.plane(p);
        const auto u = [&](int m) { return values[line.at(k, m)]; };
        const double beyond = u(-1) - extrapolated(u(0), u(1), u(2), limiter_);
        next.plane(p)[line.at(k, 0)] += factor * fourth_difference(u(-2), u(-1), u(0), u(1), u(2));
        next.plane(p)[line.at(k, 1)] += unlike * fourth_difference(beyond, 0, 0, 0, 0);
      }
    }
  }
}

template <Law L>
template <class Gradient>
void SolidBoundary<L>::correct_relaxation(ConstFieldView q, FieldView next, double beta, double t) const {
  for (const Side side : all_sides) {
    if (!loaded(side)) continue;
    for (const int k : points(side)) {
      const SideMetrics& m = at(side, k);
      const double back = 1.0 - traction_share(m, beta);
      if (back == 0) continue;
      const auto [i, j] = grid_point(layout(), side, k);
      const WideRow u1(q, plane::u1, j), u2(q, plane::u2, j);
      const Gradient gradient(grid_.x, *grid_.metrics, j);
      const std::ptrdiff_t a = layout().at(i, j);
      const Tensor2 P = minus(load(q, a).P, chosen_offset(a, t));
      const Vec2 taken = traction_of(surplus(law_, gradient(i, u1.first(i), u2.first(i)), P, beta), m.n0);
      SolidState s = load(next, a);
      s.P = plus_dyad(s.P, m.n0, back * taken);
      store(next, a, s);
    }
  }
}

/// Derivatives of u or v (first = plane::u1, plane::v1) at a boundary point from its four neighbours.
template <Law L>
Tensor2 SolidBoundary<L>::gradient(ConstFieldView q, Side side, int k, int first) const {
  const SideIndex& line = line_of(side);
  const SideMetrics& m = at(side, k);
  const Tensor2 along = plus_dyad({}, difference_along(q, line, first, k), m.along);
  return plus_dyad(along, difference_across(q, line, first, k, m.sign), m.across);
}

template <Law L>
void SolidBoundary<L>::match_slip_side(FieldView q, Side side, double t) const {
  const SideIndex& line = line_of(side);
  for (const int k : points(side)) {
    const bool slip_at_load = end_of(line, k) && loaded(neighbour(side, k != 0));
    if (inner(side, k) || slip_at_load) match_slip_point(q, side, k, t);
  }
}

/// Ghost points of a loaded side, then the tangential stress, which is that of P(F). All points at once: what is set
/// at one of them, none of the others reads.
template <Law L>
void SolidBoundary<L>::match_loaded_side(FieldView q, Side side, double t) {
  if (points(side).empty()) return;
  const SideIndex& line = line_of(side);
  const SideRows rows = rows_of(side);
  begin_match(q, side, t);
  match_tractions(law_, rows);
  set_matched_ghosts(q, side, t);
  find_stresses(law_, rows);
  for (const int k : points(side)) {
    if (!inner(side, k)) continue;
    const SideMetrics& s = at(side, k);
    const std::ptrdiff_t a = line.at(k, 0);
    const Tensor2 P = plus(rows.P().at(static_cast<int>(slot(side, k))), chosen_offset(a, t));
    SolidState state = load(q, a);
    state.P = plus_dyad(state.P, s.t0, traction_of(P, s.t0) - traction_of(state.P, s.t0));
    store(q, a, state);
  }
}

template <Law L>
BoundaryStrain SolidBoundary<L>::strain_along(ConstFieldView q, Side side, int k) const {
  const SideMetrics& m = at(side, k);
  return {.F = plus_dyad(identity, difference_along(q, line_of(side), plane::u1, k), m.along),
          .across = m.across,
          .n0 = m.n0,
          .sign = m.sign};
}

/// Rows for match_tractions: it begins with the extrapolated derivatives across.
template <Law L>
void SolidBoundary<L>::begin_match(ConstFieldView q, Side side, double t) {
  const SideIndex& line = line_of(side);
  const SideRows rows = rows_of(side);
  for (const int k : points(side)) {
    const std::size_t m = slot(side, k);
    const SideMetrics& s = at(side, k);
    const std::ptrdiff_t a = line.at(k, 0);
    const Tensor2 F = strain_along(q, side, k).F;
    const Vec2 d = difference_across(q, line, plane::u1, k, s.sign);
    const Vec2 T = traction_of(minus(load(q, a).P, chosen_offset(a, t)), s.n0);
    rows.F().set(static_cast<int>(m), F.a11, F.a12, F.a21, F.a22);
    rows[SideRows::next1][m] = d.x();
    rows[SideRows::next2][m] = d.y();
    rows[SideRows::T1][m] = T.x();
    rows[SideRows::T2][m] = T.y();
    rows[SideRows::open][m] = inner(side, k) ? 1.0 : 0.0;
  }
}

/// Ghost u from the derivatives that were found, ghost v where the traction is a given function; the rows F then
/// hold all of F.
template <Law L>
void SolidBoundary<L>::set_matched_ghosts(FieldView q, Side side, double t) {
  const SideIndex& line = line_of(side);
  const SideRows rows = rows_of(side);
  for (const int k : points(side)) {
    if (!inner(side, k)) continue;
    const std::size_t m = slot(side, k);
    const SideMetrics& s = at(side, k);
    const BoundaryStrain strain = {
        .F = rows.F().at(static_cast<int>(m)), .across = s.across, .n0 = s.n0, .sign = s.sign};
    std::optional<Vec2> du = Vec2(rows[SideRows::d1][m], rows[SideRows::d2][m]);
    if (rows[SideRows::open][m] != 0) {
      const Vec2 T(rows[SideRows::T1][m], rows[SideRows::T2][m]);
      du = match_traction(law_, strain, T, difference_across(q, line, plane::u1, k, s.sign));
    }
    if (!du) {
      broke(side, k, t);
      continue;
    }
    set_ghost(q, line, k, plane::u1, 2.0 * s.sign * *du);
    if (kind(side) == Kind::traction) match_velocity(q, side, k, t, strain, *du);
    const Tensor2 F = with_sharper_tangent(q, side, k, plus_dyad(strain.F, *du, s.across));
    rows.F().set(static_cast<int>(m), F.a11, F.a12, F.a21, F.a22);
  }
}

/// Ghost v from the rate of the traction.
template <Law L>
void SolidBoundary<L>::match_velocity(FieldView q, Side side, int k, double t, const BoundaryStrain& strain,
                                      const Vec2& du) const {
  const SideIndex& line = line_of(side);
  const SideMetrics& m = at(side, k);
  const Tensor2 along = plus_dyad({}, difference_along(q, line, plane::v1, k), m.along);
  const Vec2 rate =
      T_rate_[index(side)][static_cast<std::size_t>(k)] - traction_of(chosen_source(line.at(k, 0), t), m.n0);
  set_ghost(q, line, k, plane::v1, 2.0 * m.sign * match_traction_rate(law_, strain, du, along, rate));
}

/// F with its stretch along a closed or mirrored interface from fourth-order differences, of the reference
/// positions and of u alike, so that a turned body is not stretched. Central ones of second order, which stay
/// on other sides, make the largest error of P. One-sided differences would make free corners unstable, and a
/// lower order only beside them would cost the rate.
template <Law L>
Tensor2 SolidBoundary<L>::with_sharper_tangent(ConstFieldView q, Side side, int k, const Tensor2& F) const {
  const SideIndex& line = line_of(side);
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
  const SideIndex& line = line_of(side);
  const SideMetrics& m = at(side, k);
  const BoundaryStrain strain = strain_along(q, side, k);
  const std::ptrdiff_t a = line.at(k, 0);
  const double shear = m.t0.dot(traction_of(minus(chosen(a, t).P, chosen_offset(a, t)), m.n0));
  const auto du = match_shear(law_, strain, shear, difference_across(q, line, plane::u1, k, m.sign));
  if (!du) return broke(side, k, t);
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
    const SideIndex& line = line_of(side);
    for (const int k : {0, line.n - 1}) {
      if (!advanced(side, k)) continue;
      const Side other = neighbour(side, k != 0);
      if (!loaded(side) || !loaded(other)) continue;
      const SideIndex& other_line = line_of(other);
      const int k_other = at_upper_end(side) ? other_line.n - 1 : 0;
      const SideMetrics &m = at(side, k), &m_other = at(other, k_other);
      const std::ptrdiff_t a = line.at(k, 0);
      const Tensor2 P = minus(load(q, a).P, chosen_offset(a, t));
      const Tensor2 start = gradient(q, side, k, plane::u1);
      const auto F = match_corner(law_, P, plus(identity, start));
      if (!F) {
        broke(side, k, t);
        continue;
      }
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
  const SideIndex& line = line_of(side);
  const Side other = neighbour(side, k != 0);
  const SideIndex& other_line = line_of(other);
  const int k_other = at_upper_end(side) ? other_line.n - 1 : 0;
  for (const auto& [of, at_k, points] : {std::tuple(side, k, line), std::tuple(other, k_other, other_line)}) {
    const SideMetrics& m = at(of, at_k);
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

}  // namespace fsi::solid
