#include "reference/disk_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/failure.hpp"
#include "reference/chain.hpp"

namespace fsi::reference {

namespace {

constexpr double default_points = 3200;
constexpr double default_omega_0 = 0.1;

double number_or(const Case& problem, const std::string& name, double otherwise) {
  const auto found = problem.reference.numbers.find(name);
  return found == problem.reference.numbers.end() ? otherwise : found->second;
}

/// Points off the axes of x and y, where a motion that is not a rotation shows.
struct Sample {
  double x, y;
};
constexpr Sample in_disk[] = {{0.3, 0.4}, {-0.2, 0.5}, {0.6, -0.3}, {-0.1, -0.2}};
constexpr Sample in_gas[] = {{1.05, 0}, {0, 1.1}, {-0.8, -0.8}};

/// The unit disk about the origin, whichever grids it has.
void expect_unit_disk(const Case& problem, const SolidSpec& solid) {
  constexpr double tolerance = 1e-6;  // below what a coupled run can show
  if (solid.body_fitted.empty()) {
    throw UserMistake(
        fmt::format("{}: solids.{}.shape: the rotating disk reference needs the unit disk; write {{kind: "
                    "circle, radius: 1}}",
                    problem.path, solid.name));
  }
  const CurveSpec& outline = solid.body_fitted.front().curve;
  const auto n = static_cast<std::size_t>(outline.points());
  for (std::size_t k = 0; k < n; ++k) {
    const double x = outline.x[k], y = outline.x[n + k];
    if (std::fabs(std::hypot(x, y) - 1) <= tolerance) continue;
    throw UserMistake(fmt::format(
        "{}: solids.{}.shape: the rotating disk reference needs the unit circle about the origin, "
        "but ({:.6g}, {:.6g}) is on the outline; write {{kind: circle, radius: 1}}",
        problem.path, solid.name, x, y));
  }
}

/// Free of forces, and turned by nothing at t = 0.
void expect_unloaded_start(const Case& problem, const SolidSpec& solid) {
  if (solid.body_force) {
    throw UserMistake(
        fmt::format("{}: solids.{}.body_force: the rotating disk reference has no body force; leave it out, "
                    "or `reference`",
                    problem.path, solid.name));
  }
  if (!solid.initial_u) return;
  for (const auto& [x, y] : in_disk) {
    const double u1 = solid.initial_u->c1(x, y, 0), u2 = solid.initial_u->c2(x, y, 0);
    if (u1 == 0 && u2 == 0) continue;
    throw UserMistake(fmt::format(
        "{}: solids.{}.initial.u: the rotating disk reference starts without displacement, but it "
        "is ({:.3g}, {:.3g}) at ({}, {}); leave it out",
        problem.path, solid.name, u1, u2, x, y));
  }
}

void expect_rotation(const Case& problem, const SolidSpec& solid, double omega_0) {
  if (!solid.initial_v) return;
  for (const auto& [x, y] : in_disk) {
    const double V = angular_velocity(omega_0, std::hypot(x, y));
    const double e1 = solid.initial_v->c1(x, y, 0) + V * y, e2 = solid.initial_v->c2(x, y, 0) - V * x;
    if (std::hypot(e1, e2) <= 1e-9 * (1 + std::fabs(omega_0))) continue;
    throw UserMistake(
        fmt::format("{}: solids.{}.initial.v is not the rotation of `reference`: at ({}, {}) it is off by "
                    "({:.3g}, {:.3g}); write [\"-y * V\", \"x * V\"] with V = omega_0 * (4 * r * (1 - r))^4",
                    problem.path, solid.name, x, y, e1, e2));
  }
}

void read_gas(const Case& problem, DiskProblem& disk) {
  const FluidSpec& fluid = problem.fluids.front();
  if (!fluid.initial) throw UserMistake("the rotating disk reference needs `fluid.initial`");
  disk.gamma = fluid.gamma;
  disk.p_e = fluid.p_e;
  disk.rho_0 = fluid.initial->rho(in_gas[0].x, in_gas[0].y, 0);
  disk.p_0 = fluid.initial->p(in_gas[0].x, in_gas[0].y, 0);
  for (const auto& [x, y] : in_gas) {
    const bool same = std::fabs(fluid.initial->rho(x, y, 0) / disk.rho_0 - 1) < 1e-12 &&
                      std::fabs(fluid.initial->p(x, y, 0) / disk.p_0 - 1) < 1e-12;
    const bool rests = fluid.initial->v1(x, y, 0) == 0 && fluid.initial->v2(x, y, 0) == 0;
    if (same && rests) continue;
    throw UserMistake(fmt::format(
        "{}: the rotating disk reference needs a gas at rest with one rho and one p in `fluid.initial`",
        problem.path));
  }
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

double angular_velocity(double omega_0, double r_bar) {
  return omega_0 * std::pow(4 * r_bar * (1 - r_bar), 4);
}

DiskProblem disk_from_case(const Case& problem) {
  if (problem.fluids.size() != 1 || problem.solids.size() != 1) {
    throw UserMistake(
        fmt::format("{}: the rotating disk reference needs one gas and one solid", problem.path));
  }
  const SolidSpec& solid = problem.solids.front();
  const double omega_0 = number_or(problem, "omega_0", default_omega_0);
  expect_unit_disk(problem, solid);
  expect_unloaded_start(problem, solid);
  expect_rotation(problem, solid, omega_0);
  DiskProblem disk;
  disk.material = {solid.law, solid.rho, solid.lambda, solid.mu, solid.data};
  disk.load_on_reference = load_on_reference(solid);
  disk.b = number_or(problem, "b", 0);
  if (disk.b != 0 && disk.b <= 1) {
    throw UserMistake(
        fmt::format("{}: reference.b = {} is inside the disk of radius 1; leave it out for a gas "
                    "without end",
                    problem.path, disk.b));
  }
  disk.v_r = [](double) { return 0.0; };
  disk.v_theta = [omega_0](double r) { return r * angular_velocity(omega_0, r); };
  disk.times = output_times(problem.output.times, problem.time.end);
  read_gas(problem, disk);
  return disk;
}

int disk_points_from_case(const Case& problem) {
  return static_cast<int>(number_or(problem, "points", default_points));
}

}  // namespace fsi::reference
