/// The same problem in other units has the same solution to the bit, where the units differ by powers of two: no
/// number in the code has a dimension.

#include <gtest/gtest.h>

#include <cstddef>

#include "tests/unit/fluid/moving_body.hpp"

namespace fsi::fluid {
namespace {

using test::Units;

const StateField slanted_shock = [](double x, double y, double) {
  return x + 0.2 * y < -1.5 ? State{2, 1.1, 0.1, 3} : State{1, 0.1, -0.2, 0.7};
};

/// Compares fields after a step as if they had the units of `one`.
void expect_same(const GasSolver& one, const GasSolver& other, const Units& units) {
  const std::array<double, 4> factors{units.density, units.speed(), units.speed(), units.pressure()};
  for (int grid = 0; grid < one.grids(); ++grid) {
    const ConstFieldView q = one.state(grid), r = other.state(grid);
    std::size_t different = 0;
    for (int j = 0; j < q.layout.n2; ++j) {
      for (const grid::Interval& run : one.valid(grid).row(j)) {
        for (int i = run.begin; i < run.end; ++i) {
          for (int c = 0; c < 4; ++c)
            different += factors[static_cast<std::size_t>(c)] * q(c, i, j) == r(c, i, j) ? 0U : 1U;
        }
      }
    }
    EXPECT_EQ(different, 0U) << "grid " << grid;
  }
}

class GasInUnits : public ::testing::TestWithParam<Units> {};

TEST_P(GasInUnits, AShockMeetsAMovingBody) {
  const Units units = GetParam();
  for (const double viscosity : {0.0, 0.5}) {
    const GasOptions options{.shock_viscosity = viscosity};
    GasSolver one = test::around_moving_body(options, Dirichlet{slanted_shock}),
              other = test::around_moving_body(options, Dirichlet{in(units, slanted_shock)}, units);
    one.assign_initial_conditions(slanted_shock);
    other.assign_initial_conditions(in(units, slanted_shock));
    one.apply_fluid_bcs(0);
    other.apply_fluid_bcs(0);
    double t = 0, time = 0;
    for (int step = 0; step < 20; ++step) {
      t = test::step_with_body(one, t);
      time = test::step_with_body(other, time, units);
      ASSERT_EQ(units.time * t, time) << "step " << step;
    }
    expect_same(one, other, units);
  }
}

TEST_P(GasInUnits, WallsMirrorsAndOpenSides) {
  const Units units = GetParam();
  const auto make = [&](const Units& in_units) {
    const double l = in_units.length;
    const grid::GridDescription wavy = test::wavy(31, 25, {-l, -l}, {l, l});
    grid::GridDescription scaled = wavy;
    scaled.mapping = [wavy, in_units](double r, double s, double t) {
      return wavy.mapping(r, s, t / in_units.time);
    };
    return test::solver(scaled, {},
                        {SlipWall{}, Outflow{}, Symmetry{}, FarField{in(in_units, slanted_shock)}},
                        in(in_units, slanted_shock));
  };
  GasSolver one = make({}), other = make(units);
  one.apply_fluid_bcs(0);
  other.apply_fluid_bcs(0);
  double t = 0, time = 0;
  for (int step = 0; step < 20; ++step) {
    t = test::step_with_body(one, t);
    time = test::step_with_body(other, time, units);
    ASSERT_EQ(units.time * t, time) << "step " << step;
  }
  expect_same(one, other, units);
}

INSTANTIATE_TEST_SUITE_P(PowersOfTwo, GasInUnits,
                         ::testing::Values(Units{0x1p-10, 1, 1}, Units{1, 0x1p-17, 1}, Units{1, 1, 0x1p9},
                                           Units{0x1p7, 0x1p-5, 0x1p-12}));

}  // namespace
}  // namespace fsi::fluid
