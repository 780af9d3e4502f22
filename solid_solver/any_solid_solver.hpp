#pragma once
/// The solver of a solid whatever its law is, as the program uses it: calls that take a whole step or a whole side, so that
/// the program is compiled once and not for each law.
///
///     AnySolidSolver& solver
///     solver.assign_initial_conditions(u, v);
///     loop:  dt = solver.compute_time_step().dt
///            solver.advance_solid(t, dt, Look::all)       predicted state at t + dt
///            solver.apply_solid_bcs(t + dt, projected)    boundary points and ghosts at t + dt

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/field.hpp"
#include "common/grid/moving_grid.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "common/ranks/breaking.hpp"
#include "common/ranks/rows/share.hpp"
#include "solid_solver/boundary/interface.hpp"
#include "solid_solver/kernels/sweep/sweep_data.hpp"
#include "solid_solver/measures/pose.hpp"
#include "solid_solver/measures/probe.hpp"
#include "solid_solver/measures/totals.hpp"
#include "solid_solver/options.hpp"

namespace fsi::solid {

/// Largest time step the solid can take, and why.
struct TimeStep {
  double dt = 0;       ///< safety factor included [time]
  std::string reason;  ///< what limits it, for people
};

/// How well the numbers are, over all points at the last step.
struct Health {
  double min_det_F = 1;  ///< [-]
  /// Smallest s-wave eigenvalue of the acoustic matrices, times |grad r|^2 [pressure/length^2]
  double min_phi_s = 0;
  /// Ghost points of all steps that took the acoustic matrix of the body beside them [-]
  double settled = 0;
  /// Points of sides of all steps that kept their prediction, since the body carries no waves there [-]
  double waveless = 0;
};

class AnySolidSolver {
 public:
  AnySolidSolver() = default;
  AnySolidSolver(const AnySolidSolver&) = delete;
  AnySolidSolver& operator=(const AnySolidSolver&) = delete;
  AnySolidSolver(AnySolidSolver&&) = delete;
  AnySolidSolver& operator=(AnySolidSolver&&) = delete;
  virtual ~AnySolidSolver() = default;

  /// State at t0 from functions of the reference position; the stress is P(F(u)) by differences of u. The
  /// functions are asked at points that have a value only.
  virtual void assign_initial_conditions(const VectorFunction& u, const VectorFunction& v) = 0;
  /// State at t0, stress given.
  virtual void assign_initial_conditions(const StateFunction& state) = 0;
  /// Force per unit reference volume.
  virtual void set_body_force(const VectorFunction& force) = 0;
  /// Makes chosen fields exact; half of a step's sources act before it, half after it. Conditions on the
  /// sides then hold for the difference to the fields, and so does what an interface shows and is told: it
  /// lies where the reference configuration has it, but for the difference in u. Before the initial conditions.
  virtual void choose(const ChosenSolution& solution) = 0;

  /// Largest stable step for the present state: paper eq. (44) in paper eq. (45), times the safety factor,
  /// and not beyond what the fastest decay of the stress allows, which is an upper bound and needs no factor.
  /// The wave speeds are those the last sweep met (half a step old).
  virtual TimeStep compute_time_step() const = 0;
  /// Predicted state at t + dt at all discretised points; no boundary or interface condition is applied. Looks at
  /// the waves where `compute_time_step` is to know them: in all steps but those that others follow at once.
  /// @throws Diverged at det F <= 0 or where the system is no longer hyperbolic; all grids then keep the
  /// state at t
  virtual void advance_solid(double t, double dt, Look look) = 0;
  /// Predicted state of the interface points of a side; reuses the memory of `state`. Needs no ghost points.
  virtual void interface_state(Side side, SolidInterface& state, int grid) const = 0;
  /// Outward direction in which the end k of a side slides along a wall.
  virtual Vec2 along_wall(Side side, int k, int grid) const = 0;
  /// Boundary conditions and ghost points at time t, then interpolation between the grids. `projected` has
  /// one entry per interface side.
  virtual void apply_solid_bcs(double t, std::span<const InterfaceValues> projected) = 0;

  virtual Health health() const = 0;
  /// Overlaps of grids count once.
  virtual Totals totals() const = 0;
  /// Over all points that have a value.
  virtual Errors errors(const StateFunction& exact, double t) const = 0;
  virtual SideLoad side_load(Side side, int grid) const = 0;
  /// On rank 0; all call it.
  virtual Pose pose() const = 0;
  /// Body-fitted grids come first. @throws UserMistake when (x, y) lies outside the reference grids
  virtual ProbePoint locate(double x, double y) const = 0;
  SolidState value(const ProbePoint& probe) const { return value_at_probe(state(probe.grid), probe); }

  virtual int grids() const = 0;
  /// Null for a body on one grid.
  virtual const grid::CompositeGrid* composite() const = 0;
  virtual const grid::MovingGrid& grid(int grid) const = 0;
  /// Planes u1, u2, v1, v2, P11, P12, P21, P22 (namespace plane of state.hpp), ghosts included.
  virtual ConstFieldView state(int grid) const = 0;
  /// Points of a grid that have a value.
  virtual const grid::RowSets& valid(int grid) const = 0;
  /// Points that have a value, all grids.
  virtual std::size_t points() const = 0;
  virtual double t() const = 0;
  /// Everything the next steps depend on.
  virtual void archive(Archive& archive) = 0;

  // Several ranks that share the body: every one has such a solver, and calls the same functions with the same numbers
  // (ranks/README.md). What is said of the state above is then known where it says so.

  /// From now on this one advances its rows only. After the initial conditions.
  virtual void share(std::shared_ptr<Ranks> ranks, const RecutOptions& options) = 0;
  virtual const Share& shared() const = 0;
  /// Whether a rank knows `interface_state` of a side after `advance_solid`: rank 0, and those with rows of the side.
  virtual bool shows(Side side, int grid) const = 0;
  /// For what this rank does on its part before it applies conditions; where its solution diverges, it does on all ranks then.
  virtual Together& together() = 0;
  /// Brings interface sides and these strips to rank 0.
  virtual void fetch(std::vector<Strip> strips) = 0;
  /// Where the corners of a probe's cell are.
  static std::vector<Strip> strips_of(const ProbePoint& probe) {
    return {{probe.grid, probe.j, probe.i, probe.i + 2}, {probe.grid, probe.j + 1, probe.i, probe.i + 2}};
  }
  /// Brings the state to rank 0.
  virtual void collect() = 0;
  /// Everything the next steps depend on; other ranks forget what was counted.
  virtual void collect_all() = 0;
  /// A saved state was loaded, by all.
  virtual void loaded() = 0;
};

}  // namespace fsi::solid
