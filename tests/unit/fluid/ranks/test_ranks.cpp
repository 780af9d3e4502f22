/// A gas on several ranks: all it depends on later is the same to the bit as with one.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "tests/unit/fluid/gas_on_ranks.hpp"

namespace fsi::fluid {
namespace {

using test::after_steps;
using test::expect_same_on_ranks;
using test::MakeGas;

/// A shock from the left, into gas of hardly any pressure.
StateField strong_shock() {
  return [](double x, double, double) { return x < -1.6 ? State{4, 5, 0, 40} : State{1, 0, 0, 1e-3}; };
}

/// Every point another gas.
StateField noise(double size) {
  return [size](double x, double y, double) {
    const double a = std::sin(91.7 * x + 37.3 * y), b = std::cos(57.1 * x - 83.9 * y);
    return State{
        .rho = std::exp(size * a), .v1 = 0.3 + size * b, .v2 = -0.2 + size * a * b, .p = std::exp(size * b)};
  };
}

TEST(GasOnRanks, AShockMeetsAMovingBody) {
  const MakeGas make = [] {
    GasSolver gas = test::around_moving_body({}, Dirichlet{strong_shock()});
    gas.assign_initial_conditions(strong_shock());
    gas.note_edges();
    return gas;
  };
  expect_same_on_ranks(make, 40);
}

TEST(GasOnRanks, PositiveFluxesAcrossTheirBorders) {
  const MakeGas make = [] {
    grid::GridDescription box = test::wavy(33, 33, {0, 0}, {1, 1});
    box.periodic1 = box.periodic2 = true;
    return test::solver(box, {.limiter = Limiter::none}, {Periodic{}, Periodic{}, Periodic{}, Periodic{}},
                        noise(3));
  };
  expect_same_on_ranks(make, 12);
  const Archive::Entries entries = after_steps(make, 3, 12);
  for (const char* counted : {"first_order", "positive_fluxes"})
    EXPECT_GT(entries.at(std::string("grid0.") + counted).front(), 0) << counted;
}

TEST(GasOnRanks, WallsMirrorsAndOpenSides) {
  for (const double viscosity : {0.0, 0.5}) {
    const MakeGas make = [viscosity] {
      return test::solver(test::wavy(29, 23, {-1, -1}, {1, 1}), {.shock_viscosity = viscosity},
                          {SlipWall{}, Outflow{}, Symmetry{}, FarField{noise(0.1)}}, noise(0.1));
    };
    expect_same_on_ranks(make, 15);
    const MakeGas turned = [viscosity] {
      return test::solver(test::wavy(23, 29, {-1, -1}, {1, 1}), {.shock_viscosity = viscosity},
                          {Symmetry{}, FarField{noise(0.1)}, Outflow{}, SlipWall{}}, noise(0.1));
    };
    expect_same_on_ranks(turned, 15);
  }
}

TEST(GasOnRanks, BoundsAtSidesAreCountedOnce) {
  const MakeGas make = [] {
    return test::solver(
        test::wavy(29, 23, {-1, -1}, {1, 1}), {}, {SlipWall{}, Outflow{}, SlipWall{}, SlipWall{}},
        [](double x, double y, double) {
          return State{1, -8 * x, y < 0 ? -6.0 : 6.0, 1};  // away from all sides, or into them
        });
  };
  expect_same_on_ranks(make, 6);
  EXPECT_GT(after_steps(make, 3, 6).at("grid0.bounded_side_points").front(), 0);
}

TEST(GasOnRanks, ShockViscosityAroundABody) {
  const MakeGas make = [] {
    GasSolver gas = test::around_moving_body({.shock_viscosity = 0.5}, Dirichlet{noise(0.2)});
    gas.assign_initial_conditions(noise(0.2));
    return gas;
  };
  expect_same_on_ranks(make, 10);
}

TEST(GasOnRanks, TheSameTimeStepHealthAndProbes) {
  const auto seen = [](int ranks) {
    std::string words;
    fsi::test::on_ranks(ranks, [&](const std::shared_ptr<Ranks>& mine) {
      GasSolver gas = test::around_moving_body({}, Dirichlet{noise(0.2)});
      gas.assign_initial_conditions(noise(0.2));
      gas.share(mine, {});
      gas.apply_fluid_bcs(0);
      const double t = test::step_with_body(gas, 0);
      test::step_with_body(gas, t);
      gas.look();
      std::vector<Strip> strips;
      for (const double x : {-1.3, 1.25, 2.0}) {
        const std::vector<Strip> cells = gas.probe_strips(x, 0.4);
        strips.insert(strips.end(), cells.begin(), cells.end());
      }
      gas.fetch(strips);
      if (!mine->first()) return;
      const Health health = gas.health();
      words = gas.compute_time_step().reason + fmt::format(" {} {}", health.min_rho, health.min_p);
      for (const double x : {-1.3, 1.25, 2.0})
        words += fmt::format(" {}", gas.probe(x, 0.4).value_or(State{}).p);
    });
    return words;
  };
  EXPECT_EQ(seen(1), seen(3));
  EXPECT_EQ(seen(1), seen(5));
}

TEST(GasOnRanks, NumbersBreakOnAllOfThemAlike) {
  const auto broken = [](int ranks) {
    std::string words;
    fsi::test::on_ranks(ranks, [&](const std::shared_ptr<Ranks>& mine) {
      GasSolver gas = test::solver(test::rectangle(21, 21, {-1, -1}, {1, 1}), {.limiter = Limiter::none},
                                   {Outflow{}, Outflow{}, Outflow{}, Outflow{}}, noise(0.1));
      gas.share(mine, {});
      gas.apply_fluid_bcs(0);
      try {
        gas.move_grids(1e3, 1e3, {});
        gas.advance_fluid(1e3, 1e3);
      } catch (const Diverged& failure) {
        if (mine->rank() == mine->size() - 1) words = failure.what();
      }
    });
    return words;
  };
  EXPECT_NE(broken(1), "");
  EXPECT_EQ(broken(1), broken(4));
}

TEST(RowCuts, GiveEveryRowToOneRankAndHalosAroundThem) {
  const grid::RowSets all = grid::all_points(10, 40), few = grid::all_points(50, 6);
  const std::vector<CutGrid> grids{{Layout(10, 40), true, &all}, {Layout(50, 6), false, &few}};
  for (const Pieces pieces : {Pieces::of_all_grids, Pieces::of_each_grid}) {
    for (const double shift : {0.0, 0.4}) {
      const Cut cut(grids, 5, pieces, shift);
      for (int grid = 0; grid < 2; ++grid) {
        int next = 0;
        for (int rank = 0; rank < 5; ++rank) {
          const grid::RowRange own = cut.own(grid, rank);
          if (own.first >= own.end) continue;
          EXPECT_EQ(own.first, next);
          next = own.end;
          for (int j = own.first; j < own.end; ++j) EXPECT_EQ(cut.owner(grid, j), rank);
        }
        EXPECT_EQ(next, grids[static_cast<std::size_t>(grid)].layout.n2);
      }
      EXPECT_EQ(cut.owner(0, -2), cut.owner(0, 0));
      EXPECT_EQ(cut.owner(1, 7), cut.owner(1, 5));
    }
  }
  const Cut even(grids, 5);
  EXPECT_LT(even.imbalance(grids), 1.3);
  // Row 39 is row 0 once more, so who has row 0 has the other end as well.
  EXPECT_EQ(even.halos(0, 0).at(1), (grid::RowRange{36, 40}));
}

/// One grid after the other, the busiest rank of each is what all wait for.
TEST(RowCuts, OfEachGridShareEachOfThemOut) {
  const grid::RowSets all = grid::all_points(10, 40), half = grid::all_points(10, 20);
  const std::vector<CutGrid> grids{{Layout(10, 40), false, &all}, {Layout(10, 20), false, &half}};
  const Cut cut(grids, 4, Pieces::of_each_grid);
  for (int rank = 0; rank < 4; ++rank) {
    EXPECT_EQ(cut.own(0, rank), (grid::RowRange{10 * rank, 10 * rank + 10}));
    EXPECT_EQ(cut.own(1, rank), (grid::RowRange{5 * rank, 5 * rank + 5}));
  }
  EXPECT_DOUBLE_EQ(cut.imbalance(grids), 1);
  const Cut shifted(grids, 4, Pieces::of_each_grid,
                    0.4);  // the pieces end at 6, 24 and 26 rows, and at half of that
  EXPECT_DOUBLE_EQ(shifted.imbalance(grids), 4 * (18 + 9) / 60.0);
}

}  // namespace
}  // namespace fsi::fluid
