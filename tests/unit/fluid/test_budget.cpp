/// What passes the boundary of a gas is what its totals change by.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fluid_solver/measures/budget.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

using test::open_sides;

/// A pulse that runs in a wind towards the right side of a box of n x n points.
GasSolver with_a_pulse(int n, const std::array<Boundary, 4>& sides, const Refinement& refine = {}) {
  return test::solver(test::rectangle(n, n, {0, 0}, {1, 1}), {.limiter = Limiter::none, .refine = refine},
                      sides, [](double x, double y, double) {
                        const double bump = std::exp(-40 * ((x - 0.6) * (x - 0.6) + (y - 0.5) * (y - 0.5)));
                        return State{1 + 0.2 * bump, 0.7, 0.1, 1 / 1.4 + 0.2 * bump};
                      });
}

/// A pulse on the lower side of such a box, in a wind along it.
GasSolver beside_a_side(int n, const std::array<Boundary, 4>& sides, const Refinement& refine = {}) {
  return test::solver(test::rectangle(n, n, {0, 0}, {1, 1}), {.limiter = Limiter::none, .refine = refine},
                      sides, [](double x, double y, double) {
                        const double bump = std::exp(-40 * ((x - 0.6) * (x - 0.6) + y * y));
                        return State{1 + 0.2 * bump, 0.7, 0, 1 / 1.4 + 0.2 * bump};
                      });
}

/// Largest defect until t = 0.4.
double largest_defect(GasSolver gas) {
  Budget budget(gas);
  budget.add(gas, {}, 0);
  double largest = 0;
  for (double t = 0; t < 0.4;) {
    const double dt = gas.compute_time_step().dt;
    t += dt;
    gas.move_grids(t, dt);
    gas.advance_fluid(t, dt);
    gas.apply_fluid_bcs(t);
    budget.add(gas, {}, dt);
    const Totals defect = budget.defect(gas);
    for (const double part : {defect.mass, defect.momentum1, defect.momentum2, defect.energy})
      largest = std::max(largest, std::abs(part));
  }
  return largest;
}

constexpr double round_off_of_totals = 1e-13;  // of totals of up to 3, some 100 steps

TEST(Budget, OfWavesThatLeaveIsClosedToRoundOff) {
  EXPECT_LT(largest_defect(with_a_pulse(41, open_sides)), round_off_of_totals);
}

/// The pulse leaves the finest level behind, and passes the sides where they are coarse and where they are fine.
TEST(Budget, OfLevelsIsClosedToRoundOff) {
  for (const int levels : {2, 3}) {
    const GasSolver gas = with_a_pulse(82, open_sides, {.levels = levels, .threshold = 0.02});
    EXPECT_LT(gas.levels()->owned(0).points(), 82U * 82U / 2);
    EXPECT_LT(largest_defect(with_a_pulse(82, open_sides, {.levels = levels, .threshold = 0.02})),
              round_off_of_totals);
    EXPECT_LT(largest_defect(beside_a_side(82, {Outflow{}, Outflow{}, SlipWall{}, Symmetry{}},
                                           {.levels = levels, .threshold = 0.02})),
              1e-3);
  }
}

/// A side that imposes all values, those of a gas at rest here, throws the pulse back.
TEST(Budget, OfASideThatImposesValuesIsClosedToRoundOff) {
  const Imposed rest{[](double, double, double) { return State{1, 0, 0, 1 / 1.4}; }};
  EXPECT_LT(largest_defect(with_a_pulse(41, {Outflow{}, rest, Outflow{}, Outflow{}})), round_off_of_totals);
}

TEST(Budget, OfMirrorsAndWallsIsClosedToSecondOrder) {
  const std::array<Boundary, 4> mirrors{Outflow{}, Outflow{}, Symmetry{}, Symmetry{}},
      walls{Outflow{}, Outflow{}, SlipWall{}, SlipWall{}};
  const double coarse = largest_defect(beside_a_side(41, walls)),
               fine = largest_defect(beside_a_side(81, walls));
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
  const double mirrored_coarse = largest_defect(beside_a_side(41, mirrors)),
               mirrored_fine = largest_defect(beside_a_side(81, mirrors));
  EXPECT_LT(mirrored_coarse, 1e-3);
  EXPECT_GT(std::log2(mirrored_coarse / mirrored_fine), 1.7);
}

/// A wall of pressure p_e + 0.3 that moves into the gas gives it momentum and energy.
TEST(Budget, CountsForceAndPowerOfAnInterface) {
  GasSolver gas = test::solver(test::rectangle(5, 11, {0, 0}, {1, 1}), {.p_e = 1}, open_sides,
                               [](double, double, double) {
                                 return State{1, 0, 0, 1};
                               });
  Budget budget(gas);
  const std::vector<double> n_along_x = [] {
    std::vector<double> n(22, 0.0);
    std::fill(n.begin(), n.begin() + 11, 1.0);
    return n;
  }();
  const std::vector<double> v_n(11, 0.25), w_n(11, -0.3);
  const InterfaceLoad load[] = {{.side = Side::left, .grid = 0, .n = n_along_x, .v_n = v_n, .w_n = w_n}};
  budget.add(gas, load, 0);
  budget.add(gas, load, 2);
  const Totals defect = budget.defect(gas);  // the gas itself was not told
  EXPECT_NEAR(defect.momentum1, -2 * 1.3, 1e-13);
  EXPECT_NEAR(defect.momentum2, 0, 1e-13);
  EXPECT_NEAR(defect.energy, -2 * 1.3 * 0.25, 1e-13);
}

}  // namespace
}  // namespace fsi::fluid
