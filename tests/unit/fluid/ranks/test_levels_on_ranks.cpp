/// A background with levels on several ranks: the same to the bit as on one, whoever has which rows.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tests/unit/fluid/gas_on_ranks.hpp"

namespace fsi::fluid {
namespace {

using test::MakeGas;

grid::GridDescription square(int n1, int n2, std::array<bool, 2> periodic) {
  grid::GridDescription grid = test::rectangle(n1, n2, {-1, -1}, {1, 1});
  grid.periodic1 = periodic[0], grid.periodic2 = periodic[1];
  return grid;
}

GasOptions adaptive_gas(int levels, double viscosity = 0) {
  return {.shock_viscosity = viscosity, .refine = {.levels = levels, .buffer = 1, .every = 3}};
}

/// Dense gas under pressure that a wind carries through the sides.
State small_blast(double x, double y, double /*t*/) {
  const bool inside = std::hypot(x - 0.5, y - 0.6) < 0.25;
  return {.rho = inside ? 3.0 : 1.0, .v1 = 0.8, .v2 = 0.5, .p = inside ? 20.0 : 1.0};
}

/// A shock that comes from the left to a body in a quiet gas.
State shock(double x, double /*y*/, double /*t*/) {
  return x < -2.2 ? State{2.667, 1.479, 0, 3.214} : State{1.0, 0.0, 0.0, 0.714};
}

TEST(LevelsOnRanks, ABlastThroughThePeriods) {
  for (const int levels : {2, 3}) {
    for (const std::array<bool, 2> periodic : {std::array{true, true}, {true, false}, {false, true}}) {
      const MakeGas make = [=] {
        const Boundary along = periodic[0] ? Boundary{Periodic{}} : Boundary{SlipWall{}},
                       across = periodic[1] ? Boundary{Periodic{}} : Boundary{Outflow{}};
        return test::solver(square(91, 82, periodic), adaptive_gas(levels), {along, along, across, across},
                            small_blast);
      };
      test::expect_same_on_ranks(make, 24);
    }
  }
}

TEST(LevelsOnRanks, MirrorsOpenSidesAndShockViscosity) {
  const MakeGas make = [] {
    GasSolver gas = test::solver(square(82, 109, {}), adaptive_gas(3, 0.5),
                                 {Symmetry{}, FarField{small_blast}, SlipWall{}, Symmetry{}}, small_blast);
    gas.note_edges();
    return gas;
  };
  test::expect_same_on_ranks(make, 24);
}

TEST(LevelsOnRanks, AMovingBodyAndAShock) {
  for (const int levels : {2, 3}) {
    const MakeGas make = [levels] {
      GasSolver gas = test::around_moving_body(adaptive_gas(levels), Dirichlet{shock}, {}, 109);
      gas.assign_initial_conditions(shock);
      return gas;
    };
    test::expect_same_on_ranks(make, 30);
  }
}

/// A few points in the middle are refined: rows beside the hole in the coarse level belong to several ranks, and the
/// last points of a run may be rounded otherwise than those in its middle.
TEST(LevelsOnRanks, RunsThatEndBesideRowsOfOthers) {
  const StateField noise = [](double x, double y, double) {
    const double a = std::sin(91.7 * x + 37.3 * y), b = std::cos(57.1 * x - 83.9 * y);
    return State{.rho = std::exp(3 * a), .v1 = 0.3 + 3 * b, .v2 = -0.2 + 3 * a * b, .p = std::exp(3 * b)};
  };
  const MakeGas make = [&] {
    GasOptions options = adaptive_gas(2);
    options.limiter = Limiter::none;
    options.refine.threshold = 0.5;
    options.refine.buffer = 0;
    return test::solver(square(91, 91, {true, true}), options,
                        {Periodic{}, Periodic{}, Periodic{}, Periodic{}}, noise);
  };
  test::expect_same_on_ranks(make, 12);
}

/// Every point another gas, as if by chance.
State wild(double x, double y, double /*t*/) {
  const auto chance = [&](double k) {
    const double far = 43758.5 * std::sin(127.1 * x + 311.7 * y + k);
    return far - std::floor(far);
  };
  return {.rho = std::pow(10, -4 * chance(0)),
          .v1 = 8 * chance(1) - 4,
          .v2 = 8 * chance(2) - 4,
          .p = std::pow(10, -4 * chance(3))};
}

/// Gas that second order leaves without density, at rims too.
TEST(LevelsOnRanks, PositiveFluxesAtRims) {
  const MakeGas make = [] {
    GasOptions options = adaptive_gas(2);
    options.riemann = Riemann::hllc;
    options.refine.threshold = 0.5;
    options.refine.buffer = 0;
    return test::solver(square(91, 91, {true, true}), options,
                        {Periodic{}, Periodic{}, Periodic{}, Periodic{}}, wild);
  };
  const GasSolver gas = make();
  for (const int level : {0, 1}) EXPECT_GT(gas.levels()->owned(level).points(), 100U) << level;
  test::expect_same_on_ranks(make, 60);
  EXPECT_GT(test::after_steps(make, 3, 60).at("grid0.positive_fluxes").front(), 0);
}

/// Counts how often a rank waits for others.
class CountingRanks final : public Ranks {
 public:
  explicit CountingRanks(std::shared_ptr<Ranks> ranks) : ranks_(std::move(ranks)) {}
  int reductions = 0, exchanges = 0;

  int rank() const override { return ranks_->rank(); }
  int size() const override { return ranks_->size(); }
  void exchange(std::span<const Parcel> sent, std::span<const Parcel> received) override {
    exchanges += sent.empty() && received.empty() ? 0 : 1;
    ranks_->exchange(sent, received);
  }
  void broadcast(std::vector<double>& values) override { ranks_->broadcast(values); }
  std::vector<double> together(std::span<const double> mine) override { return ranks_->together(mine); }
  void largest_of_each(std::span<double> values) override {
    ++reductions;
    ranks_->largest_of_each(values);
  }
  void leave() override { ranks_->leave(); }

 private:
  std::shared_ptr<Ranks> ranks_;
};

/// Four grids: one word about all of them. Averages of two levels come together; then halos; then each rim.
TEST(LevelsOnRanks, WaitOnceForAllGrids) {
  fsi::test::on_ranks(2, [&](const std::shared_ptr<Ranks>& mine) {
    GasOptions options = adaptive_gas(3);
    options.refine.every = 100;
    GasSolver gas = test::around_moving_body(options, Dirichlet{shock}, {}, 109);
    gas.assign_initial_conditions(shock);
    const auto counting = std::make_shared<CountingRanks>(mine);
    gas.share(counting, {});
    gas.apply_fluid_bcs(0);
    gas.look();
    const double dt = gas.compute_time_step().dt;
    const std::vector<double> x = test::body_outline(1e-3);
    gas.move_grids(1e-3, 1e-3, std::vector<grid::SideCommand>{{Side::top, x, 1}});
    counting->reductions = 0;
    gas.advance_fluid(1e-3, 1e-3);
    EXPECT_EQ(counting->reductions, 1);
    counting->exchanges = 0;
    gas.apply_fluid_bcs(1e-3);
    EXPECT_LE(counting->exchanges, 4);
    if (mine->first()) {
      EXPECT_GT(dt, 1e-3);
    }
  });
}

TEST(LevelsOnRanks, EveryLevelIsSharedOut) {
  fsi::test::on_ranks(4, [&](const std::shared_ptr<Ranks>& mine) {
    GasSolver gas = test::solver(square(163, 163, {}), adaptive_gas(3),
                                 {Outflow{}, Outflow{}, Outflow{}, Outflow{}}, small_blast);
    gas.share(mine, {});
    for (int k = 0; k < gas.grids(); ++k) {
      const auto [first, end] = gas.shared().rows(k).own;
      double here = 0;
      for (int j = first; j < end; ++j) {
        for (const grid::Interval& run : gas.discretised(k).row(j)) here += run.end - run.begin;
      }
      EXPECT_NEAR(here, static_cast<double>(gas.discretised(k).points()) / 4, 2.0 * gas.state(k).layout.n1);
    }
  });
}

/// Gas at rest far from a body that begins to move: averages are of gas as well, however deep below a finer level.
TEST(LevelsAroundABody, HaveNoValuesButThoseOfTheGas) {
  const StateField rest = [](double, double, double) { return State{1, 0, 0, 1}; };
  for (const int levels : {2, 3}) {
    GasOptions options = adaptive_gas(levels);
    options.refine.threshold = 0.9;  // levels are as far apart as they may be
    GasSolver gas = test::around_moving_body(options, FarField{rest}, {}, 145);
    gas.assign_initial_conditions(rest);
    gas.apply_fluid_bcs(0);
    double t = 0;
    for (int step = 0; step < 3; ++step) t = test::step_with_body(gas, t);
    for (int level = 1; level < levels; ++level) {
      const int k = static_cast<int>(gas.levels()->component(level));
      for (int j = 0; j < gas.state(k).layout.n2; ++j) {
        for (const grid::Interval& run : gas.valid(k).row(j)) {
          for (int i = run.begin; i < run.end; ++i) EXPECT_NEAR(gas.state(k)(0, i, j), 1, 1e-3);
        }
      }
    }
  }
}

}  // namespace
}  // namespace fsi::fluid
