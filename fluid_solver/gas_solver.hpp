#pragma once
/// The gas solver: Euler equations on mapped, moving component grids, advanced one step at a time.
///
///     receive projected values -> apply_fluid_bcs -> move_grids -> advance_fluid -> interface_state ->
///     publish
///
/// One grid, or a Cartesian background with body-fitted grids before it. Everything that belongs to one grid
/// lives in Component; what couples them, in CompositeGrid.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/grid/geometry/near_curves.hpp"
#include "common/grid/moving_grid.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "common/ranks/rows/share.hpp"
#include "fluid_solver/component.hpp"
#include "fluid_solver/gas_options.hpp"
#include "fluid_solver/levels/gas_levels.hpp"

namespace fsi::fluid {

/// Largest stable step, safety factor included, and what limits it.
struct TimeStep {
  double dt = 0;       ///< [time]
  std::string reason;  ///< for people: which grid, point and position
};

/// The gas along an interface side, n points; vectors component-major
/// (component c of point k at [c * n + k]).
struct GasInterface {
  std::vector<double> x;    ///< positions, 2 n
  std::vector<double> v;    ///< velocity, 2 n
  std::vector<double> p;    ///< pressure, n
  std::vector<double> z_f;  ///< impedance rho a, n
  std::vector<double> rho;  ///< density, n
};

/// Totals over the body of gas: sums over the control volumes, those of boundary points cut at the boundary.
struct Totals {
  /// [mass/depth], [momentum/depth] twice, [energy/depth], [momentum*length/depth]
  double mass = 0, momentum1 = 0, momentum2 = 0, energy = 0, angular_momentum = 0;
};

/// How well the numbers are.
struct Health {
  double min_rho = 0, min_p = 0;                 ///< [mass/volume], [pressure]
  double min_cell_quality = 1;                   ///< of the grids that move, grid::cell_quality [-]
  std::uint64_t first_order_fallbacks = 0;       ///< points advanced with first-order states, since the start
  std::uint64_t first_order_outside_shocks = 0;  ///< of these, those without a shock near them
  std::uint64_t positive_fluxes = 0;  ///< points advanced with positive first-order fluxes, since the start
  std::uint64_t positive_values = 0;  ///< interpolated points that got their smallest donor's value
  std::uint64_t bounded_side_points = 0;  ///< points of sides at which a bound acted
  std::uint64_t floors = 0;               ///< points whose pressure was lifted to the floor, since the start
};

/// Largest errors over all grid points; T = p / rho.
struct GasErrors {
  double rho = 0, v1 = 0, v2 = 0, T = 0;  ///< [mass/volume], [velocity], [velocity], [pressure*volume/mass]
};

/// One component grid and what holds on its sides, in the order left, right, bottom, top.
struct GasPart {
  grid::MovingGrid grid;
  std::array<Boundary, 4> boundaries;
};

class GasSolver {
 public:
  /// `parts` are the background, a rectangle at rest, and the body-fitted grids that `bodies` describe in
  /// their order; without bodies there is one part of any kind.
  /// @throws UserMistake where boundaries and grids do not fit or an option is out of range; Diverged
  /// where the grids do not overlap enough
  GasSolver(std::vector<GasPart> parts, std::vector<grid::BodyFittedGrid> bodies, const GasOptions& options,
            double t0);
  /// `boundaries` in the order left, right, bottom, top.
  /// @throws UserMistake where boundaries and grid do not fit or an option is out of range
  GasSolver(grid::MovingGrid grid, const GasOptions& options, std::array<Boundary, 4> boundaries, double t0);

  /// Makes a state an exact solution by source terms; initial and boundary data are to be given from it.
  /// Conditions that say zero, or n.v of a wall, then hold for
  /// the difference to it. Before the initial conditions.
  void force(const StateField& exact);
  /// Sets every valid point, ghosts included. @throws UserMistake
  /// at a density or pressure that is not positive
  void assign_initial_conditions(const StateField& initial);
  /// Works on the projected as on the predicted state. (44), (45)
  TimeStep compute_time_step() const;
  /// Moves the grids to t_new = t + dt; interface sides go where they are told. Points that were unused
  /// before get values of the present time.
  /// @throws Diverged at a folded cell, where a point finds no donor, and where two curves are nearer to
  /// each other than nearest_curves spacings of the background
  void move_grids(double t_new, double dt, std::span<const grid::SideCommand> commands = {});
  /// Predicted state at t, all points, boundary points included,
  /// without interface conditions; the grid was moved before.
  /// @throws Diverged at a density or pressure that is no longer a number or not positive
  void advance_fluid(double t, double dt);
  /// The gas along a side, for the projection.
  GasInterface interface_state(Side side, int grid = 0) const;
  /// Boundary conditions at t: boundary points, then ghosts. Every interface side needs its values.
  void apply_fluid_bcs(double t, std::span<const InterfaceValues> interfaces = {});

  Health health() const;
  Totals totals() const { return totals_without({}); }
  /// The same without the control volumes of the points on some sides of the background; of one with levels, without
  /// those of its coarsest level.
  Totals totals_without(const std::array<bool, 4>& sides) const;
  /// Whether gas may pass a side of the background: it is neither wall nor mirror.
  bool lets_pass(Side side) const;
  /// The background, or all its levels.
  std::vector<int> backgrounds() const;
  /// From now on each step notes what it carries through the faces half a cell, of the coarsest level, inside the
  /// background's sides.
  void note_edges();
  /// So many lines of a background lie between a side's line and these faces.
  int edge_lines(int background) const;
  /// Mass, momentum (2) and energy per area of a cell that the last step carried through these faces, towards higher
  /// indices; n points, component-major. The background must be a rectangle at rest.
  std::span<const double> edge(Side side, int background = 0) const {
    return component(background).edge(side);
  }
  double cell_area(int background = 0) const { return component(background).cell_area(); }
  /// Largest differences to a given solution at time t.
  GasErrors errors(const StateField& exact, double t) const;
  /// State at a position by bilinear interpolation; nothing where no grid covers it.
  std::optional<State> probe(double x, double y) const;

  /// Primitive state: planes rho, v1, v2, p.
  ConstFieldView state(int grid = 0) const { return component(grid).state(); }
  /// Conserved state: planes rho, rho v1, rho v2, rho E; ghosts included.
  Field conserved() const;
  const grid::MovingGrid& grid(int grid = 0) const { return component(grid).grid(); }
  /// Positions and state when the last step was complete, also after one that broke.
  ConstFieldView last_x(int grid = 0) const { return component(grid).last_x(); }
  ConstFieldView last_state(int grid = 0) const { return component(grid).last_state(); }
  /// Background, body-fitted grids, and the coarser levels of the background.
  int grids() const { return static_cast<int>(components_.size()); }
  /// The levels of the background; null where there is one only.
  const GasLevels* levels() const { return levels_ ? &*levels_ : nullptr; }
  /// Whether a grid is one of several levels.
  bool is_level(int grid) const { return levels_ && levels_->has(static_cast<std::size_t>(grid)); }
  /// Points of a grid that have a value.
  const grid::RowSets& valid(int grid = 0) const { return component(grid).valid(); }
  /// Points of a grid that are advanced.
  const grid::RowSets& discretised(int grid = 0) const { return component(grid).discretised(); }
  /// What the points of a grid are, row by row: 0 unused, 1 advanced, 2 interpolated.
  std::vector<std::uint8_t> kinds(int grid) const;
  /// How the grids overlap; null where there is one only.
  const grid::CompositeGrid* composite() const { return composite_ ? &*composite_ : nullptr; }
  const GasOptions& options() const { return options_; }
  /// Points that have a value, of all grids.
  std::size_t points() const;
  double time() const { return t_; }

  // Several ranks: each has a solver, all call the same functions with the same arguments, and what a function says
  // of state is known on rank 0, after the one of these that brings it there.

  /// From now on the ranks share the work out. The solver has its initial state, which all ranks have in full.
  void share(std::shared_ptr<Ranks> ranks, const RecutOptions& options);
  const Share& shared() const { return share_; }
  /// Time step, health and the state along interfaces. A single rank that has looked, looks no more until the state
  /// changes.
  void look();
  /// The state in some strips, and what the last step carried through the sides' faces.
  void fetch(std::span<const Strip> strips);
  /// The state at all points.
  void collect();
  /// Everything that archive saves, or that last_state shows.
  void collect_all();
  /// After archive has loaded a state on every rank: counters are rank 0's.
  void loaded();
  /// The cell that probe takes its values from.
  std::vector<Strip> probe_strips(double x, double y) const;

  /// Everything the next steps depend on, the grids included, under fixed names: to be written, or
  /// overwritten in place. How the grids overlap is found again from where they are.
  void archive(Archive& archive);

 private:
  GasOptions options_;
  std::vector<Component> components_;
  std::optional<grid::NearCurves> near_;  ///< where there are several curves
  std::optional<grid::CompositeGrid> composite_;
  std::optional<GasLevels> levels_;             ///< of the background, where there are several
  std::vector<FieldView> fields_;               ///< work memory: the state of each grid
  std::vector<InterfaceValues> interfaces_;     ///< work memory: those of one grid
  std::vector<grid::SideCommand> commands_;     ///< work memory: those of one grid
  std::vector<grid::GridPositions> positions_;  ///< work memory
  double t_;
  Share share_;
  std::vector<CutGrid> cut_grids_;  ///< work memory

  /// What look has found; on several ranks, what rank 0 has been told.
  struct Seen {
    FastestPoint fastest;
    int grid = 0;
    State state;
    Health health;
  };
  Seen seen_;
  bool looked_ = false;  ///< since the state changed last; on several ranks who asks knows it

  Seen seen_here() const;
  void see(std::span<const double> of_all, double cell_quality);
  void look_alone();
  void gather_edges();
  static Health nothing_seen();
  static void add_health(const Component& component, const Smallest& smallest, Health& health);
  void raise(Seen& seen, int k, const FastestPoint& here) const;
  std::vector<SweptPoints> sweep_grids(std::size_t first, std::size_t end, double t, double dt);
  void take_rows();
  void share_out_anew();
  void bring_advanced();
  std::span<const CutGrid> cut_grids();
  LevelScene level_scene() { return {components_, composite(), share_}; }
  std::vector<Strip> kept_strips() const;
  const Component& component(int grid) const { return components_[static_cast<std::size_t>(grid)]; }
  std::span<const FieldView> gather_fields();
  void connect_first(std::vector<grid::BodyFittedGrid> bodies);
  void add_levels(const std::array<Boundary, 4>& boundaries);
  std::vector<ConstFieldView> fitted_positions() const;
  std::vector<int> from_finest() const;
  void use_points();
  void leave_room_between_curves(double t_new, std::span<const grid::SideCommand> commands);
  void update_overlapping_grid(double t_new);
  void keep_interpolated_positive(std::span<const grid::InterpolationList> lists);
};

/// Adds the points along a side of a grid.
void add_side_strips(const Layout& layout, Side side, std::vector<Strip>& strips, int grid = 0);

}  // namespace fsi::fluid
