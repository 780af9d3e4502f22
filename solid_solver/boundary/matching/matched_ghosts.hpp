#pragma once
/// Ghost points that make stress and displacement fit together: P(F) has the traction of the side.

#include <fmt/format.h>

#include <optional>

#include "common/core/failure.hpp"
#include "solid_solver/boundary/sides/chosen_values.hpp"
#include "solid_solver/boundary/sides/loaded_rows.hpp"
#include "solid_solver/boundary/sides/side_differences.hpp"
#include "solid_solver/boundary/sides/side_memory.hpp"
#include "solid_solver/boundary/sides/sides.hpp"

namespace fsi::solid {

template <Law L>
class MatchedGhosts {
 public:
  MatchedGhosts(const Sides& sides, const ChosenValues& chosen, const SideMemory& memory, const L& law)
      : sides_(sides), chosen_(chosen), memory_(memory), law_(law) {}

  // All: @throws Diverged where no displacement fits the traction

  void match_slip_side(FieldView q, Side side, double t) const;
  /// Ghost points of a loaded side, then the tangential stress, which is that of P(F). All points at once: what is set
  /// at one of them, none of the others reads.
  void match_loaded_side(FieldView q, Side side, double t, LoadedRows& loaded) const;
  /// Corners of two loaded sides: ghost u, and ghost v where both tractions are given functions.
  void match_corners(FieldView q, double t) const;

 private:
  void match_slip_point(FieldView q, const SidePoint& p, double t) const;
  void begin_match(ConstFieldView q, Side side, double t, LoadedRows& loaded) const;
  void set_matched_ghosts(FieldView q, Side side, double t, LoadedRows& loaded) const;
  void match_velocity(FieldView q, const SidePoint& p, double t, const BoundaryStrain& strain,
                      const Vec2& du) const;
  void match_corner_of(FieldView q, const SidePoint& one, double t) const;
  void broke(ConstFieldView q, const SidePoint& p, double t) const;

  const Sides& sides_;
  const ChosenValues& chosen_;
  const SideMemory& memory_;
  const L& law_;
};

template <Law L>
void MatchedGhosts<L>::match_slip_side(FieldView q, Side side, double t) const {
  for (const int k : sides_.points(side)) {
    const bool slip_at_load = sides_.at_end(side, k) && sides_.condition_beyond(side, k).loaded();
    if (sides_.inner(side, k) || slip_at_load) match_slip_point(q, {side, k}, t);
  }
}

/// The shear of P(F) vanishes: ghost u and v are moved along the side, their normal parts stay extrapolated.
template <Law L>
void MatchedGhosts<L>::match_slip_point(FieldView q, const SidePoint& p, double t) const {
  const SideIndex& line = sides_.line(p.side);
  const SideMetrics& m = sides_.at(p.side, p.k);
  const BoundaryStrain strain = strain_along(sides_, q, p);
  const std::ptrdiff_t a = line.at(p.k, 0);
  const double shear = m.t0.dot(traction_of(minus(chosen_.state(a, t).P, chosen_.offset(a, t)), m.n0));
  const auto du = match_shear(law_, strain, shear, difference_across(q, line, plane::u1, p.k, m.sign));
  if (!du) return broke(q, p, t);
  set_ghost(q, line, p.k, plane::u1, 2.0 * m.sign * *du);
  const Stiffness K = law_.K(plus_dyad(strain.F, *du, m.across));
  const Tensor2 strain_rate = contract(K, gradient(sides_, q, p, plane::v1));
  const double rate = m.t0.dot(traction_of(minus(strain_rate, chosen_.strain_rate(a, t)), m.n0));
  const double stiffness = m.t0.dot(matrix(acoustic_matrix(K, m.n0)) * m.t0) * m.across.norm() * m.sign;
  const Vec2 dv = difference_across(q, line, plane::v1, p.k, m.sign) - rate / stiffness * m.t0;
  set_ghost(q, line, p.k, plane::v1, 2.0 * m.sign * dv);
}

template <Law L>
void MatchedGhosts<L>::match_loaded_side(FieldView q, Side side, double t, LoadedRows& loaded) const {
  if (sides_.points(side).empty()) return;
  const SideIndex& line = sides_.line(side);
  const SideRows rows = loaded.of(side);
  begin_match(q, side, t, loaded);
  match_tractions(law_, rows);
  set_matched_ghosts(q, side, t, loaded);
  find_stresses(law_, rows);
  if (sides_.follows(side)) add_pressed_gaps(rows);
  for (const int k : sides_.points(side)) {
    if (!sides_.inner(side, k)) continue;
    const SideMetrics& s = sides_.at(side, k);
    const std::ptrdiff_t a = line.at(k, 0);
    const Tensor2 P = plus(rows.P().at(static_cast<int>(loaded.slot(side, k))), chosen_.offset(a, t));
    SolidState state = load(q, a);
    state.P = plus_dyad(state.P, s.t0, traction_of(P, s.t0) - traction_of(state.P, s.t0));
    store(q, a, state);
  }
}

/// Rows for match_tractions: it begins with the extrapolated derivatives across.
template <Law L>
void MatchedGhosts<L>::begin_match(ConstFieldView q, Side side, double t, LoadedRows& loaded) const {
  const SideIndex& line = sides_.line(side);
  const SideRows rows = loaded.of(side);
  for (const int k : sides_.points(side)) {
    const std::size_t m = loaded.slot(side, k);
    const SideMetrics& s = sides_.at(side, k);
    const std::ptrdiff_t a = line.at(k, 0);
    const Tensor2 F = strain_along(sides_, q, {side, k}).F;
    const Vec2 d = difference_across(q, line, plane::u1, k, s.sign);
    const Vec2 T = traction_of(minus(load(q, a).P, chosen_.offset(a, t)), s.n0);
    rows.F().set(static_cast<int>(m), F.a11, F.a12, F.a21, F.a22);
    rows[SideRows::next1][m] = d.x();
    rows[SideRows::next2][m] = d.y();
    rows[SideRows::T1][m] = T.x();
    rows[SideRows::T2][m] = T.y();
    rows[SideRows::open][m] = sides_.inner(side, k) ? 1.0 : 0.0;
  }
}

/// Ghost u from the derivatives that were found, ghost v where the traction is a given function; the rows F then
/// hold all of F.
template <Law L>
void MatchedGhosts<L>::set_matched_ghosts(FieldView q, Side side, double t, LoadedRows& loaded) const {
  const SideIndex& line = sides_.line(side);
  const SideRows rows = loaded.of(side);
  for (const int k : sides_.points(side)) {
    if (!sides_.inner(side, k)) continue;
    const std::size_t m = loaded.slot(side, k);
    const SideMetrics& s = sides_.at(side, k);
    const BoundaryStrain strain = {
        .F = rows.F().at(static_cast<int>(m)), .across = s.across, .n0 = s.n0, .sign = s.sign};
    std::optional<Vec2> du = Vec2(rows[SideRows::d1][m], rows[SideRows::d2][m]);
    if (rows[SideRows::open][m] != 0) {
      const Vec2 T(rows[SideRows::T1][m], rows[SideRows::T2][m]);
      du = match_traction(law_, strain, T, difference_across(q, line, plane::u1, k, s.sign));
    }
    if (!du) {
      broke(q, {side, k}, t);
      continue;
    }
    const Vec2 gap = (difference_across(q, line, plane::u1, k, s.sign) - *du) * s.sign * s.across.norm();
    rows[SideRows::gap1][m] = gap.x();
    rows[SideRows::gap2][m] = gap.y();
    set_ghost(q, line, k, plane::u1, 2.0 * s.sign * *du);
    if (sides_.condition(side).knows_rate()) match_velocity(q, {side, k}, t, strain, *du);
    const Tensor2 F = with_sharper_tangent(sides_, q, {side, k}, plus_dyad(strain.F, *du, s.across));
    rows.F().set(static_cast<int>(m), F.a11, F.a12, F.a21, F.a22);
  }
}

/// Ghost v from the rate of the traction.
template <Law L>
void MatchedGhosts<L>::match_velocity(FieldView q, const SidePoint& p, double t, const BoundaryStrain& strain,
                                      const Vec2& du) const {
  const SideIndex& line = sides_.line(p.side);
  const SideMetrics& m = sides_.at(p.side, p.k);
  const Tensor2 along = plus_dyad({}, difference_along(q, line, plane::v1, p.k), m.along);
  const Vec2 rate = memory_.T_rate(p.side, p.k) - traction_of(chosen_.source(line.at(p.k, 0), t), m.n0);
  set_ghost(q, line, p.k, plane::v1, 2.0 * m.sign * match_traction_rate(law_, strain, du, along, rate));
}

template <Law L>
void MatchedGhosts<L>::match_corners(FieldView q, double t) const {
  for (const Side side : {Side::left, Side::right}) {
    for (const int k : {0, sides_.line(side).n - 1}) {
      if (!sides_.advanced(side, k)) continue;
      if (sides_.loaded(side) && sides_.condition_beyond(side, k).loaded()) match_corner_of(q, {side, k}, t);
    }
  }
}

template <Law L>
void MatchedGhosts<L>::match_corner_of(FieldView q, const SidePoint& one, double t) const {
  const SidePoint other = sides_.around_corner(one.side, one.k);
  const SideMetrics &m = sides_.at(one.side, one.k), &m_other = sides_.at(other.side, other.k);
  const std::ptrdiff_t a = sides_.line(one.side).at(one.k, 0);
  const Tensor2 P = minus(load(q, a).P, chosen_.offset(a, t));
  const Tensor2 start = gradient(sides_, q, one, plane::u1);
  const auto F = match_corner(law_, P, plus(identity, start));
  if (!F) return broke(q, one, t);
  set_corner_ghosts(sides_, q, one, plane::u1, minus(*F, identity));
  if (!sides_.condition(one.side).knows_rate() || !sides_.condition(other.side).knows_rate()) return;
  const Stiffness K = law_.K(*F);
  const Tensor2 velocity = gradient(sides_, q, one, plane::v1);
  const Tensor2 rate = minus(stress_of_tractions(m.n0, memory_.T_rate(one.side, one.k), m_other.n0,
                                                 memory_.T_rate(other.side, other.k)),
                             chosen_.source(a, t));
  set_corner_ghosts(sides_, q, one, plane::v1,
                    plus(velocity, least_change(K, minus(rate, contract(K, velocity)))));
}

template <Law L>
void MatchedGhosts<L>::broke(ConstFieldView q, const SidePoint& p, double t) const {
  if (!sides_.owns(p.side, p.k)) return;
  const GridPoint point = grid_point(sides_.layout(), p.side, p.k);
  const Vec2 T = memory_.T(p.side, p.k), X = sides_.position(sides_.line(p.side).at(p.k, 0));
  const Stiffness K = law_.K(plus(identity, gradient(sides_, q, p, plane::u1)));
  const SymmetricTensor2 Z = impedance_matrix(K, sides_.at(p.side, p.k).n0, 1.0, 1.0);
  const std::string what =
      fmt::format("on side {} the ", name_of(p.side)) +
      (T.allFinite()          ? fmt::format("law {} cannot bear the traction ({:.4g}, {:.4g}) per reference "
                                                     "area and stay hyperbolic",
                                            L::name, T.x(), T.y())
       : std::isfinite(Z.a11) ? std::string("traction is not a number any more")
                              : fmt::format("law {} carries no waves any more", L::name));
  throw Diverged(what, {.t = t,
                        .grid = sides_.grid().name,
                        .point = {point.i, point.j},
                        .position = {X.x(), X.y()},
                        .of_reference = true});
}

}  // namespace fsi::solid
