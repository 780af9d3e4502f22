#pragma once
/// One component grid of the gas domain with everything that belongs to it.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/intervals.hpp"
#include "common/grid/moving_grid.hpp"
#include "common/ranks/rows/cut.hpp"
#include "common/ranks/rows/rank_rows.hpp"
#include "fluid_solver/boundary/every_boundary.hpp"
#include "fluid_solver/boundary/interface.hpp"
#include "fluid_solver/boundary/wall_motion.hpp"
#include "fluid_solver/forcing.hpp"
#include "fluid_solver/gas_options.hpp"
#include "fluid_solver/kernels/sweep.hpp"
#include "fluid_solver/measures/shocks.hpp"

namespace fsi::fluid {

/// Largest of a rate over the grid, and where.
struct FastestPoint {
  double rate = 0;  ///< [1/time]
  int i = 0, j = 0;
  int look =
      0;  ///< number of the look over the grid that found it: of equal rates, that of the first one counts
};

/// What the fastest point of a grid is chosen from.
struct FastestPoints {
  FastestPoint inner;    ///< of the inner points, in the row whose rates were largest when it was swept
  double row_rate = -1;  ///< the largest of them then [1/time]; below 0: the row was not chosen so
  FastestPoint rest;
  const FastestPoint& point() const { return rest.rate > inner.rate ? rest : inner; }
};

/// Of all points with a value.
struct Smallest {
  double rho = std::numeric_limits<double>::infinity();  ///< [mass/volume]
  double p = std::numeric_limits<double>::infinity();    ///< [pressure]
};

/// What a look at all points of a grid finds.
struct Extremes {
  FastestPoints fastest;
  Smallest smallest;
};

/// What a sweep left to be done, in the order of its weight: nothing; points that fell back to first order, which other
/// ranks must judge as well; thin points.
enum class SweptPoints { sound, to_be_judged, thin };

/// Counted since the start.
struct Counters {
  double first_order = 0;                 ///< points advanced with first-order states [-]
  double first_order_outside_shocks = 0;  ///< of these, those without a shock near them [-]
  double positive_fluxes = 0;             ///< points advanced with positive first-order fluxes [-]
  double positive_values = 0;             ///< interpolated points that got their smallest donor's value [-]
  double bounded_side_points = 0;         ///< points of sides at which a bound acted [-]
  double floors = 0;                      ///< points whose pressure was lifted to the floor [-]
  double steps = 0;                       ///< [-]
};

class Component {
 public:
  /// All points are advanced and valid.
  Component(grid::MovingGrid grid, const GasOptions& options, std::array<Boundary, 4> boundaries);

  /// From now on the source terms of an exact state act, and
  /// conditions on the sides hold for the difference to it.
  void force(const StateField& exact, const Forcing::Scales& scales);
  const Forcing* forcing() const { return forcing_ ? &*forcing_ : nullptr; }
  /// From now on only these points are advanced, and only these have a value.
  void use_points(const grid::RowSets& discretised, const grid::RowSets& valid);
  /// From now on conditions on the sides are kept up, and states kept, near valid points only. The background of
  /// body-fitted grids alone does without, as it always did.
  void become_sparse() {
    sparse_ = true;
    find_live_points();
  }
  /// Forgets the states far from valid points, and gives their memory back.
  void forget_unused_points();
  /// Adds the runs of points of a sparse grid that are kept.
  void add_kept_strips(std::vector<Strip>& strips, int grid) const;
  /// Which points of a side are near valid ones; empty: all count.
  std::span<const std::uint8_t> live(Side side) const { return live_[static_cast<std::size_t>(side)]; }
  /// From now on only rows of one's own are advanced, and only those one has are worth looking at.
  void take_rows(RankRows rows);
  const RankRows& rows() const { return rows_; }
  /// What moves with a row when it gets another owner.
  std::vector<FieldView> moving_fields();
  const grid::RowSets& discretised() const { return discretised_; }
  const grid::RowSets& valid() const { return valid_; }

  const grid::MovingGrid& grid() const { return grid_; }
  /// Primitive state: planes rho, v1, v2, p.
  ConstFieldView state() const { return state_.view(); }
  FieldView state() { return state_.view(); }
  /// The state before, where the next one will be written.
  FieldView spare_state() { return next_.view(); }
  const Boundary& boundary(Side side) const { return boundaries_[static_cast<std::size_t>(side)]; }
  /// What that tells others.
  const GasBoundaryFacts& facts(Side side) const { return facts_of(boundary(side)); }
  const WallMotion& wall(Side side) const { return walls_[static_cast<std::size_t>(side)]; }
  const Counters& counters() const { return counters_; }
  /// Of points that are not advanced by the sweep but interpolated.
  void count_positive_values(std::size_t points) { counters_.positive_values += static_cast<double>(points); }
  /// Of points that a side gives its values or its ghosts.
  void count_bounded_side_points(std::uint64_t points) {
    counters_.bounded_side_points += static_cast<double>(points);
  }
  /// From now on each step notes what it carries through the faces half a cell and so many lines inside the sides.
  void note_edges(int lines);
  /// Of the last step through the faces inside a side; see EdgeFluxes. Empty where they are not noted.
  std::span<const double> edge(Side side) const { return edges_[static_cast<std::size_t>(side)]; }
  /// Faces whose fluxes each step keeps, and those whose fluxes are given to it; see GasLevels.
  FaceFluxes& noted() { return noted_; }
  FaceFluxes& imposed() { return imposed_; }
  /// Of a side, by those who own its rows.
  std::span<double> edge(Side side) { return edges_[static_cast<std::size_t>(side)]; }
  /// Area of a cell of a Cartesian grid.
  double cell_area() const { return spacing_->dx * spacing_->dy; }
  /// True on a rectangular grid at rest with equal spacings along the axes.
  bool cartesian() const { return spacing_.has_value(); }

  /// Sets every valid point and its ghosts; points without a value get one of their neighbours'.
  /// @throws UserMistake at a density or pressure that is not positive
  void fill(const StateField& initial, double t);
  /// Measures wave rates and the motion of the sides from the initial state.
  void start(double t);
  /// The wave rates of a state that was not reached by a step.
  void measure_rows();
  /// From the next move on; see MovingGrid::leave_part.
  void leave_part(std::span<const double> part) { grid_.leave_part(part); }
  void move(double t_new, double dt, std::span<const grid::SideCommand> commands);
  /// A step is a sweep, or several if fluxes are imposed that were not known before, and its end. What a sweep says, the
  /// largest of all ranks, is to be handed to the end.
  SweptPoints sweep(double t, double dt);
  /// state() becomes the predicted state at t, with ghosts out of date. @throws Diverged
  void end_step(SweptPoints worst, double t, double dt);
  /// True where the wave rates of a row depend on the new state in the rows next to it.
  bool rates_need_neighbours() const { return scheme_.viscosity.any(); }
  /// Largest |Lambda| of (44), real part weighted as in (45). In rows of one's own, as the next two.
  FastestPoints fastest_points() const;
  Smallest smallest() const;
  /// Both, with one look.
  Extremes extremes() const;
  /// Boundary conditions hold: the step is complete.
  void complete() { moved_ = advanced_ = false; }
  /// Positions and state when the last step was complete, also after one that broke.
  ConstFieldView last_x() const { return moved_ ? grid_.x_old() : grid_.x(); }
  ConstFieldView last_state() const { return advanced_ ? next_.view() : state_.view(); }
  /// Everything the next steps depend on.
  void archive(Archive& archive);
  /// What is spread over the ranks, for rank 0 to put together: largest rates of rows, counters.
  std::vector<double> scattered() const;
  void gather_scattered(std::span<const double> all_ranks);
  /// What others count is counted by them.
  void forget_counters() { counters_ = {}; }

 private:
  grid::MovingGrid grid_;
  std::array<Boundary, 4> boundaries_;
  std::optional<Spacing> spacing_;
  Scheme scheme_;
  Field state_, next_;
  grid::RowSets discretised_, valid_;
  bool sparse_ = false;
  std::array<std::vector<std::uint8_t>, 4> live_;
  RankRows rows_;
  SweepRuns runs_;
  std::vector<std::vector<Range>> row_runs_;  ///< work memory
  mutable Workspace workspace_;               ///< scratch, no part of the state
  std::array<WallMotion, 4> walls_;
  std::vector<double> row_rates_;  ///< largest wave rate of each row's inner points, kept from the sweep
  double last_dt_ = 0;             ///< of the last motion
  double dt_before_ = 0;           ///< of the motion before
  bool prescribed_ = false;        ///< the grid's motion is known beforehand
  bool moved_ = false, swept_ = false, advanced_ = false;  ///< in the step going on
  Counters counters_;
  std::array<std::vector<double>, 4> edges_;
  int edge_lines_ = 0;
  FaceFluxes noted_, imposed_;
  std::vector<PointIndex> fallbacks_;      ///< work memory: points of one sweep
  std::vector<PointIndex> far_fallbacks_;  ///< of these, those that other ranks must judge as well
  std::optional<Forcing> forcing_;
  Field source_;             ///< of the forcing, at the time and on the grid of the state
  bool has_source_ = false;  ///< it was evaluated

  StepGrid step_grid() const { return {grid_.x_old(), grid_.x(), spacing_}; }
  void gather_runs();
  void find_live_points();
  void archive_states(Archive& archive);
  double fill_row(int j, const StateField& initial, double t);
  void measure_initial_motion(double t, double delta);
  /// 1 / dt of (45) at the points of a row, in the workspace.
  double* step_rates(int j, Range range) const;
  void compare(FastestPoint& fastest, int look, int j, Range part) const;
  FastestPoints fastest_by_rows() const;
  void lower(Smallest& smallest, int j) const;
  void add_source(double t, double dt);
  SweepTask sweep_task(const StepGrid& grid, double dt);
  SweepOutput sweep_output();
  ShockField shock_field() const;
  void forget_edges_of_others();
  void count_fallbacks();
  void count_far_fallbacks();
  /// @returns the rows that were changed
  std::vector<int> keep_positive(const SweepTask& task, const SweepOutput& output);
  void measure_row(int j);
  /// @throws Diverged at a point without positive density or finite pressure
  void check_numbers(double t) const;
};

}  // namespace fsi::fluid
