#include "fluid_solver/program/from_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/case/grids/composite_from_case.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/core/failure.hpp"
#include "common/program/grid_from_case.hpp"

namespace fsi::fluid {

namespace {

StateField field_of(const GasExpressions& state) {
  return [state](double x, double y, double t) {
    return State{
        .rho = state.rho(x, y, t), .v1 = state.v1(x, y, t), .v2 = state.v2(x, y, t), .p = state.p(x, y, t)};
  };
}

/// Data given by formulas, or by the reference solution.
StateField data_of(bool from_reference, const std::optional<GasExpressions>& formulas,
                   const std::shared_ptr<const exact::Solution>& reference, const std::string& what) {
  if (from_reference && reference) return fluid::field_of(reference);
  if (!from_reference && formulas) return field_of(*formulas);
  throw UserMistake(
      fmt::format("{} has no data; write a state {{rho: .., v: [.., ..], p: ..}} or a reference", what));
}

/// Data of a side that are looked at whenever they are taken: what is no gas does not come in as one, at places and times at
/// which `check` did not look.
StateField looked_at(StateField given, std::string path) {
  return [given = std::move(given), path = std::move(path)](double x, double y, double t) {
    const State q = given(x, y, t);
    if (q.rho > 0 && q.p > 0 && std::isfinite(q.rho + q.p + q.v1 + q.v2)) return q;
    throw Failure(
        ExitCode::user_mistake,
        fmt::format("{}: rho = {:.4g}, v = ({:.4g}, {:.4g}), p = {:.4g} are no state of a gas; let them "
                    "be finite, rho and p > 0, until time.end",
                    path, q.rho, q.v1, q.v2, q.p),
        {.t = t, .grid = {}, .position = {x, y}});
  };
}

Boundary boundary_of(const BoundarySpec& spec, const std::string& path,
                     const std::shared_ptr<const exact::Solution>& reference) {
  BoundaryData data{.numbers = spec.numbers};
  if (std::ranges::any_of(schema::gas_boundary(spec.kind).keys, schema::takes_reference))
    data.state = looked_at(data_of(spec.from_reference, spec.state, reference, path), path);
  for (const auto& [key, field] : spec.fields)
    data.fields[key] = [given = field](double x, double y, double t) { return given(x, y, t); };
  std::optional<Boundary> boundary = boundary_from(spec.kind, data);
  if (!boundary) throw UserMistake(fmt::format("{} has a condition for solids", path));
  return *std::move(boundary);
}

GasOptions options_of(const Case& problem, const FluidSpec& spec) {
  const GasScheme& scheme = spec.scheme;
  const RefineSpec& refine = spec.refine;
  return {.gamma = spec.gamma,
          .p_e = spec.p_e,
          .riemann = scheme.riemann,
          .limiter = scheme.limiter,
          .entropy_fix = scheme.entropy_fix,
          .shock_viscosity = scheme.shock_viscosity.value_or(0),
          .linear_diffusion = scheme.linear_diffusion,
          .wave_curve = problem.interface.riemann == GasResponse::exact,
          .refine = {refine.levels, refine.variable, refine.threshold, refine.buffer, refine.every},
          .cfl = problem.time.cfl};
}

/// Where the case file gives what holds on the sides of a grid.
using SidePaths = std::array<std::string, 4>;

SidePaths paths_of_sides(const FluidSpec& spec) {
  SidePaths paths;
  for (const Side side : all_sides)
    paths[static_cast<std::size_t>(side)] = fmt::format("{}.boundary.{}", spec.path, name_of(side));
  return paths;
}

/// Of the k-th grid fitted to a curve: its own on the curve, and at the ends that of the wall on which they stand.
SidePaths paths_of_fitted(const FluidSpec& spec, std::size_t k) {
  const auto path_of_curve = [&](std::size_t grid) {
    return fmt::format("{}.body_fitted[{}].boundary", spec.path, grid);
  };
  SidePaths paths;
  paths.fill(path_of_curve(k));
  const CurveSpec& curve = spec.body_fitted[k].curve;
  if (!curve.walls) return paths;
  const auto wall = std::ranges::find(spec.body_fitted, curve.on, &BodyFittedSpec::name);
  const bool on_side = wall == spec.body_fitted.end();
  const SidePaths sides = paths_of_sides(spec);
  for (const Side end : {Side::left, Side::right}) {
    const auto e = static_cast<std::size_t>(end);
    paths[e] = on_side ? sides[static_cast<std::size_t>((*curve.walls)[e])]
                       : path_of_curve(static_cast<std::size_t>(wall - spec.body_fitted.begin()));
  }
  return paths;
}

std::array<Boundary, 4> boundaries_of(const std::array<BoundarySpec, 4>& specs, const SidePaths& paths,
                                      const std::shared_ptr<const exact::Solution>& reference) {
  std::array<Boundary, 4> boundaries;
  for (std::size_t k = 0; k < boundaries.size(); ++k)
    boundaries[k] = boundary_of(specs[k], paths[k], reference);
  return boundaries;
}

const GasBoundaryFacts& facts_of(const BoundarySpec& spec) {
  return schema::gas_boundary(spec.kind);
}

bool meets_a_solid(const std::array<BoundarySpec, 4>& specs) {
  return std::ranges::any_of(specs, [](const BoundarySpec& spec) { return facts_of(spec).meets_solid; });
}

GasSolver solver_of(const Case& problem, const FluidSpec& spec,
                    const std::shared_ptr<const exact::Solution>& reference) {
  std::vector<GasPart> parts;
  parts.push_back({grid::MovingGrid(grid_from_case(spec.grid, meets_a_solid(spec.boundary)), 0),
                   boundaries_of(spec.boundary, paths_of_sides(spec), reference)});
  const std::vector<grid::GridDescription> fitted = grids_from_case(spec.body_fitted);
  for (std::size_t k = 0; k < fitted.size(); ++k)
    parts.push_back({grid::MovingGrid(fitted[k], 0),
                     boundaries_of(spec.body_fitted[k].boundary, paths_of_fitted(spec, k), reference)});
  return {std::move(parts), bodies_of(spec.body_fitted), options_of(problem, spec), 0};
}

}  // namespace

StateField field_of(std::shared_ptr<const exact::Solution> solution) {
  return [solution = std::move(solution)](double x, double y, double t) {
    const exact::GasState gas = solution->gas(x, y, t);
    return State{.rho = gas.rho, .v1 = gas.v1, .v2 = gas.v2, .p = gas.p};
  };
}

bool is_chosen(const Case& problem, const std::shared_ptr<const exact::Solution>& reference) {
  return reference && problem.reference.kind == ReferenceKind::manufactured;
}

GasSolver gas_at_start(const Case& problem, const FluidSpec& spec,
                       const std::shared_ptr<const exact::Solution>& reference) {
  GasSolver solver = solver_of(problem, spec, reference);
  if (is_chosen(problem, reference)) solver.force(field_of(reference));
  const StateField initial =
      data_of(spec.initial_from_reference, spec.initial, reference, spec.path + ".initial");
  try {
    solver.assign_initial_conditions(initial);
  } catch (const UserMistake& mistake) {  // between the points at which `check` looked
    throw UserMistake(fmt::format("{}: {}.initial: {}", problem.path, spec.path, mistake.what()));
  }
  if (has_budget(problem, spec, reference)) solver.note_edges();
  return solver;
}

bool has_budget(const Case& problem, const FluidSpec& spec,
                const std::shared_ptr<const exact::Solution>& reference) {
  const bool bodies =
      !spec.body_fitted.empty() && std::ranges::all_of(spec.body_fitted, [](const BodyFittedSpec& fitted) {
        return fitted.curve.closed() && !fitted.solid.empty();
      });
  const bool known = std::ranges::none_of(spec.boundary, [](const BoundarySpec& side) {
    return facts_of(side).meets_solid || facts_of(side).beyond == Beyond::period;
  });
  return bodies && known && !is_chosen(problem, reference);
}

}  // namespace fsi::fluid
