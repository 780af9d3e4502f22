#pragma once
/// The solid: a hyperelastic body on its reference configuration, advanced in time by an upwind scheme for
/// the first-order system of displacement, velocity and nominal stress (the paper's section 4.2).
///
///     SolidSolver solver(grid, law, options, boundaries, t0);
///     solver.assign_initial_conditions(u, v);
///     loop:  dt = solver.compute_time_step().dt
///            solver.advance_solid(t, dt)                  predicted state at t + dt
///            solver.apply_solid_bcs(t + dt, projected)    boundary points and ghosts at t + dt

#include <cstdint>
#include <span>
#include <string>

#include "common/core/field.hpp"
#include "common/grid/moving_grid.hpp"
#include "solid_solver/body_integrals.hpp"
#include "solid_solver/interface.hpp"
#include "solid_solver/options.hpp"
#include "solid_solver/probe.hpp"
#include "solid_solver/solid_component.hpp"
#include "solid_solver/time_step.hpp"

namespace fsi::solid {

/// Largest time step the solid can take, and why.
struct TimeStep {
  double dt = 0;       ///< safety factor included
  std::string reason;  ///< what limits it, for people
};

/// How well the numbers are, over all points at the last step.
struct Health {
  double min_det_F = 1;
  double min_phi_s = 0;  ///< smallest s-wave eigenvalue of the acoustic matrices, times |grad r|^2
};

template <Law L>
class SolidSolver {
 public:
  /// @throws UserMistake where boundaries, grid and options do not fit together
  SolidSolver(grid::MovingGrid reference_grid, L law, SolidOptions options, Boundaries boundaries, double t0)
      : law_(law),
        options_(options),
        component_(std::move(reference_grid), law_, options_, std::move(boundaries)),
        t_(t0) {
    if (!(options_.rho > 0))
      throw UserMistake(fmt::format("rho = {:g}: the density must be positive", options_.rho));
    if (time_stepping_eigenvalue(1.0, options_).beta >= 2.0) {
      throw UserMistake(
          "the scaled parts of dissipation and relaxation must add up to less than 2 for the solid");
    }
  }

  /// State at t0 from functions of the reference position; the stress is P(F(u)) by differences of u.
  void assign_initial_conditions(const VectorFunction& u, const VectorFunction& v) {
    component_.assign(
        [&](double x, double y, double t) { return SolidState{.u = u(x, y, t), .v = v(x, y, t), .P = {}}; },
        t_);
    component_.assign_stress();
    start();
  }
  /// State at t0, stress given.
  void assign_initial_conditions(const StateFunction& state) {
    component_.assign(state, t_);
    start();
  }
  /// Force per unit reference volume.
  void set_body_force(VectorFunction force) { component_.set_body_force(std::move(force)); }

  /// Largest stable step for the present state: paper eq. (44) in paper eq. (45), times the safety factor.
  /// The wave speeds are those the last sweep met (half a step old).
  TimeStep compute_time_step() const {
    const double waves = std::sqrt(component_.measured().rate_squared);
    const TimeSteppingEigenvalue lambda = time_stepping_eigenvalue(waves, options_);
    const double damping = -lambda.real + lambda.beta * waves;
    return {.dt = options_.cfl * largest_time_step(lambda),
            .reason = waves > damping ? "waves in the solid" : "dissipation in the solid"};
  }
  /// Predicted state at t + dt at all points; no boundary or interface condition is applied.
  /// @throws NumbersBroke at det F <= 0 or where the system is no longer hyperbolic
  void advance_solid(double t, double dt) {
    try {
      component_.advance(t, dt);
    } catch (const NumbersBroke& failure) {
      throw NumbersBroke(fmt::format("step {}, t = {:.6g}, {}", steps_ + 1, t, failure.what()));
    }
    ++steps_;
    t_ = t + dt;
  }
  /// Predicted state of the interface points of a side; reuses the memory of `state`. Needs no ghost points.
  void interface_state(Side side, SolidInterface& state) const {
    gather_interface(component_, law_, options_.rho, side, state);
  }
  /// Boundary conditions and ghost points at time t. `projected` has one entry per interface side.
  void apply_solid_bcs(double t, std::span<const InterfaceValues> projected = {}) {
    component_.apply_boundary(t, projected);
    t_ = t;
  }

  Health health() const {
    return {.min_det_F = component_.measured().min_det_F, .min_phi_s = component_.measured().min_phi_s};
  }
  Totals totals() const { return body_totals(component_, law_, options_.rho); }
  Errors errors(const StateFunction& exact, double t) const { return largest_errors(component_, exact, t); }
  SideLoad side_load(Side side) const { return load_on_side(component_, side); }
  /// @throws UserMistake when (x, y) lies outside the reference grid
  ProbePoint locate(double x, double y) const { return locate_probe(component_.grid(), x, y); }
  SolidState value(const ProbePoint& probe) const { return value_at_probe(component_.q(), probe); }

  /// Planes u1, u2, v1, v2, P11, P12, P21, P22 (namespace plane of state.hpp), ghosts included.
  ConstFieldView state() const { return component_.q(); }
  /// The same, for a restart.
  FieldView state() { return component_.q(); }
  /// Reference positions of the points.
  ConstFieldView reference() const { return component_.grid().x(); }
  const grid::MovingGrid& grid() const { return component_.grid(); }
  std::size_t points() const { return component_.layout().points(); }
  std::uint64_t steps() const { return steps_; }
  double t() const { return t_; }

 private:
  void start() {
    component_.apply_boundary(t_, {});
    component_.measure();
  }

  L law_;
  SolidOptions options_;
  SolidComponent<L> component_;
  double t_;
  std::uint64_t steps_ = 0;
};

}  // namespace fsi::solid
