#pragma once
/// What waves that leave through a side change of stress and velocity there. Where the body carries none, its impedance is not a number
/// and a point keeps what was predicted: each function returns how many of the rank's own points do.

#include <Eigen/LU>
#include <cstddef>
#include <optional>
#include <span>

#include "solid_solver/boundary/interface.hpp"
#include "solid_solver/boundary/sides/chosen_values.hpp"
#include "solid_solver/boundary/sides/loaded_rows.hpp"
#include "solid_solver/boundary/sides/side_differences.hpp"
#include "solid_solver/boundary/sides/side_memory.hpp"
#include "solid_solver/boundary/sides/sides.hpp"

namespace fsi::solid {

template <Law L>
class Characteristics {
 public:
  /// @param rho density of the reference configuration [mass/volume]
  Characteristics(const Sides& sides, const ChosenValues& chosen, const L& law, double rho)
      : sides_(sides), chosen_(chosen), law_(law), rho_(rho) {}

  int follow(FieldView q, Side side, double t, const SideMemory& memory) const;
  int slide(FieldView q, const InterfaceValues& values, const SideMemory& memory, LoadedRows& rows) const;
  int slide_corners(FieldView q, std::span<const InterfaceValues> projected, const SideMemory& memory) const;
  int follow_corners(FieldView q, const SideMemory& memory) const;
  int set_corner_stress(FieldView q, const SideMemory& memory) const;

 private:
  Stiffness stiffness(ConstFieldView q, const SidePoint& p) const;
  Mat2 impedance(const Stiffness& K, const SidePoint& p) const;
  int push_corner(FieldView q, const SidePoint& one, std::optional<Vec2> along,
                  const SideMemory& memory) const;
  int share_change(ConstFieldView q, SolidState& s, const SidePoint& one, const SideMemory& memory) const;

  const Sides& sides_;
  const ChosenValues& chosen_;
  const L& law_;
  double rho_;
};

template <Law L>
Stiffness Characteristics<L>::stiffness(ConstFieldView q, const SidePoint& p) const {
  return law_.K(plus(identity, gradient(sides_, q, p, plane::u1)));
}

/// Z of waves along the reference normal of a side, per unit reference area.
template <Law L>
Mat2 Characteristics<L>::impedance(const Stiffness& K, const SidePoint& p) const {
  return matrix(impedance_matrix(K, sides_.at(p.side, p.k).n0, rho_, 1.0));
}

/// The predicted traction w0 and velocity v0 of a side become w and v along the outgoing characteristics,
/// w - Z v = w0 - Z v0, the vector form of paper eq. (18): given v changes w, given w changes v.
/// Differs from the paper, which overwrites the given half only: the other half then keeps a mode that
/// nothing damps, and corners of sides with given displacement are
/// unstable. The change is of the size of the truncation error. Beside given motion all of P changes that the
/// waves carry: a traction that changes alone leaves tangential stress of its own behind, which grows. Slip sides
/// change the traction alone: with the rest, ripples grow where they meet an interface behind a strong shock.
template <Law L>
int Characteristics<L>::follow(FieldView q, Side side, double t, const SideMemory& memory) const {
  const SideIndex& line = sides_.line(side);
  const Condition& condition = sides_.condition(side);
  int waveless = 0;
  for (const int k : sides_.points(side)) {
    if (!sides_.inner(side, k)) continue;
    const std::ptrdiff_t a = line.at(k, 0);
    const SideMetrics& m = sides_.at(side, k);
    SolidState s = load(q, a);
    const Stiffness K = stiffness(q, {side, k});
    const Mat2 Z = impedance(K, {side, k});
    if (!Z.allFinite()) {
      waveless += sides_.owns(side, k);
      continue;
    }
    const Vec2 w = traction_of(s.P, m.n0);
    const Vec2& dv = memory.v_change(side, k);
    if (condition.loaded()) {
      Vec2 change = Z.inverse() * (memory.T(side, k) - w);
      if (sides_.at_end(side, k) && sides_.condition_beyond(side, k).slips()) {
        const Vec2 wall = sides_.normal_around_corner(side, k);
        change -= wall * wall.dot(change);
      }
      s.v += change;
    } else if (condition.moved()) {
      s.P = behind_waves(s.P, K, m.n0, Z * dv);
    } else {
      const Vec2 shear = w - traction_of(chosen_.state(a, t).P, m.n0);
      const Vec2 slide = -m.t0 * (m.t0.dot(shear + Z * dv) / m.t0.dot(Z * m.t0));
      s.v += slide;
      s.P = plus_dyad(s.P, m.n0, Z * (dv + slide));
    }
    store(q, a, s);
  }
  return waveless;
}

/// What w - Z v = w0 - Z v0 says along the tangent of an interface, whose gas takes no shear: the projection
/// gives n . v, and the shear that the prediction left changes t . v. Differs from the paper, which leaves t
/// . v as predicted; nothing damps it then, and with the relaxation (41) ripples of it grow from round-off.
template <Law L>
int Characteristics<L>::slide(FieldView q, const InterfaceValues& values, const SideMemory& memory,
                              LoadedRows& loaded) const {
  const Side side = values.side;
  const std::span<const int> points = sides_.points(side);
  const SideRows rows = loaded.of(side);
  const auto n = static_cast<std::size_t>(sides_.line(side).n);
  if (points.empty()) return 0;
  for (const int k : points) {
    const Tensor2 F = plus(identity, gradient(sides_, q, {side, k}, plane::u1));
    rows.F().set(static_cast<int>(loaded.slot(side, k)), F.a11, F.a12, F.a21, F.a22);
  }
  find_impedances(law_, rows, rho_);
  const double *Z11 = rows[SideRows::B11], *Z12 = rows[SideRows::B12], *Z22 = rows[SideRows::B22];
  int waveless = 0;
  for (const int point : points) {
    if (sides_.at_end(side, point) && !sides_.condition_beyond(side, point).repeated()) continue;
    const auto k = static_cast<std::size_t>(point);
    const std::size_t m = loaded.slot(side, point);
    const std::ptrdiff_t a = sides_.line(side).at(point, 0);
    SolidState s = load(q, a);
    const Mat2 Z = matrix({Z11[m], Z12[m], Z22[m]});
    if (!Z.allFinite()) {
      waveless += sides_.owns(side, point);
      continue;
    }
    const Vec2 t(-values.n[n + k], values.n[k]);
    const Vec2 missing = memory.T(side, point) - traction_of(s.P, sides_.at(side, point).n0) -
                         Z * memory.v_change(side, point);
    s.v += t * (t.dot(missing) / t.dot(Z * t));
    store(q, a, s);
  }
  return waveless;
}

/// The same at corners where an interface goes on, its normal there that of the chord, or meets a side with a given traction.
template <Law L>
int Characteristics<L>::slide_corners(FieldView q, std::span<const InterfaceValues> projected,
                                      const SideMemory& memory) const {
  int waveless = 0;
  for (const InterfaceValues& values : projected) {
    if (values.grid != sides_.grid().index) continue;
    const Side side = values.side;
    const int last = sides_.line(side).n - 1;
    for (const int k : {0, last}) {
      const bool once = values.goes_on[k == 0 ? 0 : 1] && direction_of(side) == 0;
      const bool slides = once || sides_.condition_beyond(side, k).knows_rate();
      if (!slides || !sides_.advanced(side, k)) continue;
      const auto at = static_cast<std::size_t>(k);
      const Vec2 t(-values.n[values.n.size() / 2 + at], values.n[at]);
      waveless += push_corner(q, {side, k}, t, memory);
    }
  }
  return waveless;
}

/// Corners of two sides with given tractions: v follows both, as on either.
template <Law L>
int Characteristics<L>::follow_corners(FieldView q, const SideMemory& memory) const {
  int waveless = 0;
  for (const Side side : {Side::left, Side::right}) {
    for (const int k : {0, sides_.line(side).n - 1}) {
      const bool given = sides_.condition(side).knows_rate() && sides_.condition_beyond(side, k).knows_rate();
      if (given && sides_.advanced(side, k)) waveless += push_corner(q, {side, k}, std::nullopt, memory);
    }
  }
  return waveless;
}

/// Both sides push the corner, each over the shorter way the more, in proportion to |grad r|: Z dv = push, or only what that says along
/// a tangent. Without it nothing damps what a corner does against its loads: waves along the sides grow from it on cells that are not
/// square, and others in nearly incompressible bodies.
template <Law L>
int Characteristics<L>::push_corner(FieldView q, const SidePoint& one, std::optional<Vec2> along,
                                    const SideMemory& memory) const {
  const SidePoint other = sides_.around_corner(one.side, one.k);
  const std::ptrdiff_t a = sides_.line(one.side).at(one.k, 0);
  SolidState s = load(q, a);
  const Stiffness K = stiffness(q, one);
  Vec2 projected = Vec2::Zero(), push = Vec2::Zero();
  for (const SidePoint& p : {one, other}) {
    if (sides_.condition(p.side).meets_gas()) projected += memory.v_change(p.side, p.k);
  }
  Mat2 Z = Mat2::Zero();
  for (const SidePoint& p : {one, other}) {
    const SideMetrics& m = sides_.at(p.side, p.k);
    const double rate = m.across.norm();
    const Mat2 of_side = rate * impedance(K, p);
    push += rate * (memory.T(p.side, p.k) - traction_of(s.P, m.n0)) - of_side * projected;
    Z += of_side;
  }
  if (!Z.allFinite()) return sides_.owns(one.side, one.k);
  s.v += along ? Vec2(*along * (along->dot(push) / along->dot(Z * *along))) : Vec2(Z.inverse() * push);
  store(q, a, s);
  return 0;
}

/// Two loaded sides: both tractions hold. Two sides with given displacement: the change of the velocity goes
/// out along the characteristics of both.
template <Law L>
int Characteristics<L>::set_corner_stress(FieldView q, const SideMemory& memory) const {
  int waveless = 0;
  for (const Side side : {Side::left, Side::right}) {
    const SideIndex& line = sides_.line(side);
    for (const int k : {0, line.n - 1}) {
      if (!sides_.advanced(side, k)) continue;
      const SidePoint other = sides_.around_corner(side, k);
      const std::ptrdiff_t a = line.at(k, 0);
      SolidState s = load(q, a);
      if (sides_.loaded(side) && sides_.loaded(other.side)) {
        s.P = stress_of_tractions(sides_.at(side, k).n0, memory.T(side, k), sides_.at(other.side, other.k).n0,
                                  memory.T(other.side, other.k));
      } else if (sides_.condition(side).moved() && sides_.condition(other.side).moved()) {
        waveless += share_change(q, s, {side, k}, memory);
      }
      store(q, a, s);
    }
  }
  return waveless;
}

/// The given velocity of a corner of two sides changes its stress as on either of them, each with a share of the
/// change: the force that made the predicted velocity acts across the shorter way the more, in proportion to
/// |grad r|. P(F) here, whose one-sided differences of u answer to P again, makes waves grow beside the corner,
/// and equal shares do on long cells.
template <Law L>
int Characteristics<L>::share_change(ConstFieldView q, SolidState& s, const SidePoint& one,
                                     const SideMemory& memory) const {
  const Stiffness K = stiffness(q, one);
  const SidePoint other = sides_.around_corner(one.side, one.k);
  const auto change = [&](const SidePoint& p) { return memory.v_change(p.side, p.k); };
  const auto rate = [&](const SidePoint& p) { return sides_.at(p.side, p.k).across.norm(); };
  const Vec2 dv = (change(one) + change(other)) / (rate(one) + rate(other));
  int waveless = 0;
  for (const SidePoint& p : {one, other}) {
    const Mat2 Z = impedance(K, p);
    if (Z.allFinite()) {
      s.P = behind_waves(s.P, K, sides_.at(p.side, p.k).n0, rate(p) * (Z * dv));
    } else {
      waveless += sides_.owns(p.side, p.k);
    }
  }
  return waveless;
}

}  // namespace fsi::solid
