#pragma once
/// Ways to fill ghost lines, of which the kinds of boundaries choose. Those that return a number count the points of the
/// side beside whose ghosts a bound acted, once each (docs/output.md, "Fallbacks").

#include <cstdint>
#include <span>

#include "common/core/types.hpp"
#include "fluid_solver/boundary/side_points.hpp"
#include "fluid_solver/gas_options.hpp"
#include "fluid_solver/state_vector.hpp"

namespace fsi::fluid {

/// No side leads the gas's speed of sound below this part of that inside: its wall runs away from the gas, or the states on its
/// two sides would tear the gas apart.
inline constexpr double least_sound = 0.1;

/// A state, and whether a bound acted on its way.
struct BoundedState {
  StateVector q;
  bool bounded = false;
};
/// `q` itself, or `fallback` where it has no positive density or pressure.
BoundedState positive_or(const StateVector& q, const StateVector& fallback);

/// Value one line outside q0, from q0, q1, q2 further in: third order; with `limited` never beyond twice the
/// last differences, and q0 where the result would have no positive density or pressure.
BoundedState extrapolated(const StateVector& q0, const StateVector& q1, const StateVector& q2, bool limited);

/// A wall along a side, n points, vectors component-major.
struct Wall {
  std::span<const double> n;                           ///< unit normal into the gas
  std::span<const double> v;                           ///< velocity of the wall's points
  std::span<const double> a;                           ///< their acceleration; empty: not known yet
  bool closed = false;                                 ///< the side is periodic along itself
  bool mirrored_first = false, mirrored_last = false;  ///< ghosts beyond its ends along the side are known
  bool held_first = false, held_last = false;          ///< at its ends another wall holds the gas, too
};

/// Moving slip wall: density and velocity extrapolated, pressure from the momentum equation on the wall.
///
/// The gas on the wall stays on it: with the wall's curve g(r, t) and s_dot = (v - g_t).g_r / |g_r|^2,
///
///     dp/dn = -rho n.Dv/Dt,   n.Dv/Dt = n.(g_tt + 2 s_dot g_tr + s_dot^2 g_rr).
///
/// Differs from the paper: this is the published compatibility condition with the wall's shear and curvature
/// written out; the derivative across the side is split into normal and tangential parts so that skewed grids
/// keep second order. Where another wall holds the gas, too, it goes with the corner: grad p = -rho g_tt. A one-sided
/// derivative along the side grows there once the two walls are far from a right angle, by what it makes of p itself.
/// With a limiter, the image of the gas inside where a shock leaves.
std::uint64_t wall_ghosts(FieldView q, ConstFieldView x, const SidePoints& side, const Wall& wall,
                          const GasOptions& options);

/// Behind an outflow: what leaves along characteristics is extrapolated, what would enter stays as it is on
/// the boundary. `v` is the velocity of the side's points.
std::uint64_t outflow_ghosts(FieldView q, ConstFieldView x, const SidePoints& side, std::span<const double> v,
                             const GasOptions& options);

/// All variables extrapolated.
std::uint64_t extrapolated_ghosts(FieldView q, const SidePoints& side, bool limited);

/// Values of a given state on the lines -2 <= m <= 0 of points first <= k < last.
void given_lines(FieldView q, ConstFieldView x, const SidePoints& side, const StateField& state, double t);

/// Even and odd reflection about the straight line through the side's ends, for points first <= k < last.
void symmetry_ghosts(FieldView q, ConstFieldView x, const SidePoints& side, int first, int last);

/// Values of the other end of the period, for points first <= k < last.
void periodic_ghosts(FieldView q, const SidePoints& side, int first, int last);

/// Unit normal of a side into the grid at point k.
Vec2 inward_normal(ConstFieldView x, const SidePoints& side, int k);
/// Unit normal into the grid of the straight line through the side's ends.
Vec2 straight_normal(ConstFieldView x, const SidePoints& side);

}  // namespace fsi::fluid
