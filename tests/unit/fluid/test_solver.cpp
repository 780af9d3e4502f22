/// The solver as its program sees it: mistakes, failures, probes, totals, restart.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>

#include "common/core/failure.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

using test::open_sides;

GasSolver box(const GasOptions& options = {}, const std::array<Boundary, 4>& boundaries = open_sides) {
  return {grid::MovingGrid(test::rectangle(11, 9, {0, 0}, {1, 1}), 0), options, boundaries, 0};
}

TEST(GasSolverMistakes, AreNamedBeforeAnythingStarts) {
  EXPECT_THROW(box({.gamma = 1}), UserMistake);
  EXPECT_THROW(box({.cfl = 0}), UserMistake);
  EXPECT_THROW(box({.linear_diffusion = -1}), UserMistake);
  EXPECT_THROW(box({}, {Periodic{}, Outflow{}, Outflow{}, Outflow{}}), UserMistake);
  GasSolver gas = box();
  try {
    gas.assign_initial_conditions([](double x, double, double) { return State{x - 0.25, 0, 0, 1}; });
    FAIL() << "no complaint about negative density";
  } catch (const UserMistake& mistake) {
    EXPECT_NE(std::string(mistake.what()).find("initial state at (0, 0): rho = -0.25"), std::string::npos)
        << mistake.what();
  }
}

TEST(GasSolverFailure, SaysWhenWhereAndWhatBroke) {
  GasSolver gas = box();
  gas.assign_initial_conditions([](double x, double, double) {
    return x < 0.5 ? State{1, 0, 0, 100} : State{0.1, 0, 0, 0.1};
  });
  gas.apply_fluid_bcs(0);
  try {
    gas.advance_fluid(1, 1);  // a hundred times the stable step
    FAIL() << "the step should have broken the numbers";
  } catch (const Diverged& broke) {
    const std::string what = broke.what();
    EXPECT_EQ(broke.place().t, 1);
    EXPECT_EQ(broke.place().grid, "grid");
    EXPECT_EQ(broke.place().point.size(), 2U);
    EXPECT_NE(what.find("t = 1, grid \"grid\", point ("), std::string::npos) << what;
    EXPECT_NE(what.find("rho = "), std::string::npos) << what;
  }
}

TEST(GasSolverProbe, ReproducesALinearFieldOnACurvedGrid) {
  const StateField linear = [](double x, double y, double) {
    return State{2 + x, y, x - y, 3 + 0.5 * x + y};
  };
  GasSolver gas = test::solver(test::wavy(15, 13, {0, 0}, {2, 1}), {}, open_sides, linear);
  for (const auto& [x, y] : {std::pair{0.3, 0.4}, {1.99, 0.01}, {0.0, 0.0}, {2.0, 1.0}, {1.234, 0.777}}) {
    const std::optional<State> state = gas.probe(x, y);
    ASSERT_TRUE(state.has_value()) << x << ", " << y;
    const State exact = linear(x, y, 0);
    EXPECT_NEAR(state->rho, exact.rho, 1e-8);  // points on the grid's edge may lie 1e-9 cells outside
    EXPECT_NEAR(state->v1, exact.v1, 1e-8);
    EXPECT_NEAR(state->v2, exact.v2, 1e-8);
    EXPECT_NEAR(state->p, exact.p, 1e-8);
  }
  EXPECT_FALSE(gas.probe(2.1, 0.5).has_value());
}

TEST(GasSolverTotals, OfARectangleAreItsAreaTimesTheState) {
  GasSolver gas =
      test::solver(test::wavy(15, 13, {0, 0}, {2, 1}), {}, open_sides, [](double, double, double) {
        return State{3, 0.5, -1, 0.8};
      });
  const Totals totals = gas.totals();
  EXPECT_NEAR(totals.mass, 6, 1e-13);
  EXPECT_NEAR(totals.momentum1, 3, 1e-13);
  EXPECT_NEAR(totals.momentum2, -6, 1e-13);
  EXPECT_NEAR(totals.energy, 2 * (0.8 / 0.4 + 0.5 * 3 * 1.25), 1e-13);
}

TEST(GasSolverErrors, SayThatAValueIsNoNumberWhereverItIs) {
  GasSolver gas = box();
  gas.assign_initial_conditions([](double, double, double) { return State{1, 0, 0, 1}; });
  for (const int which : {1, 40, 11 * 9}) {
    const GasErrors errors = gas.errors(
        [=, seen = 0](double, double, double) mutable {
          const double value = ++seen == which ? std::numeric_limits<double>::quiet_NaN() : 2.0;
          return State{value, value, 0, value};
        },
        0);
    EXPECT_TRUE(std::isnan(errors.rho) && std::isnan(errors.v1) && std::isnan(errors.T)) << "point " << which;
    EXPECT_EQ(errors.v2, 0.0);
  }
}

TEST(GasSolverInterface, GivesTheStateAlongASideInItsOwnOrder) {
  const StateField field = [](double x, double y, double) { return State{1 + y, x + 2 * y, x - y, 2 + y}; };
  const GasSolver gas = test::solver(test::rectangle(11, 9, {0, 0}, {1, 1}), {}, open_sides, field);
  const GasInterface right = gas.interface_state(Side::right);
  ASSERT_EQ(right.p.size(), 9U);
  for (std::size_t k = 0; k < 9; ++k) {
    const State exact = field(1, static_cast<double>(k) / 8, 0);
    EXPECT_NEAR(right.x[k], 1, 1e-15);
    EXPECT_NEAR(right.x[9 + k], static_cast<double>(k) / 8, 1e-15);
    EXPECT_NEAR(right.v[k], exact.v1, 1e-15);
    EXPECT_NEAR(right.v[9 + k], exact.v2, 1e-15);
    EXPECT_NEAR(right.p[k], exact.p, 1e-15);
    EXPECT_NEAR(right.z_f[k] * right.z_f[k], 1.4 * exact.p * exact.rho, 1e-14);  // (rho a)^2
  }
}

std::vector<double> state_of(const GasSolver& gas) {
  std::vector<double> values;
  const ConstFieldView q = gas.state();
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < q.layout.n2; ++j) values.insert(values.end(), q.row(k, j), q.row(k, j) + q.layout.n1);
  }
  return values;
}

/// Viscosity decides how the next time step is found, and a grid that moves has more to remember.
class GasSolverRestart : public testing::TestWithParam<std::tuple<double, bool>> {};

TEST_P(GasSolverRestart, ContinuesBitForBit) {
  const auto [viscosity, moving] = GetParam();
  const auto start = [&](double y) {
    const Vec2 low(-3, -3), high(3, 3);
    return test::solver(moving ? test::wavy(31, 27, low, high) : test::rectangle(31, 27, low, high),
                        {.shock_viscosity = viscosity}, open_sides, test::Vortex{.y_0 = y});
  };
  // The one that goes on began with a vortex elsewhere, of which nothing may be left.
  GasSolver whole = start(0), first = start(0), second = start(1.5);
  test::run(first, 0.5);
  Archive saved;
  first.archive(saved);
  Archive loaded(saved.entries());
  second.archive(loaded);
  loaded.check_all_loaded();
  EXPECT_EQ(second.compute_time_step().dt, first.compute_time_step().dt);
  test::run(whole, 0.5);
  test::run(whole, 1.0);
  test::run(second, 1.0);
  EXPECT_EQ(second.time(), 1.0);
  EXPECT_EQ(second.compute_time_step().dt, whole.compute_time_step().dt);
  EXPECT_EQ(
      std::memcmp(state_of(whole).data(), state_of(second).data(), state_of(whole).size() * sizeof(double)),
      0);
}

INSTANTIATE_TEST_SUITE_P(Of, GasSolverRestart, testing::Combine(testing::Values(0.0, 0.1), testing::Bool()),
                         [](const auto& setting) {
                           return std::string(std::get<0>(setting.param) > 0 ? "Viscous" : "Inviscid") +
                                  (std::get<1>(setting.param) ? "GasOnAMovingGrid" : "GasOnAGridAtRest");
                         });

}  // namespace
}  // namespace fsi::fluid
