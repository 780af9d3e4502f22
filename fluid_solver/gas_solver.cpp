#include "fluid_solver/gas_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/failure.hpp"
#include "fluid_solver/boundary_conditions.hpp"
#include "fluid_solver/side_points.hpp"
#include "fluid_solver/time_step.hpp"

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
    const bool lower = std::holds_alternative<Periodic>(boundaries[first]);
    const bool upper = std::holds_alternative<Periodic>(boundaries[first + 1]);
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

}  // namespace

GasSolver::GasSolver(grid::MovingGrid grid, const GasOptions& options, std::array<Boundary, 4> boundaries,
                     double t0)
    : options_(checked(options)), component_(std::move(grid), options, std::move(boundaries)), t_(t0) {
  std::array<Boundary, 4> given;
  for (const Side side : all_sides) given[static_cast<std::size_t>(side)] = component_.boundary(side);
  check_periods(component_.grid(), given);
}

void GasSolver::assign_initial_conditions(const StateField& initial) {
  component_.fill(initial, t_);
  mirror_ghosts(component_);
}

TimeStep GasSolver::compute_time_step() const {
  const FastestPoint fastest = component_.fastest_point();
  const ConstFieldView q = component_.state(), x = component_.grid().x();
  const int i = fastest.i, j = fastest.j;
  const double a = std::sqrt(options_.gamma * q(3, i, j) / q(0, i, j));
  return {.dt = options_.cfl / fastest.rate,
          .reason = fmt::format(
              "gas: grid \"{}\", point ({}, {}) at ({:.4g}, {:.4g}), |v| = {:.3g}, a = {:.3g}",
              component_.grid().name(), i, j, x(0, i, j), x(1, i, j), std::hypot(q(1, i, j), q(2, i, j)), a)};
}

void GasSolver::move_grids(double t_new, double dt, std::span<const grid::SideCommand> commands) {
  if (!component_.grid().moves()) return;
  component_.move(t_new, dt, commands);
}

void GasSolver::advance_fluid(double t, double dt) {
  component_.advance(t, dt);
  t_ = t;
}

GasInterface GasSolver::interface_state(Side side) const {
  const ConstFieldView q = component_.state(), x = component_.grid().x();
  const SidePoints points(component_.grid().layout(), side);
  const auto n = static_cast<std::size_t>(points.n());
  GasInterface gas{std::vector<double>(2 * n), std::vector<double>(2 * n), std::vector<double>(n),
                   std::vector<double>(n)};
  for (std::size_t k = 0; k < n; ++k) {
    const auto [i, j] = points.at(static_cast<int>(k), 0);
    gas.x[k] = x(0, i, j);
    gas.x[n + k] = x(1, i, j);
    gas.v[k] = q(1, i, j);
    gas.v[n + k] = q(2, i, j);
    gas.p[k] = q(3, i, j);
    gas.z_f[k] = std::sqrt(options_.gamma * q(3, i, j) * q(0, i, j));
  }
  return gas;
}

void GasSolver::apply_fluid_bcs(double t, std::span<const InterfaceValues> interfaces) {
  apply_boundary_conditions(component_, {.t = t, .options = options_, .interfaces = interfaces});
}

std::vector<CheckpointArray> GasSolver::checkpoint_arrays() {
  std::vector<CheckpointArray> arrays = component_.checkpoint_arrays();
  arrays.push_back({"t", {&t_, 1}});
  return arrays;
}

}  // namespace fsi::fluid
