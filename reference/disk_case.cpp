#include "reference/disk_case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/case/check/given/misfit.hpp"
#include "common/core/failure.hpp"
#include "common/exact/disk_table.hpp"
#include "reference/chain.hpp"

namespace fsi::reference {

namespace {

constexpr double default_points = 3200;

double number_or(const Case& problem, const std::string& name, double otherwise) {
  const auto found = problem.reference.numbers.find(name);
  return found == problem.reference.numbers.end() ? otherwise : found->second;
}

/// At rest with one rho and one p, as misfit_of_disk has it.
void read_gas(const Case& problem, DiskProblem& disk) {
  const FluidSpec& fluid = problem.fluids.front();
  if (!fluid.initial) throw UserMistake("the rotating disk reference needs `fluid.initial`");
  disk.gamma = fluid.gamma;
  disk.p_e = fluid.p_e;
  disk.rho_0 = fluid.initial->rho(1, 0, 0);
  disk.p_0 = fluid.initial->p(1, 0, 0);
}

bool load_on_reference(const SolidSpec& solid) {
  const auto follows_not = [](const BoundarySpec& side) {
    return side.kind == BoundaryKind::interface && side.load == LoadConfiguration::reference;
  };
  return std::ranges::any_of(solid.boundary, follows_not) ||
         std::ranges::any_of(solid.body_fitted, [&](const BodyFittedSpec& fitted) {
           return std::ranges::any_of(fitted.boundary, follows_not);
         });
}

}  // namespace

DiskProblem disk_from_case(const Case& problem) {
  expect_none(misfit_of_disk(problem), problem.path);
  const SolidSpec& solid = problem.solids.front();
  const double omega_0 = number_or(problem, "omega_0", exact::default_omega_0);
  DiskProblem disk;
  disk.material = {solid.law, solid.rho, solid.lambda, solid.mu, solid.data};
  disk.load_on_reference = load_on_reference(solid);
  disk.b = number_or(problem, "b", 0);
  disk.v_r = [](double) { return 0.0; };
  disk.v_theta = [omega_0](double r) { return r * exact::angular_velocity(omega_0, r); };
  disk.times = output_times(problem.output.times, problem.time.end);
  read_gas(problem, disk);
  return disk;
}

int disk_points_from_case(const Case& problem) {
  return static_cast<int>(number_or(problem, "points", default_points));
}

}  // namespace fsi::reference
