// What the solid shows of an interface and what projected values do to it.

#include <gtest/gtest.h>

#include <algorithm>

#include "solid_solver/boundary/every_boundary.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid {
namespace {

Boundaries interface_on_top() {
  Boundaries boundaries;
  boundaries[2].condition = boundaries[0].condition = Displacement::condition;
  boundaries[3].condition = Interface::condition;
  return boundaries;
}

Vec2 bend(double x, double y, double) {
  return {0.05 * x * y, -0.04 * x * x * y};
}

TEST(InterfaceState, ShowsTractionPerCurrentAreaAndTheImpedanceThatBelongsToIt) {
  SolidSolver<NeoHookean> solver(test::skewed_grid(16), {.lambda = 1.2, .mu = 0.8}, {.rho = 2},
                                 interface_on_top(), 0);
  solver.assign_initial_conditions(bend, bend);
  SolidInterface state;
  solver.interface_state(Side::top, state);
  ASSERT_EQ(state.x.size(), 34U);
  EXPECT_EQ(state.fixed.front(), 1);  // the left side holds that corner
  EXPECT_EQ(state.fixed.back(), 0);
  EXPECT_NEAR(state.z_p, std::sqrt(2 * 2.8), 1e-14);
  for (std::size_t k = 0; k < 17; ++k) {
    EXPECT_GT(state.Z[k], 0);
    EXPECT_GT(state.Z[k] * state.Z[34 + k], state.Z[17 + k] * state.Z[17 + k]);  // positive definite
  }
  // A solid at rest has the impedances of the p-wave along n0 and of the s-wave across it.
  SolidSolver<NeoHookean> resting(test::unit_square(8), {.lambda = 1.2, .mu = 0.8}, {.rho = 2},
                                  interface_on_top(), 0);
  resting.assign_initial_conditions([](double, double, double) -> Vec2 { return {0, 0}; }, bend);
  resting.interface_state(Side::top, state);
  EXPECT_NEAR(state.Z[18 + 4], state.z_p, 1e-13);
  EXPECT_NEAR(state.Z[4], std::sqrt(2 * 0.8), 1e-13);
}

TEST(InterfaceState, ShowsTheGivenMotionOfAPointThatAlsoLiesOnAMovingClampAndThePredictedOneElsewhere) {
  Boundaries boundaries = interface_on_top();
  const auto clamp = [](double, double, double t) -> Vec2 { return {0.1 * t, -0.2 * t}; };
  boundaries[0].vector = clamp;
  boundaries[0].velocity = [](double, double, double) -> Vec2 { return {0.1, -0.2}; };
  SolidSolver<NeoHookean> solver(test::skewed_grid(16), {.lambda = 1.2, .mu = 0.8}, {.rho = 2}, boundaries,
                                 0);
  solver.assign_initial_conditions(bend, bend);
  const double dt = solver.compute_time_step().dt;
  solver.advance_solid(0, dt);
  SolidInterface state;
  solver.interface_state(Side::top, state);
  const ConstFieldView x = solver.reference(), q = std::as_const(solver).state();
  EXPECT_EQ(Vec2(state.v[0], state.v[17]), Vec2(0.1, -0.2));
  EXPECT_EQ(Vec2(state.x[0], state.x[17]), Vec2(x(0, 0, 16), x(1, 0, 16)) + clamp(0, 0, dt));
  EXPECT_EQ(Vec2(state.v[1], state.v[18]), Vec2(q(plane::v1, 1, 16), q(plane::v2, 1, 16)));
}

TEST(InterfaceState, OfAnEndOnASlipOrSymmetryWallStaysOnTheWallAndSlidesWhereTheyMeetAtRightAngles) {
  for (const Condition wall : {SlipWall::condition, Symmetry::condition}) {
    Boundaries boundaries = interface_on_top();
    boundaries[0].condition = wall;
    SolidSolver<NeoHookean> solver(test::unit_square(8), {.lambda = 1.2, .mu = 0.8}, {.rho = 2}, boundaries,
                                   0);
    solver.assign_initial_conditions(bend, bend);
    solver.state()(plane::u1, 0, 8) = solver.state()(plane::v1, 0, 8) =
        0.01;  // a predicted state knows no wall
    SolidInterface state;
    solver.interface_state(Side::top, state);
    EXPECT_EQ(state.x[0], 0.0);
    EXPECT_EQ(state.v[0], 0.0);
    EXPECT_EQ(state.fixed.front(), wire::Freedom::slides);
    EXPECT_EQ(state.fixed.back(), wire::Freedom::free);
    EXPECT_LT((solver.along_wall(Side::top, 0) - Vec2(0, 1)).norm(), 1e-15);
  }
}

TEST(ApplySolidBcs, PutsTheProjectedValuesOnTheInterface) {
  SolidSolver<NeoHookean> solver(test::skewed_grid(16), {.lambda = 1.2, .mu = 0.8}, {.rho = 2},
                                 interface_on_top(), 0);
  solver.assign_initial_conditions(bend, bend);
  std::vector<double> n(34), v_n(17, 0.03), w_n(17, -0.2);
  for (std::size_t k = 0; k < 17; ++k) {
    n[k] = std::sin(0.1);
    n[17 + k] = std::cos(0.1);
  }
  SolidInterface before, after;
  solver.interface_state(Side::top, before);
  const InterfaceValues values[] = {{.side = Side::top, .n = n, .v_n = v_n, .w_n = w_n}};
  solver.apply_solid_bcs(0, values);
  solver.interface_state(Side::top, after);
  for (std::size_t k = 1; k < 16; ++k) {
    const Vec2 normal(n[k], n[17 + k]), tangent(-n[17 + k], n[k]);
    const Vec2 v(after.v[k], after.v[17 + k]), w(after.w[k], after.w[17 + k]);
    EXPECT_NEAR(normal.dot(v), 0.03, 1e-15);
    EXPECT_NEAR(normal.dot(w), -0.2, 1e-14);
    EXPECT_NEAR(tangent.dot(w), 0, 1e-14);
    EXPECT_EQ(after.x[k], before.x[k]);  // u is not projected
  }
}

TEST(ApplySolidBcs, LetsTheShearThatAnInterfaceTakesAwayMoveItAlongTheOutgoingWaveEq18) {
  constexpr double rho = 2, mu = 0.8, shear = 0.03, v_n = 0.01;
  const double c_s = std::sqrt(mu / rho);
  SolidSolver<LinearElastic> solver(test::unit_square(16), {.lambda = 1.2, .mu = mu}, {.rho = rho},
                                    interface_on_top(), 0);
  solver.assign_initial_conditions([](double, double, double) {
    return SolidState{.u = Vec2::Zero(), .v = Vec2::Zero(), .P = {0, shear, shear, 0}};
  });
  std::vector<double> n(34), speeds(17, v_n), w_n(17, 0.0);
  std::fill(n.begin() + 17, n.end(), 1.0);
  const InterfaceValues values[] = {{.side = Side::top, .n = n, .v_n = speeds, .w_n = w_n}};
  solver.apply_solid_bcs(0, values);
  SolidInterface after;
  solver.interface_state(Side::top, after);
  // A wave that leaves through the top has P_2i = -rho c v_i: what changes by a wave that comes back has P_2i
  // = rho c v_i.
  for (std::size_t k = 1; k < 16; ++k) {
    EXPECT_NEAR(after.w[k], 0, 1e-15);
    EXPECT_NEAR(after.v[k], -shear / (rho * c_s), 1e-14);
    EXPECT_NEAR(after.v[17 + k], v_n, 1e-15);
  }
}

TEST(SideLoads, OfAUniformPressureAddUpToItsForce) {
  Boundaries boundaries;
  boundaries[1].vector = [](double, double, double) -> Vec2 { return {-0.1, 0}; };
  SolidSolver<LinearElastic> solver(test::unit_square(10), {.lambda = 1, .mu = 1}, {}, boundaries, 0);
  solver.assign_initial_conditions(
      [](double, double, double) -> Vec2 {
        return {0, 0};
      },
      [](double, double, double) -> Vec2 {
        return {2, 0};
      });
  const SideLoad load = solver.side_load(Side::right);
  EXPECT_NEAR(load.force.x(), -0.1, 1e-14);
  EXPECT_NEAR(load.force.y(), 0, 1e-14);
  EXPECT_NEAR(load.moment, 0.05, 1e-14);  // acts at y = 1/2
}

}  // namespace
}  // namespace fsi::solid
