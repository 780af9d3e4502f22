#pragma once
/// The solid: a hyperelastic body on its reference configuration, advanced in time by an upwind scheme for
/// the first-order system of displacement, velocity and nominal stress (the paper's section 4.2).
///
///     SolidSolver solver(grid, law, options, boundaries, t0);       or   solver(parts, bodies, law, ...)
///     solver.assign_initial_conditions(u, v);
///     loop:  dt = solver.compute_time_step().dt
///            solver.advance_solid(t, dt)                  predicted state at t + dt
///            solver.apply_solid_bcs(t + dt, projected)    boundary points and ghosts at t + dt

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/field.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "solid_solver/any_solid_solver.hpp"
#include "solid_solver/composite.hpp"
#include "solid_solver/measures/body_integrals.hpp"
#include "solid_solver/solid_component.hpp"
#include "solid_solver/time_step.hpp"

namespace fsi::solid {

/// What is not said here is said of AnySolidSolver.
template <Law L>
class SolidSolver final : public AnySolidSolver {
 public:
  /// A body on one grid. @throws UserMistake where boundaries, grid and options do not fit together
  SolidSolver(grid::MovingGrid reference_grid, L law, SolidOptions options, Boundaries boundaries, double t0)
      : SolidSolver(one_part(std::move(reference_grid), std::move(boundaries)), {}, law, options, t0) {}

  /// A body on overlapping grids: parts[0] is the background, a rectangle along x and y, and parts[k] the
  /// body-fitted grid that bodies[k - 1] describes. A single part without bodies may have any shape.
  /// @throws UserMistake as above, and where the grids do not fit together
  SolidSolver(std::vector<SolidPart> parts, std::vector<grid::BodyFittedGrid> bodies, L law,
              SolidOptions options, double t0)
      : law_(law), options_(options), composite_(connected(parts, std::move(bodies))), t_(t0) {
    if (!(options_.rho > 0))
      throw UserMistake(fmt::format("rho = {:g}: the density must be positive", options_.rho));
    if (time_stepping_eigenvalue(1.0, options_).beta >= 2.0) {
      throw UserMistake(
          "the scaled parts of dissipation and relaxation must add up to less than 2 for the solid");
    }
    if (composite_) areas_ = areas_of(*composite_, parts);
    for (SolidPart& part : parts) {
      const int index = grids();
      components_.emplace_back(std::move(part), index, points_of(composite_, index, part.grid.layout()), law_,
                               options_);
      interpolate_first_ |= components_.back().boundary().sides().reads_interpolated_points();
    }
    views_.resize(components_.size());
  }

  void assign_initial_conditions(const VectorFunction& u, const VectorFunction& v) override {
    const StateFunction state = [&](double x, double y, double t) {
      return SolidState{.u = u(x, y, t), .v = v(x, y, t), .P = {}};
    };
    for (SolidComponent<L>& component : components_) {
      component.assign(state, t_);
      component.assign_stress();
    }
    start();
  }
  void assign_initial_conditions(const StateFunction& state) override {
    for (SolidComponent<L>& component : components_) component.assign(state, t_);
    start();
  }
  void set_body_force(const VectorFunction& force) override {
    for (SolidComponent<L>& component : components_) component.set_body_force(force);
  }
  void choose(const ChosenSolution& solution) override {
    for (SolidComponent<L>& component : components_) component.choose(solution);
  }

  TimeStep compute_time_step() const override {
    const SweepResult met = measured();
    const double waves = std::sqrt(met.rate_squared);
    const TimeSteppingEigenvalue lambda = time_stepping_eigenvalue(waves, options_);
    const double damping = -lambda.real + lambda.beta * waves;
    const double dt = options_.cfl * largest_time_step(lambda);
    const double decay = largest_decay_step({waves, 0.5 * (waves + std::sqrt(met.spread_squared))}, options_);
    if (decay < dt) return {.dt = decay, .reason = "upwinding and relaxation of the stress in the solid"};
    return {.dt = dt, .reason = waves > damping ? "waves in the solid" : "dissipation in the solid"};
  }
  void advance_solid(double t, double dt, Look look = Look::all) override {
    try {
      predict(t, dt, look);
    } catch (Diverged& failure) {
      for (SolidComponent<L>& component : components_) component.give_back();
      failure.know({.t = t});
      throw;
    }
    for (SolidComponent<L>& component : components_) component.complete(t, dt);
    ++steps_;
    t_ = t + dt;
    if (!alone()) early_.bring(states());
  }
  void interface_state(Side side, SolidInterface& state, int grid = 0) const override {
    gather_interface(component(grid), law_, {options_.rho, t_}, side, state);
  }
  Vec2 along_wall(Side side, int k, int grid = 0) const override {
    const Sides& sides = component(grid).boundary().sides();
    const Vec2 wall = wall_of(sides, side, k).value(), n0 = sides.at(side, k).n0;
    return (n0 - wall * wall.dot(n0)).normalized();
  }
  void apply_solid_bcs(double t, std::span<const InterfaceValues> projected = {}) override {
    if (interpolate_first_) interpolate(early_);
    together_.attempt([&] {
      for (SolidComponent<L>& component : components_) component.apply_boundary(t, projected);
    });
    together_.agree();
    if (composite_) {
      if (!alone()) late_.bring(states());
      interpolate(late_);
      for (SolidComponent<L>& component : components_) component.refresh_ghosts(t);
    }
    t_ = t;
  }

  Health health() const override {
    const SweepResult met = measured();
    Health health = {.min_det_F = met.min_det_F, .min_phi_s = met.min_phi_s};
    for (const SolidComponent<L>& component : components_) {
      health.settled += component.settled();
      health.waveless += component.waveless();
    }
    return health;
  }
  Totals totals() const override;
  Errors errors(const StateFunction& exact, double t) const override {
    Errors errors;
    for (const SolidComponent<L>& component : components_) add_errors(component, exact, t, errors);
    return errors;
  }
  SideLoad side_load(Side side, int grid = 0) const override { return load_on_side(component(grid), side); }
  Pose pose() const override;
  ProbePoint locate(double x, double y) const override;

  int grids() const override { return static_cast<int>(components_.size()); }
  const grid::CompositeGrid* composite() const override { return composite_ ? &*composite_ : nullptr; }
  ConstFieldView state(int grid = 0) const override { return component(grid).q(); }
  FieldView state(int grid = 0) { return components_[static_cast<std::size_t>(grid)].q(); }
  /// Reference positions of the points.
  ConstFieldView reference(int grid = 0) const { return component(grid).grid().x(); }
  const grid::MovingGrid& grid(int grid = 0) const override { return component(grid).grid(); }
  const Condition& condition(Side side, int grid = 0) const {
    return component(grid).boundary().sides().condition(side);
  }
  const grid::RowSets& valid(int grid = 0) const override { return component(grid).points().valid(); }
  std::size_t points() const override {
    std::size_t sum = 0;
    for (const SolidComponent<L>& component : components_) sum += component.points().count();
    return sum;
  }
  void archive(Archive& archive) override {
    for (std::size_t k = 0; k < components_.size(); ++k) {
      archive.inside(fmt::format("grid{}", k), [&] { components_[k].archive(archive); });
    }
    archive.number("t", t_);
    archive.number("steps", steps_);
  }
  std::uint64_t steps() const { return steps_; }
  double t() const override { return t_; }

  // Several ranks that share the body

  void share(std::shared_ptr<Ranks> ranks, const RecutOptions& options) override;
  bool alone() const { return early_.alone(); }
  const Share& shared() const override { return early_; }
  bool shows(Side side, int grid) const override {
    return early_.ranks().first() || component(grid).boundary().sides().present(side);
  }
  Together& together() override { return together_; }
  void fetch(std::vector<Strip> strips) override;
  void collect() override;
  void collect_all() override;
  void loaded() override;

 private:
  static std::vector<SolidPart> one_part(grid::MovingGrid grid, Boundaries boundaries) {
    std::vector<SolidPart> parts;
    parts.push_back({std::move(grid), std::move(boundaries)});
    return parts;
  }
  const SolidComponent<L>& component(int grid) const { return components_[static_cast<std::size_t>(grid)]; }
  SweepResult measured() const {
    SweepResult all;
    for (const SolidComponent<L>& component : components_) all.add(component.measured());
    return all;
  }
  std::span<const FieldView> states() {
    for (std::size_t k = 0; k < views_.size(); ++k) views_[k] = components_[k].q();
    return views_;
  }
  void interpolate(const Share& share) {
    if (composite_) composite_->interpolate(states(), share.mine(composite_->interpolation()));
  }
  void predict(double t, double dt, Look look);
  void predict_on_ranks(double t, double dt, Look look);
  void agree_on_prediction(std::size_t first, double dt);
  static Diverged breakdown(const SolidComponent<L>& component, double dt);
  std::vector<CutGrid> cut_grids(int halo) const;
  std::vector<Need> lines_of_interfaces() const;
  void take_rows();
  void share_out_anew();
  void gather_scattered();
  Pose pose_on_ranks(std::span<const PosePart> parts) const;
  void start() {
    interpolate(early_);
    apply_solid_bcs(t_);
    for (SolidComponent<L>& component : components_) component.measure();
  }

  L law_;
  SolidOptions options_;
  std::optional<grid::CompositeGrid> composite_;
  std::vector<Field> areas_;  ///< of the points of a composite grid
  std::deque<SolidComponent<L>> components_;
  /// What is brought of a prediction: halos, interface sides, donors where conditions need them; and after the
  /// conditions: donors.
  Share early_, late_;
  Together together_{early_.ranks()};
  int recut_every_ = 0;  ///< tests: other rows for everybody after so many steps
  /// What a grid's last sweep found before the present one.
  struct Found {
    SweepResult measured;
    double settled;
  };
  std::vector<Found> found_;        ///< of the grids predicted so far
  std::vector<FieldView> views_;    ///< work memory
  bool interpolate_first_ = false;  ///< boundary conditions read interpolated points
  double t_;
  std::uint64_t steps_ = 0;
};

template <Law L>
Totals SolidSolver<L>::totals() const {
  std::vector<Field> psi;
  std::vector<FieldView> views;
  for (const SolidComponent<L>& component : components_) {
    psi.push_back(strain_energy_density(component, law_));
    views.push_back(psi.back().view());
  }
  Totals totals;
  if (!composite_) {
    const Field areas = trapezoidal_areas(component(0));
    add_totals(component(0), {areas.view(), psi[0].view()}, options_.rho, totals);
    return totals;
  }
  composite_->interpolate(views);
  for (std::size_t k = 0; k < areas_.size(); ++k) {
    add_totals(components_[k], {areas_[k].view(), psi[k].view()}, options_.rho, totals);
  }
  return totals;
}

template <Law L>
ProbePoint SolidSolver<L>::locate(double x, double y) const {
  for (int k = 1; k <= grids(); ++k) {
    const int grid = k % grids();
    if (auto found = locate_probe(reference(grid), component(grid).points(), x, y)) {
      found->grid = grid;
      return *found;
    }
  }
  throw UserMistake(
      fmt::format("probe at ({:g}, {:g}) lies outside the reference grid \"{}\"", x, y, grid().name()));
}

}  // namespace fsi::solid
