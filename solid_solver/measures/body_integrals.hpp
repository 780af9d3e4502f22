#pragma once
/// Integrals over the body and its sides, errors against a known solution, and what an interface shows.

#include <fmt/format.h>

#include <cmath>

#include "common/core/failure.hpp"
#include "common/core/raise_to.hpp"
#include "common/wire/messages.hpp"
#include "solid_solver/boundary/interface.hpp"
#include "solid_solver/measures/totals.hpp"
#include "solid_solver/solid_component.hpp"

namespace fsi::solid {

/// Areas of the points of a grid that stands alone: trapezoidal rule in index space, second order.
template <Law L>
Field trapezoidal_areas(const SolidComponent<L>& component) {
  const Layout layout = component.layout();
  Field areas(layout, 1);
  for (int j = 0; j < layout.n2; ++j) {
    for (int i = 0; i < layout.n1; ++i) {
      const double weight =
          (i == 0 || i == layout.n1 - 1 ? 0.5 : 1.0) * (j == 0 || j == layout.n2 - 1 ? 0.5 : 1.0);
      areas(0, i, j) = weight * component.metrics().at(i, j).jacobian;
    }
  }
  return areas;
}

/// Strain energy per area at discretised points, F by central differences.
template <Law L>
Field strain_energy_density(const SolidComponent<L>& component, const L& law) {
  Field psi(component.layout(), 1);
  for (int j = 0; j < component.layout().n2; ++j) {
    for (const auto& [begin, end] : component.points().discretised(j)) {
      for (int i = begin; i < end; ++i) psi(0, i, j) = law.psi(component.deformation_gradient(i, j));
    }
  }
  return psi;
}

/// Areas and strain energy density of a component's points.
struct PointMeasures {
  ConstFieldView areas, psi;
};

template <Law L>
void add_totals(const SolidComponent<L>& component, const PointMeasures& measures, double rho,
                Totals& totals) {
  const Layout layout = component.layout();
  const ConstFieldView x = component.grid().x();
  for (int j = 0; j < layout.n2; ++j) {
    for (const auto& [begin, end] : component.points().valid(j)) {
      for (int i = begin; i < end; ++i) {
        const double area = measures.areas(0, i, j), mass = rho * area;
        const SolidState s = load(component.q(), layout.at(i, j));
        const Vec2 position = Vec2(x(0, i, j), x(1, i, j)) + s.u;
        totals.mass += mass;
        totals.momentum += mass * s.v;
        totals.kinetic_energy += 0.5 * mass * s.v.squaredNorm();
        totals.strain_energy += area * measures.psi(0, i, j);
        totals.angular_momentum += mass * cross(position, s.v);
      }
    }
  }
}

/// At all points with a value. Where a value is no number, neither is its error.
template <Law L>
void add_errors(const SolidComponent<L>& component, const StateFunction& exact, double t, Errors& errors) {
  const Layout layout = component.layout();
  const ConstFieldView x = component.grid().x();
  for (int j = 0; j < layout.n2; ++j) {
    for (const auto& [begin, end] : component.points().valid(j)) {
      for (int i = begin; i < end; ++i) {
        const SolidState s = load(component.q(), layout.at(i, j)), e = exact(x(0, i, j), x(1, i, j), t);
        for (const int axis : {0, 1}) {
          raise_to(errors.u, std::abs(s.u[axis] - e.u[axis]));
          raise_to(errors.v, std::abs(s.v[axis] - e.v[axis]));
        }
        const Tensor2 d = minus(s.P, e.P);
        for (const double component_of_P : {d.a11, d.a12, d.a21, d.a22})
          raise_to(errors.P, std::abs(component_of_P));
      }
    }
  }
}

template <Law L>
SideLoad load_on_side(const SolidComponent<L>& component, Side side) {
  const Layout layout = component.layout();
  const SideIndex line(layout, side);
  const ConstFieldView x = component.grid().x();
  SideLoad load_of_side;
  for (int k = 0; k < line.n; ++k) {
    const SideMetrics& m = component.boundary().sides().at(side, k);
    const SolidState s = load(component.q(), line.at(k, 0));
    const Vec2 position = Vec2(x.plane(0)[line.at(k, 0)], x.plane(1)[line.at(k, 0)]) + s.u;
    const Vec2 force = (k == 0 || k == line.n - 1 ? 0.5 : 1.0) * m.spacing * traction_of(s.P, m.n0);
    load_of_side.force += force;
    load_of_side.moment += cross(position, force);
    load_of_side.power += s.v.dot(force);
  }
  return load_of_side;
}

/// Density and time of a state.
struct InterfaceMoment {
  double rho, t;  ///< [mass/volume], [time]
};

/// A side and a wall whose normals have a smaller cosine than this meet at right angles.
inline constexpr double right_angle = 1e-3;

/// What a solid shows of a point of an interface: of a body with a chosen solution the difference to it, at a point
/// that also lies on a side whose motion is given that motion, and without what would leave a wall along which
/// the point slides.
template <Law L>
SolidState shown_state(const SolidComponent<L>& component, const InterfaceMoment& moment, Side side, int k) {
  const GridPoint p = grid_point(component.layout(), side, k);
  const ConstFieldView x = component.grid().x();
  const ChosenSolution* chosen = component.chosen();
  SolidState s = load(component.q(), component.layout().at(p.i, p.j));
  const auto given = given_motion(component.boundary().sides(), side, k, moment.t);
  if (given) s.u = given->u, s.v = given->v;
  if (chosen != nullptr) s = sum_of(s, -1.0, chosen->state(x(0, p.i, p.j), x(1, p.i, p.j), moment.t));
  const auto wall = wall_of(component.boundary().sides(), side, k);
  if (wall && !given) s.u -= *wall * wall->dot(s.u), s.v -= *wall * wall->dot(s.v);
  return s;
}

/// How free a point is, of wire::Freedom.
template <Law L>
std::uint8_t freedom_of(const SolidComponent<L>& component, double t, Side side, int k) {
  const Sides& sides = component.boundary().sides();
  if (given_motion(sides, side, k, t)) return wire::Freedom::fixed;
  const auto wall = wall_of(sides, side, k);
  const bool slides = wall && std::abs(wall->dot(sides.at(side, k).n0)) < right_angle;
  return slides ? wire::Freedom::slides : wire::Freedom::free;
}

/// @throws Diverged at the first point whose traction is no number
template <Law L>
void check_tractions(const SolidComponent<L>& component, double t, Side side, std::span<const double> w) {
  const std::size_t n = w.size() / 2;
  const ConstFieldView x = component.grid().x();
  for (std::size_t k = 0; k < n; ++k) {
    if (std::isfinite(w[k]) && std::isfinite(w[n + k])) continue;
    const GridPoint p = grid_point(component.layout(), side, static_cast<int>(k));
    throw Diverged(fmt::format("the stress is not a number any more, det F = {:.3g}",
                               determinant(component.deformation_gradient(p.i, p.j))),
                   {.t = t,
                    .grid = component.grid().name(),
                    .point = {p.i, p.j},
                    .position = {x(0, p.i, p.j), x(1, p.i, p.j)},
                    .of_reference = true});
  }
}

/// Fills `state` for the points of a side; of a body with a chosen solution, the differences to it. Uses no
/// ghost points, so that it may be called on a predicted state; a point that also lies on a side whose motion
/// is given has that motion, not the predicted one, and one that slides along a wall does not leave it.
/// @throws Diverged where the stress is not finite
template <Law L>
void gather_interface(const SolidComponent<L>& component, const L& law, const InterfaceMoment& moment,
                      Side side, SolidInterface& state) {
  const ConstFieldView x = component.grid().x();
  const int points = SideIndex(component.layout(), side).n;
  const auto n = static_cast<std::size_t>(points);
  for (std::vector<double>* two : {&state.x, &state.v, &state.w}) two->resize(2 * n);
  state.Z.resize(3 * n);
  state.fixed.resize(n);
  state.rows.resize(6 * n);
  state.z_p = std::sqrt(moment.rho * (law.lambda + 2.0 * law.mu));
  double *r = state.rows.data(), *w = state.w.data(), *Z = state.Z.data();
  const InterfaceRows rows = {.F = {r, r + n, r + 2 * n, r + 3 * n},
                              .normal1 = r + 4 * n,
                              .normal2 = r + 5 * n,
                              .w1 = w,
                              .w2 = w + n,
                              .Z11 = Z,
                              .Z12 = Z + n,
                              .Z22 = Z + 2 * n,
                              .n = points,
                              .follows = component.boundary().sides().follows(side)};
  for (std::size_t k = 0; k < n; ++k) {
    const int point = static_cast<int>(k);
    const GridPoint p = grid_point(component.layout(), side, point);
    const Vec2 n0 = component.boundary().sides().at(side, point).n0;
    const SolidState s = shown_state(component, moment, side, point);
    const Tensor2 F = component.deformation_gradient(p.i, p.j);
    rows.F.set(point, F.a11, F.a12, F.a21, F.a22);
    const Vec2 T = traction_of(s.P, n0);
    for (std::size_t c = 0; c < 2; ++c) {
      const auto axis = static_cast<int>(c);
      r[(4 + c) * n + k] = n0[axis];
      w[c * n + k] = T[axis];
      state.x[c * n + k] = x(axis, p.i, p.j) + s.u[axis];
      state.v[c * n + k] = s.v[axis];
    }
    state.fixed[k] = freedom_of(component, moment.t, side, point);
  }
  show_interface(law, rows, moment.rho);
  check_tractions(component, moment.t, side, state.w);
}

}  // namespace fsi::solid
