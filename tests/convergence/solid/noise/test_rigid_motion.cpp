// Rotations of free bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "common/grid/shapes/ellipse.hpp"
#include "tests/convergence/solid/disk.hpp"
#include "tests/convergence/solid/errors_in_time.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid::test {
namespace {

constexpr SolidOptions little_dissipation = {.rho = 1,
                                             .tangential_stress = {.scaled = 0.1},
                                             .displacement = {.scaled = 0.1},
                                             .relaxation = {.scaled = 0.5}};

Vec2 turned(double angle, double x, double y) {
  return {std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y};
}

/// Rigid rotation at angular velocity 1 by the body force that holds every point on its circle.
template <class L>
Errors rotate(int cells, double t_end) {
  const StateFunction exact = [](double x, double y, double t) {
    const Vec2 now = turned(t, x, y);
    return SolidState{.u = now - Vec2(x, y), .v = Vec2(-now.y(), now.x()), .P = {}};
  };
  Boundaries all_free;
  SolidSolver<L> solver(skewed_grid(cells), L{.lambda = 1, .mu = 1}, little_dissipation, all_free, 0);
  solver.set_body_force([](double x, double y, double t) -> Vec2 { return -turned(t, x, y); });
  solver.assign_initial_conditions(exact);
  double t = 0;
  advance_to(solver, t, t_end);
  return solver.errors(exact, t);
}

template <class L>
class Eq36RigidRotation : public testing::Test {};
using ObjectiveLaws = testing::Types<SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(Eq36RigidRotation, ObjectiveLaws);

TYPED_TEST(Eq36RigidRotation, MakesStressOnlyByTruncationOfSecondOrder) {
  const Errors coarse = rotate<TypeParam>(32, 1.0), fine = rotate<TypeParam>(64, 1.0);
  EXPECT_GE(std::log2(coarse.P / fine.P), 1.9) << coarse.P << " " << fine.P;
  EXPECT_LT(fine.P, 1.2e-3);  // a turn by one radian strains a linear law by 0.46
  EXPECT_LT(fine.u, 1e-3);
}

struct Drift {
  double energy = 0, angular_momentum = 0, momentum = 0;
};

/// A free body, set spinning as if rigid; relative drifts at t_end.
template <class L>
Drift spin(SolidSolver<L>& solver, double omega, double t_end) {
  solver.assign_initial_conditions(
      [](double, double, double) -> Vec2 {
        return {0, 0};
      },
      [=](double x, double y, double) -> Vec2 {
        return {-omega * y, omega * x};
      });
  const Totals before = solver.totals();
  double t = 0;
  while (t < t_end - 1e-12) {
    const double dt = std::min(solver.compute_time_step().dt, t_end - t);
    solver.advance_solid(t, dt);
    t += dt;
    solver.apply_solid_bcs(t);
  }
  const Totals after = solver.totals();
  return {.energy = std::abs(after.energy() / before.energy() - 1),
          .angular_momentum = std::abs(after.angular_momentum / before.angular_momentum - 1),
          .momentum = after.momentum.norm()};
}

/// Free unit block after some turns.
Drift spin(int cells, double turns) {
  const double omega = 0.5;
  Boundaries all_free;
  SolidSolver<NeoHookean> solver(grid::MovingGrid({.name = "block",
                                                   .n1 = cells + 1,
                                                   .n2 = cells + 1,
                                                   .mapping = [](double r, double s, double) -> Vec2 {
                                                     return {r - 0.5, s - 0.5};
                                                   }},
                                                  0),
                                 NeoHookean{.lambda = 1, .mu = 1}, little_dissipation, all_free, 0);
  return spin(solver, omega, turns * 2 * std::numbers::pi / omega);
}

/// The first turn; measured 2e-4 and 2e-5 for the angular momentum, third order.
TEST(Eq35SpinningBlock, DriftsLessThanSecondOrderPerTurn) {
  const Drift coarse = spin(24, 1), fine = spin(48, 1);
  RecordProperty("energy_drift_per_turn_h_1_48", std::to_string(fine.energy));
  RecordProperty("angular_momentum_drift_per_turn_h_1_48", std::to_string(fine.angular_momentum));
  EXPECT_GE(std::log2(coarse.angular_momentum / fine.angular_momentum), 1.9)
      << coarse.angular_momentum << " " << fine.angular_momentum;
  EXPECT_LT(fine.angular_momentum, 5e-5);
  EXPECT_LT(coarse.energy, 1e-4);
  EXPECT_LT(fine.energy, 2e-5);
  EXPECT_LT(fine.momentum, 1e-10);  // zero by symmetry; round-off of 1e3 steps
}

/// Nothing grows: the drift of twenty turns is twenty times that of one.
TEST(Eq41SpinningBlock, KeepsEnergyAndAngularMomentumOverManyTurns) {
  const Drift one = spin(24, 1), twenty = spin(24, 20);
  EXPECT_LT(twenty.angular_momentum, 40 * one.angular_momentum);
  EXPECT_LT(twenty.angular_momentum, 5e-3);
  EXPECT_LT(twenty.energy, 5e-3);
}

/// A turn by one radian of a stiff ellipse whose grid goes round each tip in a few points, with the options' defaults. Where (40)
/// takes the fourth differences of (R - 1) x from u, it gains 4.4 % of its angular momentum and 9.6 % of its energy.
TEST(Eq40SpinningEllipse, KeepsItsAngularMomentumThoughGridLinesBend) {
  DiskGrids ellipse =
      body_of(grid::ellipse({.a = 0.9, .b = 0.3, .angle = 0.5}),
              {.name = "annulus", .points = 81, .lines = 7, .spacing = 0.01}, Boundary{}, 0.0125, 1);
  SolidSolver<SaintVenantKirchhoff> solver(std::move(ellipse.parts), ellipse.bodies,
                                           SaintVenantKirchhoff{.lambda = 288, .mu = 192},
                                           {.rho = 20,
                                            .limiter = Limiter::mc,
                                            .tangential_stress = {.scaled = 0.5},
                                            .displacement = {.scaled = 0.5},
                                            .relaxation = {.scaled = 0.2}},
                                           0);
  const Drift drift = spin(solver, 0.5, 2);
  EXPECT_LT(drift.angular_momentum, 0.006);
  EXPECT_LT(drift.energy, 0.012);
}

}  // namespace
}  // namespace fsi::solid::test
