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
#include "solid_solver/interface.hpp"
#include "solid_solver/options.hpp"

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

/// Integrals over the body.
struct Totals {
  double mass = 0;
  Vec2 momentum = Vec2::Zero();
  double kinetic_energy = 0;
  double strain_energy = 0;
  double angular_momentum = 0;  ///< about the origin of physical space

  double energy() const { return kinetic_energy + strain_energy; }
};

/// Largest errors over all points and components.
struct Errors {
  double u = 0, v = 0, P = 0;
};

/// Integrals over one side: what the outside does to the body there.
struct SideLoad {
  Vec2 force = Vec2::Zero();
  double moment = 0;  ///< about the origin
  double power = 0;
};

/// Place of a probe: cell (i, j) and position inside it.
struct ProbePoint {
  int i = 0, j = 0;
  double a = 0, b = 0;  ///< in [0, 1]
};

template <Law L>
class SolidSolver {
 public:
  /// @throws UserMistake where boundaries and grid do not fit together
  SolidSolver(grid::MovingGrid reference_grid, L law, SolidOptions options, Boundaries boundaries, double t0);

  /// State at t0 from functions of the reference position; the stress is P(F(u)) by differences of u.
  void assign_initial_conditions(const VectorFunction& u, const VectorFunction& v);
  /// State at t0, stress given.
  void assign_initial_conditions(const StateFunction& state);
  /// Force per unit reference volume.
  void set_body_force(VectorFunction force);

  /// Largest stable step for the present state. paper eq. (44), paper eq. (45)
  TimeStep compute_time_step() const;
  /// Predicted state at t + dt at all points; no boundary or interface condition is applied.
  /// @throws NumbersBroke at det F <= 0 or where the system is no longer hyperbolic
  void advance_solid(double t, double dt);
  /// Predicted state of the interface points of a side; reuses the memory of `state`.
  void interface_state(Side side, SolidInterface& state) const;
  /// Boundary conditions and ghost points at time t. `projected` has one entry per interface side.
  void apply_solid_bcs(double t, std::span<const InterfaceValues> projected = {});

  Health health() const;
  Totals totals() const;
  Errors errors(const StateFunction& exact, double t) const;
  SideLoad side_load(Side side) const;
  /// @throws UserMistake when (x, y) lies outside the reference grid
  ProbePoint locate(double x, double y) const;
  SolidState value(const ProbePoint& probe) const;

  /// Planes u1, u2, v1, v2, P11, P12, P21, P22 (numbered by `Plane` of state.hpp), ghosts included.
  ConstFieldView state() const;
  /// The same, for a restart; call apply_solid_bcs or restore the ghosts as well.
  FieldView state();
  /// Reference positions of the points.
  ConstFieldView reference() const;
  const grid::MovingGrid& grid() const;
  std::size_t points() const;
  std::uint64_t steps() const;
};

}  // namespace fsi::solid
