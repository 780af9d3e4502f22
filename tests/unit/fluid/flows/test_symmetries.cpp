/// What the equations conserve and what they do not see.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/core/failure.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

using test::pi;

State waves(double x, double y, double /*t*/) {
  const double s = std::sin(2 * pi * x), c = std::cos(2 * pi * y);
  return {1 + 0.3 * s * c, 0.4 * c, 0.3 * s + 0.2, 0.8 + 0.3 * c * s};
}

class Eq1Conservation : public testing::TestWithParam<std::tuple<bool, Limiter, double>> {};

TEST_P(Eq1Conservation, KeepsMassMomentumAndEnergyInAPeriodicBox) {
  const auto [moving, limiter, viscosity] = GetParam();
  grid::GridDescription grid =
      moving ? test::wavy(25, 21, {0, 0}, {1, 1}) : test::rectangle(25, 21, {0, 0}, {1, 1});
  grid.periodic1 = grid.periodic2 = true;
  GasSolver gas =
      test::solver(grid, {.limiter = limiter, .shock_viscosity = viscosity, .linear_diffusion = viscosity},
                   {Periodic{}, Periodic{}, Periodic{}, Periodic{}}, waves);
  const Totals before = gas.totals();
  test::run(gas, 0.5);
  const Totals after = gas.totals();
  const double round_off = 1e-13;  // sums of 480 volumes over some fifty steps
  EXPECT_NEAR(after.mass, before.mass, round_off);
  EXPECT_NEAR(after.momentum1, before.momentum1, round_off);
  EXPECT_NEAR(after.momentum2, before.momentum2, round_off);
  EXPECT_NEAR(after.energy, before.energy, 3 * round_off);
}

INSTANTIATE_TEST_SUITE_P(Periodic, Eq1Conservation,
                         testing::Combine(testing::Bool(),
                                          testing::Values(Limiter::none, Limiter::minmod, Limiter::mc,
                                                          Limiter::van_leer),
                                          testing::Values(0.0, 0.5)));

/// A pressure bump beside the middle of a closed box, its mirror image, and the box turned by an angle.
double bump(double x, double y) {
  return std::exp(-30 * ((x - 0.3) * (x - 0.3) + (y - 0.4) * (y - 0.4)));
}

TEST(Eq1Symmetry, AMirroredGasStaysTheMirrorImage) {
  const StateField original = [](double x, double y, double) {
    return State{1, 0.2 * bump(x, y), 0, 1 + bump(x, y)};
  };
  const StateField mirrored = [](double x, double y, double) {
    return State{1, -0.2 * bump(1 - x, y), 0, 1 + bump(1 - x, y)};
  };
  const std::array<Boundary, 4> boundaries{SlipWall{}, SlipWall{}, Symmetry{}, Outflow{}};
  for (const Riemann riemann : {Riemann::roe, Riemann::hllc}) {
    for (const Limiter limiter : {Limiter::none, Limiter::minmod}) {
      const GasOptions options{.riemann = riemann, .limiter = limiter};
      GasSolver a = test::solver(test::rectangle(33, 29, {0, 0}, {1, 1}), options, boundaries, original);
      GasSolver b = test::solver(test::rectangle(33, 29, {0, 0}, {1, 1}), options, boundaries, mirrored);
      test::run(a, 0.4);
      test::run(b, 0.4);
      double difference = 0;
      for (int j = 0; j < 29; ++j) {
        for (int i = 0; i < 33; ++i) {
          difference = std::max({difference, std::fabs(a.state()(0, i, j) - b.state()(0, 32 - i, j)),
                                 std::fabs(a.state()(1, i, j) + b.state()(1, 32 - i, j)),
                                 std::fabs(a.state()(3, i, j) - b.state()(3, 32 - i, j))});
        }
      }
      EXPECT_LT(difference, 1e-13);  // fused multiply-adds round the two images differently
    }
  }
}

TEST(Component, OfARectangleIsALatticeHoweverFarFromTheOrigin) {
  const auto is_lattice = [](const grid::GridDescription& grid) {
    return Component(grid::MovingGrid(grid, 0), {}, {SlipWall{}, SlipWall{}, SlipWall{}, SlipWall{}})
        .cartesian();
  };
  for (const double away : {0.0, 2e4, -3e6}) {
    grid::GridDescription grid = test::rectangle(161, 41, {away - 2, 0}, {away + 2, 1});
    EXPECT_TRUE(is_lattice(grid)) << away;
    grid.mapping = [map = grid.mapping](double r, double s, double t) -> Vec2 {
      return map(r, s, t) + Vec2(1e-4 * r * (1 - r), 0);
    };
    EXPECT_FALSE(is_lattice(grid)) << away;
  }
}

class Eq30TurnedBox : public testing::TestWithParam<double> {};

TEST_P(Eq30TurnedBox, GivesTheTurnedSolution) {
  const double c = std::cos(GetParam()), s = std::sin(GetParam());
  const StateField original = [](double x, double y, double) {
    return State{1, 0.2 * bump(x, y), 0, 1 + bump(x, y)};
  };
  const StateField turned = [&](double x, double y, double) {
    const State q = original(c * x + s * y, c * y - s * x, 0);
    return State{q.rho, c * q.v1 - s * q.v2, s * q.v1 + c * q.v2, q.p};
  };
  grid::GridDescription grid = test::rectangle(29, 25, {0, 0}, {1, 1}), turned_grid = grid;
  turned_grid.mapping = [=](double x, double y, double) { return Vec2(c * x - s * y, s * x + c * y); };
  const std::array<Boundary, 4> boundaries{SlipWall{}, SlipWall{}, Symmetry{}, Outflow{}};
  const GasOptions options{.limiter =
                               Limiter::none};  // limiters act on Cartesian components and see the angle
  GasSolver a = test::solver(grid, options, boundaries, original);
  GasSolver b = test::solver(turned_grid, options, boundaries, turned);
  test::run(a, 0.4);
  test::run(b, 0.4);
  double difference = 0;
  for (int j = 0; j < 25; ++j) {
    for (int i = 0; i < 29; ++i) {
      const double v1 = c * b.state()(1, i, j) + s * b.state()(2, i, j);
      difference =
          std::max({difference, std::fabs(a.state()(0, i, j) - b.state()(0, i, j)),
                    std::fabs(a.state()(1, i, j) - v1), std::fabs(a.state()(3, i, j) - b.state()(3, i, j))});
    }
  }
  EXPECT_LT(difference, 1e-12);  // round-off of the metrics
}

INSTANTIATE_TEST_SUITE_P(Angles, Eq30TurnedBox, testing::Values(0.7, pi / 2, pi, -pi / 2));

TEST(Eq31ClosedBox, SymmetrySidesLoseNothing) {
  const StateField blast = [](double x, double y, double) { return State{1, 0, 0, 1 + 20 * bump(x, y)}; };
  GasSolver gas = test::solver(test::rectangle(41, 41, {0, 0}, {1, 1}), {},
                               {Symmetry{}, Symmetry{}, Symmetry{}, Symmetry{}}, blast);
  const Totals before = gas.totals();
  test::run(gas, 0.5);
  EXPECT_NEAR(gas.totals().mass, before.mass, 1e-12);
  EXPECT_NEAR(gas.totals().energy, before.energy, 1e-11);
}

TEST(Positivity, TwoStreamsThatPartLeaveThinGasNotNegativeGas) {
  const StateField parting = [](double x, double, double) { return State{1, x < 0.5 ? -3.0 : 3.0, 0, 0.4}; };
  for (const Riemann riemann : {Riemann::roe, Riemann::hllc}) {
    for (const Limiter limiter : {Limiter::none, Limiter::minmod, Limiter::mc, Limiter::van_leer}) {
      GasSolver gas =
          test::solver(test::rectangle(101, 5, {0, 0}, {1, 0.1}), {.riemann = riemann, .limiter = limiter},
                       {Outflow{}, Outflow{}, Symmetry{}, Symmetry{}}, parting);
      test::run(gas, 0.1);
      const Health health = gas.health();
      EXPECT_GT(health.min_rho, 0);
      EXPECT_GT(health.min_p, 0);
      EXPECT_LT(health.min_rho, 0.05);
      EXPECT_EQ(health.floors, 0U);
      if (limiter == Limiter::none) {
        EXPECT_GT(health.first_order_fallbacks, 0U);
      }
    }
  }
}

TEST(Positivity, SmoothFlowNeedsNoFallback) {
  GasSolver gas = test::solver(test::wavy(31, 31, {-3, -3}, {3, 3}), {.limiter = Limiter::none},
                               {Outflow{}, Outflow{}, Outflow{}, Outflow{}}, test::Vortex{});
  test::run(gas, 0.5);
  EXPECT_EQ(gas.health().first_order_fallbacks, 0U);
}

}  // namespace
}  // namespace fsi::fluid
