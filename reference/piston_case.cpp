#include "reference/piston_case.hpp"

#include <fmt/format.h>

#include <memory>

#include "common/case/check/given/misfit.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/core/failure.hpp"
#include "common/exact/solution.hpp"
#include "reference/chain.hpp"

namespace fsi::reference {

namespace {

constexpr int default_points = 3200;

std::function<double(double)> along_x(const std::optional<VectorExpressions>& field) {
  if (!field) return [](double) { return 0.0; };
  return [f = field->c1](double x) { return f(x, 0, 0); };
}

std::function<double(double)> drive_of(const SolidSpec& solid,
                                       const std::shared_ptr<exact::Solution>& exact) {
  const BoundarySpec& left = solid.boundary[0];
  const double x = solid.grid.x_a;
  if (left.from_reference && exact) return [=](double t) { return exact->solid(x, 0, t).u[0]; };
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
  expect_none(misfit_of_piston(problem), problem.path);
  const FluidSpec& fluid = problem.fluids.front();
  const SolidSpec& solid = problem.solids.front();
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
