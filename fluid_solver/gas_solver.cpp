#include "fluid_solver/gas_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/failure.hpp"
#include "fluid_solver/boundary/boundary_conditions.hpp"
#include "fluid_solver/boundary/side_points.hpp"
#include "fluid_solver/positivity.hpp"

namespace fsi::fluid {

namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw UserMistake(what);
}

void check_options(const GasOptions& options) {
  require(options.gamma > 1, fmt::format("fluid: gamma = {} must be greater than 1", options.gamma));
  require(options.cfl > 0 && options.cfl <= 1,
          fmt::format("fluid: cfl = {} must lie in (0, 1]", options.cfl));
  require(options.entropy_fix >= 0 && options.entropy_fix <= 1,
          fmt::format("fluid: entropy_fix = {} must lie in [0, 1]", options.entropy_fix));
  require(options.shock_viscosity >= 0,
          fmt::format("fluid: shock_viscosity = {} must not be negative", options.shock_viscosity));
  require(options.linear_diffusion >= 0,
          fmt::format("fluid: linear_diffusion = {} must not be negative", options.linear_diffusion));
}

void check_periods(const grid::MovingGrid& grid, const std::array<Boundary, 4>& boundaries) {
  for (const int direction : {0, 1}) {
    const auto first = static_cast<std::size_t>(2 * direction);
    const bool lower = facts_of(boundaries[first]).beyond == Beyond::period;
    const bool upper = facts_of(boundaries[first + 1]).beyond == Beyond::period;
    require(
        lower == upper && lower == grid.periodic(direction),
        fmt::format(
            "grid \"{}\": the boundaries {} and {} must both be periodic, and the grid too, or none of them",
            grid.name(), name_of(all_sides[first]), name_of(all_sides[first + 1])));
  }
}

GasOptions checked(const GasOptions& options) {
  check_options(options);
  return options;
}

std::vector<GasPart> one_part(grid::MovingGrid grid, std::array<Boundary, 4> boundaries) {
  std::vector<GasPart> parts;
  parts.push_back({std::move(grid), std::move(boundaries)});
  return parts;
}

}  // namespace

GasSolver::GasSolver(grid::MovingGrid grid, const GasOptions& options, std::array<Boundary, 4> boundaries,
                     double t0)
    : GasSolver(one_part(std::move(grid), std::move(boundaries)), {}, options, t0) {}

GasSolver::GasSolver(std::vector<GasPart> parts, std::vector<grid::BodyFittedGrid> bodies,
                     const GasOptions& options, double t0)
    : options_(checked(options)), t_(t0) {
  require(parts.size() == bodies.size() + 1,
          fmt::format("gas: {} grids for {} curves; write one background and a grid for each curve",
                      parts.size(), bodies.size()));
  if (bodies.size() > 1) {
    std::vector<grid::MovingGrid*> curved;
    for (std::size_t k = 1; k < parts.size(); ++k) curved.push_back(&parts[k].grid);
    near_ = leave_room(curved, bodies, t0);
  }
  components_.reserve(parts.size() + static_cast<std::size_t>(options_.refine.levels));
  const std::array<Boundary, 4> outer = parts.front().boundaries;
  for (GasPart& part : parts) {
    check_periods(part.grid, part.boundaries);
    components_.emplace_back(std::move(part.grid), options_, std::move(part.boundaries));
  }
  if (!bodies.empty()) connect_first(std::move(bodies));
  add_levels(outer);
}

void GasSolver::connect_first(std::vector<grid::BodyFittedGrid> bodies) {
  require(components_.front().cartesian(),
          fmt::format("grid \"{}\": the background of body-fitted grids must "
                      "be a rectangle at rest",
                      components_.front().grid().name()));
  composite_.emplace(grid::background_of(components_.front().grid()), std::move(bodies));
  composite_->connect(fitted_positions(), t_);
  use_points();
}

/// Behind the other grids, so that these keep their numbers.
void GasSolver::add_levels(const std::array<Boundary, 4>& boundaries) {
  if (options_.refine.levels < 2) return;
  levels_.emplace(components_.front(), options_.refine, components_.size(), options_.gamma);
  for (grid::MovingGrid& grid : levels_->coarse_grids(components_.front()))
    components_.emplace_back(std::move(grid), options_, boundaries);
  for (int l = 0; l < levels_->levels(); ++l) components_[levels_->component(l)].become_sparse();
}

/// Of the body-fitted grids.
std::vector<ConstFieldView> GasSolver::fitted_positions() const {
  std::vector<ConstFieldView> x;
  for (int k = 1; k < composite_->grids(); ++k) x.push_back(grid(k).x());
  return x;
}

/// Of the background only what its finest level has.
void GasSolver::use_points() {
  if (levels_) levels_->use_finest_points(components_.front(), composite());
  for (int grid = levels_ ? 1 : 0; grid < composite_->grids(); ++grid) {
    components_[static_cast<std::size_t>(grid)].use_points(composite_->discretised(grid),
                                                           composite_->valid(grid));
  }
}

std::span<const FieldView> GasSolver::gather_fields() {
  fields_.clear();
  for (Component& component : components_) fields_.push_back(component.state());
  return fields_;
}

void GasSolver::force(const StateField& exact) {
  const ConstFieldView x = components_.front().grid().x();
  const int i = x.layout.n1 - 1, j = x.layout.n2 - 1;
  double size = 0;
  for (int c = 0; c < 2; ++c) {
    const auto [low, high] = std::minmax({x(c, 0, 0), x(c, i, 0), x(c, 0, j), x(c, i, j)});
    size = std::max(size, high - low);
  }
  const State q = exact(x(0, 0, 0), x(1, 0, 0), t_);
  const double speed = std::sqrt(q.v1 * q.v1 + q.v2 * q.v2) + std::sqrt(options_.gamma * q.p / q.rho);
  for (Component& component : components_) component.force(exact, {.length = size, .time = size / speed});
}

void GasSolver::assign_initial_conditions(const StateField& initial) {
  looked_ = false;
  for (Component& component : components_) {
    component.fill(initial, t_);
    mirror_ghosts(component, t_);
  }
  if (levels_) levels_->start(level_scene());
  for (Component& component : components_) component.start(t_);
}

TimeStep GasSolver::compute_time_step() const {
  const auto [fastest, at, q, health] = share_.alone() && !looked_ ? seen_here() : seen_;
  const grid::MovingGrid& slowest = grid(at);
  const int i = fastest.i, j = fastest.j;
  const double a = std::sqrt(options_.gamma * q.p / q.rho);
  return {.dt = options_.cfl / fastest.rate,
          .reason = fmt::format(
              "gas: grid \"{}\", point ({}, {}) at ({:.6g}, {:.6g}), |v| = {:.3g}, a = {:.3g}",
              slowest.name(), i, j, slowest.x()(0, i, j), slowest.x()(1, i, j), std::hypot(q.v1, q.v2), a)};
}

/// In rows of one's own; without health.
GasSolver::Seen GasSolver::seen_here() const {
  Seen seen;
  for (int k = 0; k < grids(); ++k) raise(seen, k, component(k).fastest_points().point());
  return seen;
}

/// The fastest point of grid k joins those of the grids before.
void GasSolver::raise(Seen& seen, int k, const FastestPoint& here) const {
  if (k > 0 && here.rate <= seen.fastest.rate) return;
  const ConstFieldView q = state(k);
  seen.fastest = here;
  seen.grid = k;
  seen.state = {.rho = q(0, here.i, here.j),
                .v1 = q(1, here.i, here.j),
                .v2 = q(2, here.i, here.j),
                .p = q(3, here.i, here.j)};
}

void GasSolver::move_grids(double t_new, double dt, std::span<const grid::SideCommand> commands) {
  bool moved = false;
  looked_ = false;
  share_out_anew();
  if (near_) leave_room_between_curves(t_new, commands);
  for (std::size_t k = 0; k < components_.size(); ++k) {
    Component& component = components_[k];
    if (!component.grid().moves()) continue;
    commands_.clear();
    for (const grid::SideCommand& command : commands) {
      if (command.grid == static_cast<int>(k)) commands_.push_back(command);
    }
    component.move(t_new, dt, commands_);
    moved = true;
  }
  if (composite_ && moved) update_overlapping_grid(t_new);
}

void GasSolver::leave_room_between_curves(double t_new, std::span<const grid::SideCommand> commands) {
  for (const grid::SideCommand& command : commands) {
    if (command.grid > 0) near_->place(static_cast<std::size_t>(command.grid) - 1, command.x);
  }
  near_->measure();
  report_too_near(*near_, *composite_, t_new);
  for (std::size_t k = 1; k < components_.size(); ++k) components_[k].leave_part(near_->part(k - 1));
}

void GasSolver::update_overlapping_grid(double t_new) {
  positions_.clear();
  for (int k = 1; k < composite_->grids(); ++k) positions_.push_back({grid(k).x(), grid(k).x_old()});
  composite_->update(positions_, t_new);
  use_points();
  share_.plan(cut_grids(), &*composite_);
  share_.plan_exposed(*composite_);
  share_.bring_exposed(gather_fields());
  const std::span<const grid::InterpolationList> exposed = share_.mine_exposed(composite_->exposed());
  composite_->fill_exposed(gather_fields(), exposed);
  keep_interpolated_positive(exposed);
}

/// Ranks wait for each other once for all grids. Only where a grid has thin points, and other fluxes through its rim
/// then, what comes after it is swept again.
void GasSolver::advance_fluid(double t, double dt) {
  looked_ = false;
  const std::size_t all = components_.size();
  for (std::size_t first = 0; first < all;) {
    const std::size_t end = share_.alone() ? first + 1 : all;
    const std::vector<SweptPoints> worst = sweep_grids(first, end, t, dt);
    for (bool thin = false; first < end && !thin; ++first) {
      thin = worst[first] == SweptPoints::thin;
      components_[first].end_step(worst[first], t, dt);
    }
  }
  t_ = t;
}

/// @returns what is to be done for each grid, anywhere
std::vector<SweptPoints> GasSolver::sweep_grids(std::size_t first, std::size_t end, double t, double dt) {
  std::vector<double> worst(components_.size(), 0);
  for (std::size_t k = first; k < end; ++k) {
    // Finer levels first: what crosses their rims is theirs to say.
    if (levels_ && k >= levels_->component(1)) levels_->match(level_scene(), levels_->level_of(k));
    worst[k] = static_cast<double>(components_[k].sweep(t, dt));
  }
  share_.ranks().largest_of_each(worst);
  std::vector<SweptPoints> of_all(worst.size());
  std::ranges::transform(worst, of_all.begin(),
                         [](double weight) { return static_cast<SweptPoints>(static_cast<int>(weight)); });
  return of_all;
}

void GasSolver::keep_interpolated_positive(std::span<const grid::InterpolationList> lists) {
  for (const grid::InterpolationList& list : lists) {
    Component& target = components_[static_cast<std::size_t>(list.target_grid)];
    target.count_positive_values(keep_positive(list, fields_, target.rows()));
  }
}

GasInterface GasSolver::interface_state(Side side, int grid) const {
  const ConstFieldView q = state(grid), x = this->grid(grid).x();
  const SidePoints points(q.layout, side);
  const auto n = static_cast<std::size_t>(points.n());
  GasInterface gas{std::vector<double>(2 * n), std::vector<double>(2 * n), std::vector<double>(n),
                   std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t k = 0; k < n; ++k) {
    const auto [i, j] = points.at(static_cast<int>(k), 0);
    gas.x[k] = x(0, i, j);
    gas.x[n + k] = x(1, i, j);
    gas.v[k] = q(1, i, j);
    gas.v[n + k] = q(2, i, j);
    gas.p[k] = q(3, i, j);
    gas.rho[k] = q(0, i, j);
    gas.z_f[k] = std::sqrt(options_.gamma * q(3, i, j) * q(0, i, j));
  }
  return gas;
}

void GasSolver::apply_fluid_bcs(double t, std::span<const InterfaceValues> interfaces) {
  looked_ = false;
  const auto each = [&](const auto& action) {
    for (std::size_t k = 0; k < components_.size(); ++k) {
      interfaces_.clear();
      for (const InterfaceValues& values : interfaces) {
        if (values.grid == static_cast<int>(k)) interfaces_.push_back(values);
      }
      action(components_[k], BoundaryTask{.t = t, .options = options_, .interfaces = interfaces_});
    }
  };
  each([](Component& component, const BoundaryTask& task) { set_boundary_points(component, task); });
  const BoundaryTask background{.t = t, .options = options_, .interfaces = {}};
  if (levels_) levels_->average(level_scene());
  bring_advanced();
  if (levels_) levels_->surround(level_scene(), background);
  if (composite_) {
    const std::span<const grid::InterpolationList> lists = share_.mine(composite_->interpolation());
    composite_->interpolate(gather_fields(), lists);
    keep_interpolated_positive(lists);
  }
  each([&](Component& component, const BoundaryTask& task) {
    if (!levels_ || !levels_->is_coarse(component, components_)) set_ghosts(component, task);
  });
  for (Component& component : components_) component.complete();
  if (levels_ && levels_->adapt(level_scene(), background)) share_.plan(cut_grids(), composite());
}

std::size_t GasSolver::points() const {
  std::size_t points = 0;
  for (const Component& component : components_) points += component.valid().points();
  return points;
}

void GasSolver::archive(Archive& archive) {
  for (std::size_t k = 0; k < components_.size(); ++k) {
    archive.inside(fmt::format("grid{}", k), [&] { components_[k].archive(archive); });
  }
  archive.number("t", t_);
  if (composite_) archive.inside("overlap", [&] { composite_->archive(archive); });
  if (levels_) archive.inside("levels", [&] { levels_->archive(archive); });
  if (!archive.loading()) return;
  looked_ = false;
  if (composite_) composite_->connect(fitted_positions(), t_);
  if (levels_) levels_->restore(level_scene());
  if (composite_) use_points();
}

}  // namespace fsi::fluid
