/// A background of several levels that follow the gas: what one level keeps, several keep.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

constexpr double round_off_of_sums = 1e-12;  // of sums over some ten thousand points after some hundred steps

grid::GridDescription square(int n, bool periodic) {
  grid::GridDescription grid = test::rectangle(n, n, {-1, -1}, {1, 1});
  grid.periodic1 = grid.periodic2 = periodic;
  return grid;
}

constexpr int levels_2 = 2, levels_3 = 3;

GasOptions adaptive(int levels, Limiter limiter = Limiter::minmod) {
  return {.limiter = limiter, .refine = {.levels = levels}};
}

const std::array<Boundary, 4> periods{Periodic{}, Periodic{}, Periodic{}, Periodic{}};
const std::array<Boundary, 4> mirrors{Symmetry{}, Symmetry{}, Symmetry{}, Symmetry{}};

/// A round blob of dense gas, carried by a uniform stream through the corner of a period.
State blob(double x, double y, double /*t*/) {
  const bool inside = std::hypot(x - 0.6, y - 0.55) < 0.25;
  return {.rho = inside ? 2.0 : 1.0, .v1 = 0.7, .v2 = 0.4, .p = 0.9};
}

/// The same blob at rest under high pressure, beside a wall.
State blast(double x, double y, double /*t*/) {
  const bool inside = std::hypot(x - 0.6, y - 0.7) < 0.2;
  return {.rho = inside ? 2.0 : 1.0, .v1 = 0, .v2 = 0, .p = inside ? 10.0 : 1.0};
}

std::size_t advanced(const GasSolver& gas) {
  std::size_t points = 0;
  for (int k = 0; k < gas.grids(); ++k) points += gas.discretised(k).points();
  return points;
}

class Levels : public testing::TestWithParam<int> {};

TEST_P(Levels, FollowADenseBlobAndLeaveVelocityAndPressureUniform) {
  GasSolver gas = test::solver(square(109, true), adaptive(GetParam()), periods, blob);
  const grid::RowSets before = gas.levels()->owned(0);
  EXPECT_LT(advanced(gas), 109U * 109U / 2);
  test::run(gas, 1.0);
  EXPECT_NE(before, gas.levels()->owned(0)) << "the refined part has not moved";
  const State stream = blob(-1, -1, 0);
  const GasErrors errors = gas.errors([&](double, double, double) { return stream; }, 0);
  EXPECT_LT(errors.v1, round_off_of_sums);
  EXPECT_LT(errors.v2, round_off_of_sums);
  for (int k = 0; k < gas.grids(); ++k) {
    for (int j = 0; j < gas.grid(k).layout().n2; ++j) {
      for (const grid::Interval& run : gas.valid(k).row(j)) {
        for (int i = run.begin; i < run.end; ++i)
          ASSERT_NEAR(gas.state(k)(3, i, j), stream.p, round_off_of_sums);
      }
    }
  }
}

TEST_P(Levels, ConserveMassMomentumAndEnergyInAPeriod) {
  GasSolver gas =
      test::solver(square(109, true), adaptive(GetParam()), periods, [](double x, double y, double t) {
        State state = blast(x, y, t);
        state.v1 = 0.3;
        return state;
      });
  const Totals before = gas.totals();
  test::run(gas, 0.4);
  const Totals now = gas.totals();
  EXPECT_NEAR(now.mass, before.mass, round_off_of_sums * before.mass);
  EXPECT_NEAR(now.momentum1, before.momentum1, round_off_of_sums * before.mass);
  EXPECT_NEAR(now.momentum2, before.momentum2, round_off_of_sums * before.mass);
  EXPECT_NEAR(now.energy, before.energy, round_off_of_sums * before.energy);
}

/// Between two adaptations waves go so far that points deep in the refined part are given up.
TEST_P(Levels, ConserveWhereManyPointsAreGivenUpAtOnce) {
  GasOptions options = adaptive(GetParam());
  options.refine.every = 12;
  options.refine.buffer = 4;
  GasSolver gas = test::solver(square(325, true), options, periods, blast);
  const Totals before = gas.totals();
  test::run(gas, 0.2);
  const Totals now = gas.totals();
  EXPECT_NEAR(now.mass, before.mass, round_off_of_sums * before.mass);
  EXPECT_NEAR(now.momentum1, before.momentum1, round_off_of_sums * before.mass);
  EXPECT_NEAR(now.energy, before.energy, round_off_of_sums * before.energy);
}

TEST_P(Levels, ConserveMassAndEnergyBetweenMirrors) {
  // Gas that flows along and across the rims, to and from the mirrors.
  const StateField swept = [](double x, double y, double t) {
    State state = blast(x, y, t);
    state.v1 = 0.3 * std::cos(0.5 * test::pi * x);
    state.v2 = -0.2 * std::cos(0.5 * test::pi * y);
    return state;
  };
  GasSolver gas = test::solver(square(109, false), adaptive(GetParam()), mirrors, swept);
  ASSERT_LT(advanced(gas), 109U * 109U / 2);
  const Totals before = gas.totals();
  test::run(gas, 0.4);
  const Totals now = gas.totals();
  EXPECT_NEAR(now.mass, before.mass, round_off_of_sums * before.mass);
  EXPECT_NEAR(now.energy, before.energy, round_off_of_sums * before.energy);
  EXPECT_EQ(gas.health().floors, 0U);
}

/// Mean differences of the density to a uniform grid of 109 x 109 points: of levels, and of a uniform grid half as fine.
struct Differences {
  double levels = 0, coarse = 0;
};

Differences differences_in_a_blast(int levels, const std::array<Boundary, 4>& walls) {
  GasSolver uniform = test::solver(square(109, false), adaptive(1), walls, blast);
  GasSolver coarse = test::solver(square(55, false), adaptive(1), walls, blast);
  GasSolver gas = test::solver(square(109, false), adaptive(levels), walls, blast);
  for (GasSolver* each : {&uniform, &coarse, &gas}) test::run(*each, 0.4);
  Differences mean;
  const int n = 50;
  for (int k = 0; k < n * n; ++k) {
    const double x = -1 + 2 * (k % n + 0.5) / n,
                 y = -1 + 2 * (k / n + 0.5) / n;  // NOLINT(bugprone-integer-division)
    const double rho = uniform.probe(x, y)->rho;
    mean.levels += std::fabs(gas.probe(x, y)->rho - rho) / (n * n);
    mean.coarse += std::fabs(coarse.probe(x, y)->rho - rho) / (n * n);
  }
  return mean;
}

TEST_P(Levels, ShowABlastAsTheUniformGridOfTheirFinestSpacingDoes) {
  const Differences between_mirrors = differences_in_a_blast(GetParam(), mirrors);
  EXPECT_LT(between_mirrors.levels, 0.1 * between_mirrors.coarse);
  const Differences between_walls =
      differences_in_a_blast(GetParam(), {SlipWall{}, SlipWall{}, SlipWall{}, SlipWall{}});
  EXPECT_LT(between_walls.levels, 0.1 * between_walls.coarse);
  const Differences in_the_open =
      differences_in_a_blast(GetParam(), {Outflow{}, Outflow{}, Outflow{}, Outflow{}});
  EXPECT_LT(in_the_open.levels, 0.1 * in_the_open.coarse);
}

/// Of the cells between four points that a picture shows.
double shown_area(const GasSolver& gas, int grid) {
  const ConstFieldView x = gas.grid(grid).x();
  const std::vector<std::uint8_t> kinds = gas.kinds(grid);
  const auto shown = [&](int i, int j) { return kinds[static_cast<std::size_t>(j * x.layout.n1 + i)] != 0; };
  double area = 0;
  for (int j = 0; j + 1 < x.layout.n2; ++j) {
    for (int i = 0; i + 1 < x.layout.n1; ++i) {
      if (shown(i, j) && shown(i + 1, j) && shown(i, j + 1) && shown(i + 1, j + 1))
        area += (x(0, i + 1, j) - x(0, i, j)) * (x(1, i, j + 1) - x(1, i, j));
    }
  }
  return area;
}

TEST_P(Levels, AreShownByCellsThatTileTheRectangle) {
  for (const bool periodic : {false, true}) {
    GasSolver gas =
        test::solver(square(109, periodic), adaptive(GetParam()), periodic ? periods : mirrors, blast);
    test::run(gas, 0.2);
    double area = 0;
    for (int k = 0; k < gas.grids(); ++k) area += shown_area(gas, k);
    EXPECT_GT(shown_area(gas, 0), 0.1);
    EXPECT_GT(shown_area(gas, 1), 0.1);
    EXPECT_NEAR(area, 4, round_off_of_sums);
  }
}

TEST_P(Levels, GoOnFromACheckpointToTheBit) {
  GasSolver gas = test::solver(square(109, true), adaptive(GetParam()), periods, blob);
  GasSolver again = test::solver(square(109, true), adaptive(GetParam()), periods, blob);
  test::run(gas, 0.3);
  Archive saved;
  gas.archive(saved);
  Archive loaded(saved.entries());
  again.archive(loaded);
  loaded.check_all_loaded();
  EXPECT_EQ(again.levels()->owned(0), gas.levels()->owned(0));
  for (GasSolver* each : {&gas, &again}) {
    for (int step = 0; step < 30; ++step) {
      const double dt = each->compute_time_step().dt, t = each->time() + dt;
      each->move_grids(t, dt);
      each->advance_fluid(t, dt);
      each->apply_fluid_bcs(t);
    }
  }
  EXPECT_EQ(again.time(), gas.time());
  for (int k = 0; k < gas.grids(); ++k) {
    EXPECT_EQ(again.valid(k), gas.valid(k));
    for (int j = 0; j < gas.grid(k).layout().n2; ++j) {
      for (const grid::Interval& run : gas.valid(k).row(j)) {
        for (int plane = 0; plane < 4; ++plane) {
          const double *one = gas.state(k).row(plane, j), *other = again.state(k).row(plane, j);
          EXPECT_TRUE(std::equal(one + run.begin, one + run.end, other + run.begin));
        }
      }
    }
  }
}

/// Largest differences of level l, at the fine points around it and at its averages, to what the levels' functions make of
/// the next coarser and of the finer one.
std::pair<double, double> defects_at_rims(const GasSolver& gas, int l, double gamma) {
  const auto coarse = static_cast<int>(gas.levels()->component(l)),
             fine = static_cast<int>(gas.levels()->component(l - 1));
  const Layout &shape = gas.state(coarse).layout, &finer = gas.state(fine).layout;
  CellMask parents({shape.n1, shape.n2, {}}), not_covered = parents;
  mark_coarse(gas.valid(fine), parents);
  not_covered.add(gas.levels()->owned(l));
  parents.intersect(not_covered);
  Field made(finer, 4), averages(shape, 4);
  prolong_from(parents.rows(), gas.state(coarse), made.view(), gamma);
  restrict_to(gas.levels()->averaged(l), averages.view(), gas.state(fine), {}, gamma);
  const auto largest = [](const grid::RowSets& points, ConstFieldView one, ConstFieldView other) {
    double most = 0;
    for (int j = 0; j < points.rows(); ++j) {
      for (const grid::Interval& run : points.row(j)) {
        for (int i = run.begin; i < run.end; ++i) {
          for (int plane = 0; plane < 4; ++plane)
            most = std::max(most, std::fabs(one(plane, i, j) - other(plane, i, j)));
        }
      }
    }
    return most;
  };
  return {largest(refined(parents.rows(), finer.n1, finer.n2), gas.state(fine), made.view()),
          largest(gas.levels()->averaged(l), gas.state(coarse), averages.view())};
}

/// An adaptation completes the rims that are new as a step does all.
TEST_P(Levels, HaveCompleteRimsAfterEveryAdaptation) {
  GasOptions options = adaptive(GetParam());
  options.refine.every = 1;
  GasSolver gas = test::solver(square(109, false), options, mirrors, [](double x, double y, double) {
    const bool inside = std::hypot(x, y) < 0.2;
    return State{.rho = inside ? 2.0 : 1.0, .v1 = 0, .v2 = 0, .p = inside ? 10.0 : 1.0};
  });
  int adapted = 0;
  for (int step = 0; step < 20; ++step) {
    const grid::RowSets before = gas.levels()->owned(0);
    const double dt = gas.compute_time_step().dt, t = gas.time() + dt;
    gas.move_grids(t, dt);
    gas.advance_fluid(t, dt);
    gas.apply_fluid_bcs(t);
    if (before != gas.levels()->owned(0)) ++adapted;
    for (int l = 1; l < gas.levels()->levels(); ++l) {
      const auto [around, averages] = defects_at_rims(gas, l, options.gamma);
      EXPECT_LT(around, round_off_of_sums) << "level " << l << ", step " << step;
      EXPECT_LT(averages, round_off_of_sums) << "level " << l << ", step " << step;
    }
  }
  EXPECT_GT(adapted, 5);
}

INSTANTIATE_TEST_SUITE_P(TwoAndThree, Levels, testing::Values(levels_2, levels_3));

/// The threshold makes the rim cut through the vortex, which it follows.
TEST(LevelsThroughAVortex, KeepSecondOrder) {
  const test::Vortex vortex{.u = 1.0, .v = 0.6, .x_0 = -1, .y_0 = -1};
  std::vector<double> errors;
  for (const int n : {73, 145, 289}) {
    grid::GridDescription grid = test::rectangle(n, n, {-5, -5}, {5, 5});
    GasOptions options = adaptive(levels_2, Limiter::none);
    const double cells = 144.0 / (n - 1);
    options.refine.threshold = 0.02 * cells * cells;  // the same part of the vortex on all grids,
    options.refine.buffer = (n - 1) / 72;             // and the same band around it
    options.refine.every = 3;
    const std::array<Boundary, 4> given{Dirichlet{vortex}, Dirichlet{vortex}, Dirichlet{vortex},
                                        Dirichlet{vortex}};
    GasSolver gas = test::solver(grid, options, given, vortex);
    ASSERT_GT(gas.levels()->owned(0).points(), static_cast<std::size_t>(n * n / 100));
    ASSERT_LT(gas.levels()->owned(0).points(), static_cast<std::size_t>(n * n / 3));
    test::run(gas, 1.5);
    double sum = 0;
    for (int l = 0; l < levels_2; ++l) {
      const int k = static_cast<int>(gas.levels()->component(l));
      const ConstFieldView x = gas.grid(k).x();
      const double area = (x(0, 1, 0) - x(0, 0, 0)) * (x(1, 0, 1) - x(1, 0, 0));
      for (int j = 0; j < x.layout.n2; ++j) {
        for (const grid::Interval& run : gas.levels()->owned(l).row(j)) {
          for (int i = run.begin; i < run.end; ++i)
            sum += area * std::fabs(gas.state(k)(0, i, j) - vortex(x(0, i, j), x(1, i, j), 1.5).rho);
        }
      }
    }
    errors.push_back(sum);
  }
  EXPECT_GT(test::rate(errors), 1.9);
  EXPECT_LT(errors.back(), 2.5e-3);
}

}  // namespace
}  // namespace fsi::fluid
