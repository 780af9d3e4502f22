// Motions of a disk on overlapping grids: second order in the maximum norm, and nothing that grows.

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "solid_solver/boundary/every_boundary.hpp"
#include "tests/convergence/solid/disk.hpp"
#include "tests/convergence/solid/errors_in_time.hpp"
#include "tests/convergence/solid/manufactured_motion.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid::test {
namespace {

constexpr SolidOptions small_dissipation = {.rho = 1.2,
                                            .tangential_stress = {.scaled = 0.1},
                                            .displacement = {.scaled = 0.1},
                                            .relaxation = {.scaled = 0.5}};

/// Outline with given displacement or given traction.
template <class L>
Boundary outline_of(Condition kind, const ManufacturedMotion<L>& motion) {
  Boundary rim;
  rim.condition = kind;
  if (kind == Displacement::condition) {
    rim.vector = [motion](double x, double y, double t) { return motion.u(x, y, t); };
    rim.velocity = [motion](double x, double y, double t) { return motion.v(x, y, t); };
  } else {
    rim.vector = [motion](double x, double y, double t) {
      return motion.traction(Vec2(x, y).normalized(), x, y, t);
    };
  }
  return rim;
}

/// Largest errors over many times: those of a single one go up and down with the waves of the error.
template <class L>
Errors run(Condition kind, int cells) {
  constexpr double t_end = 0.8;
  constexpr int checks = 16;
  const L law{.lambda = 1.1, .mu = 0.7};
  const ManufacturedMotion<L> motion(law, small_dissipation.rho, 0.4);
  const StateFunction exact = [&](double x, double y, double t) { return motion.state(x, y, t); };
  SolidOptions options = small_dissipation;
  options.relaxation = {.rate = 1};  // a scaled one helps coarse grids more, and the rates look worse for it
  DiskGrids disk = disk_of(cells, outline_of(kind, motion));
  SolidSolver<L> solver(std::move(disk.parts), disk.bodies, law, options, 0);
  solver.set_body_force([&](double x, double y, double t) { return motion.force(x, y, t); });
  solver.assign_initial_conditions(exact);
  std::vector<double> times;
  for (int check = 1; check <= checks; ++check) times.push_back(check * t_end / checks);
  return largest_errors(solver, exact, times);
}

/// Mean rates over two halvings: where the points of the two grids fall in one another's cells changes from
/// grid to grid, and the errors with it. Bounds about one and a half times what is measured; the amplitude
/// of u is 0.03, of v 0.09 and of P about 0.2.
template <class L>
void expect_second_order(Condition kind) {
  const Errors coarse = run<L>(kind, 16), fine = run<L>(kind, 64);
  const std::string what = fmt::format("u {:.2e} {:.2e} v {:.2e} {:.2e} P {:.2e} {:.2e}", coarse.u, fine.u,
                                       coarse.v, fine.v, coarse.P, fine.P);
  EXPECT_GE(0.5 * std::log2(coarse.u / fine.u), 1.9) << what;
  EXPECT_GE(0.5 * std::log2(coarse.v / fine.v), 1.9) << what;
  EXPECT_GE(0.5 * std::log2(coarse.P / fine.P), 1.9) << what;
  EXPECT_LT(fine.u, 6e-6) << what;
  EXPECT_LT(fine.v, 3e-5) << what;
  EXPECT_LT(fine.P, 9e-5) << what;
}

template <class L>
class Eq32DiskOnTwoGrids : public testing::Test {};
using Laws = testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(Eq32DiskOnTwoGrids, Laws);

TYPED_TEST(Eq32DiskOnTwoGrids, IsSecondOrderWithGivenDisplacement) {
  expect_second_order<TypeParam>(Displacement::condition);
}
TYPED_TEST(Eq32DiskOnTwoGrids, Eq43IsSecondOrderWithGivenTraction) {
  expect_second_order<TypeParam>(Traction::condition);
}

/// Twenty times the p-wave's way across. Interpolation between grids does not keep energy, and nothing tells
/// it to lose some: growth would show here.
TYPED_TEST(Eq32DiskOnTwoGrids, VibratesFreelyForLongWithoutGainingEnergy) {
  const TypeParam law{.lambda = 1, .mu = 1};
  SolidOptions options = small_dissipation;
  options.rho = 1;
  DiskGrids disk = disk_of(20, Boundary{});
  SolidSolver<TypeParam> solver(std::move(disk.parts), disk.bodies, law, options, 0);
  const Totals before = [&] {
    solver.assign_initial_conditions(
        [](double, double, double) -> Vec2 {
          return {0, 0};
        },
        [](double x, double y, double) -> Vec2 {
          return 0.1 * Vec2(x + 0.5 * std::sin(2 * y), -y + 0.3 * std::cos(x + 2 * y));
        });
    return solver.totals();
  }();
  const double transit = 2 / std::sqrt(3.0);
  double t = 0, most = 0;
  while (t < 20 * transit) {
    const double dt = solver.compute_time_step().dt;
    solver.advance_solid(t, dt);
    t += dt;
    solver.apply_solid_bcs(t);
    if (solver.steps() % 20 == 0) most = std::max(most, solver.totals().energy() / before.energy());
  }
  const Totals after = solver.totals();
  EXPECT_GT(solver.steps(), 2000U);
  EXPECT_LT(most, 1.001);
  EXPECT_GT(after.energy() / before.energy(), 0.95);
  // No force acts: what is left is truncation of the interpolation, of second order, against a mass of pi and
  // velocities of 0.1.
  EXPECT_LT((after.momentum - before.momentum).norm(), 3e-4);
  EXPECT_LT(std::abs(after.angular_momentum - before.angular_momentum), 1e-3);
}

}  // namespace
}  // namespace fsi::solid::test
