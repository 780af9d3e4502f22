/// Which points lie inside a shock, and how fallbacks to first order are counted apart by it.

#include <gtest/gtest.h>

#include "fluid_solver/measures/shocks.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

constexpr int n1 = 41, n2 = 9, jump_at = 20;  // the pressure changes between columns 19 and 20

/// Pressure 1 to the left of the jump, `behind` to its right.
Field step(double behind) {
  Field q(Layout(n1, n2), 4);
  for (int j = 0; j < n2; ++j) {
    for (int i = 0; i < n1; ++i) q(3, i, j) = i < jump_at ? 1 : behind;
  }
  return q;
}

TEST(InsideShock, ReachesFiveCellsToBothSidesOfAPressureJump) {
  const Field q = step(1.5);
  const ShockField field{.q = q.view(), .valid = grid::all_points(n1, n2)};
  for (int i = 0; i < n1; ++i)
    EXPECT_EQ(inside_shock(field, i, 4), i >= jump_at - shock_reach && i < jump_at + shock_reach) << i;
}

TEST(InsideShock, NeedsAJumpOfMoreThanFivePercentOfTheSmallerPressure) {
  const grid::RowSets all = grid::all_points(n1, n2);
  for (const auto& [behind, found] :
       {std::pair{1.049, false}, {1.051, true}, {1 / 1.049, false}, {1 / 1.051, true}}) {
    const Field q = step(behind);
    EXPECT_EQ(inside_shock({.q = q.view(), .valid = all}, jump_at, 4), found) << behind;
  }
}

TEST(InsideShock, DoesNotLookAtPointsWithoutAValue) {
  const Field q = step(1.5);
  grid::RowSets left;
  for (int j = 0; j < n2; ++j) {
    left.append(grid::Interval{0, jump_at});
    left.end_row();
  }
  EXPECT_FALSE(inside_shock({.q = q.view(), .valid = left}, jump_at - 1, 4));
}

TEST(InsideShock, GoesOnAtTheOtherEndOfAPeriod) {
  Field q = step(1.5);
  for (int j = 0; j < n2; ++j) q(3, n1 - 1, j) = q(3, 0, j);  // the last point is the first one again
  const grid::RowSets all = grid::all_points(n1, n2);
  EXPECT_TRUE(inside_shock({.q = q.view(), .valid = all, .periodic = {true, false}}, 1, 4));
  EXPECT_FALSE(inside_shock({.q = q.view(), .valid = all}, 1, 4));
}

/// Fallbacks of the first step at a contact, where the density falls to a hundredth and the pressure by
/// `jump`: without a limiter the slope of the density takes too much from the thin side.
Health after_a_step(double jump) {
  const StateField contact = [jump](double x, double, double) {
    return x < 0.5 ? State{1, 0, 0, jump} : State{0.01, 0, 0, 1};
  };
  GasSolver gas = test::solver(test::rectangle(101, 5, {0, 0}, {1, 0.1}), {.limiter = Limiter::none},
                               {Outflow{}, Outflow{}, Symmetry{}, Symmetry{}}, contact);
  gas.apply_fluid_bcs(0);
  const double dt = gas.compute_time_step().dt;
  gas.move_grids(dt, dt);
  gas.advance_fluid(dt, dt);
  return gas.health();
}

TEST(Fallbacks, AreOutsideShocksWhereThePressureWasSmooth) {
  const Health smooth = after_a_step(1), shocked = after_a_step(2);
  EXPECT_GT(smooth.first_order_fallbacks, 0U);
  EXPECT_EQ(smooth.first_order_outside_shocks, smooth.first_order_fallbacks);
  EXPECT_GT(shocked.first_order_fallbacks, 0U);
  EXPECT_EQ(shocked.first_order_outside_shocks, 0U);
}

}  // namespace
}  // namespace fsi::fluid
