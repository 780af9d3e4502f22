#include "reference/piston_case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "common/case/schema/boundary_facts.hpp"
#include "common/core/failure.hpp"
#include "common/exact/solution.hpp"
#include "reference/chain.hpp"

namespace fsi::reference {

namespace {

constexpr int default_points = 3200;

void expect_side_by_side(const std::string& path, const FluidSpec& fluid, const SolidSpec& solid) {
  const bool straight = solid.grid.kind == GridSpec::Kind::rectangle && solid.grid.rotation == 0 &&
                        fluid.grid.kind == GridSpec::Kind::rectangle && fluid.grid.rotation == 0;
  const bool meets =
      fluid.boundary[0].kind == BoundaryKind::interface && solid.boundary[1].kind == BoundaryKind::interface;
  if (straight && meets) return;
  throw UserMistake(
      fmt::format("{}: the one-dimensional reference needs rectangles along x, the gas right of solid '{}'",
                  path, solid.name));
}

/// The chain takes no force along it.
void expect_no_body_force(const std::string& path, const SolidSpec& solid) {
  if (!solid.body_force) return;
  throw UserMistake(
      fmt::format("{}: solids.{}.body_force: the one-dimensional reference has no body force; leave it out, "
                  "or `reference`",
                  path, solid.name));
}

/// Beyond the reach of waves the chain's gas stays as it was at first: a state that is given there must be
/// that one at all times.
void expect_quiet_end(const Case& problem, const FluidSpec& fluid) {
  constexpr double tolerance = 1e-9;
  constexpr int times = 16;
  const BoundarySpec& right = fluid.boundary[1];
  if (!right.state || !fluid.initial) return;
  const double x = fluid.grid.x_b;
  const auto apart = [x](const Expression& at_first, const Expression& given, double t) {
    const double value = at_first(x, 0, 0);
    return !(std::fabs(given(x, 0, t) - value) <= tolerance * (1 + std::fabs(value)));
  };
  for (int k = 0; k <= times; ++k) {
    const double t = problem.time.end * k / times;
    if (!apart(fluid.initial->rho, right.state->rho, t) && !apart(fluid.initial->v1, right.state->v1, t) &&
        !apart(fluid.initial->p, right.state->p, t))
      continue;
    throw UserMistake(fmt::format(
        "{}: fluid.boundary.right.state: the one-dimensional reference has at the right a wall or a gas that "
        "stays as `fluid.initial` has it at x = {:g}, but at t = {:.4g} the state is another; give that "
        "state, "
        "or write slip_wall or outflow",
        problem.path, x, t));
  }
}

std::function<double(double)> along_x(const std::optional<VectorExpressions>& field) {
  if (!field) return [](double) { return 0.0; };
  return [f = field->c1](double x) { return f(x, 0, 0); };
}

std::function<double(double)> drive_of(const SolidSpec& solid,
                                       const std::shared_ptr<exact::Solution>& exact) {
  const BoundarySpec& left = solid.boundary[0];
  const double x = solid.grid.x_a;
  if (left.from_reference && exact) return [=](double t) { return exact->solid(x, 0, t).u[0]; };
  if (schema::solid_boundary(left.kind).holds != Hold::motion) {
    throw UserMistake(fmt::format(
        "the one-dimensional reference needs `displacement` on the left side of solid '{}'", solid.name));
  }
  if (!left.vector) return [](double) { return 0.0; };
  return [f = left.vector->c1, x](double t) { return f(x, 0, t); };
}

std::function<exact::TubeState(double)> gas_of(const FluidSpec& fluid,
                                               const std::shared_ptr<exact::Solution>& exact) {
  if (fluid.initial_from_reference && exact) {
    return [exact](double x) {
      const exact::GasState state = exact->gas(x, 0, 0);
      return exact::TubeState{.rho = state.rho, .v = state.v1, .p = state.p};
    };
  }
  if (!fluid.initial) throw UserMistake("the one-dimensional reference needs `fluid.initial`");
  return [f = *fluid.initial](double x) {
    return exact::TubeState{.rho = f.rho(x, 0, 0), .v = f.v1(x, 0, 0), .p = f.p(x, 0, 0)};
  };
}

}  // namespace

PistonProblem piston_from_case(const Case& problem) {
  if (problem.fluids.size() != 1 || problem.solids.size() != 1) {
    throw UserMistake(
        fmt::format("{}: the one-dimensional reference needs one gas and one solid", problem.path));
  }
  const FluidSpec& fluid = problem.fluids.front();
  const SolidSpec& solid = problem.solids.front();
  expect_side_by_side(problem.path, fluid, solid);
  expect_no_body_force(problem.path, solid);
  expect_quiet_end(problem, fluid);
  std::shared_ptr<exact::Solution> exact;
  if (problem.reference.kind != ReferenceKind::piston_1d && problem.reference.kind != ReferenceKind::none) {
    exact = exact::make_solution(problem.reference.kind, problem.reference.numbers, "");
  }

  PistonProblem piston;
  piston.material = {solid.law, solid.rho, solid.lambda, solid.mu, solid.data};
  piston.x_a = solid.grid.x_a;
  piston.x_b = solid.grid.x_b;
  piston.x_end = fluid.grid.x_b;
  piston.gamma = fluid.gamma;
  piston.p_e = fluid.p_e;
  const GasBoundaryFacts& right = schema::gas_boundary(fluid.boundary[1].kind);
  piston.wall = right.is_wall || right.beyond == Beyond::mirror;
  piston.drive = drive_of(solid, exact);
  piston.u_0 = along_x(solid.initial_u);
  piston.v_0 = along_x(solid.initial_v);
  if (solid.initial_from_reference && exact) {
    piston.u_0 = [exact](double x) { return exact->solid(x, 0, 0).u[0]; };
    piston.v_0 = [exact](double x) { return exact->solid(x, 0, 0).v[0]; };
  }
  piston.gas_0 = gas_of(fluid, exact);
  piston.times = output_times(problem.output.times, problem.time.end);
  return piston;
}

int points_from_case(const Case& problem) {
  const auto found = problem.reference.numbers.find("points");
  return found == problem.reference.numbers.end() ? default_points : static_cast<int>(found->second);
}

}  // namespace fsi::reference
