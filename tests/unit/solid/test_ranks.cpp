// A solid on several ranks: all it depends on later is the same to the bit as with one.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
#include "solid_solver/neo_hookean_solver.hpp"
#include "tests/convergence/solid/disk.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"
#include "tests/unit/ranks/thread_ranks.hpp"

namespace fsi::solid {
namespace {
using Kinds = std::array<Condition, 4>;
using Solver = SolidSolver<NeoHookean>;
using MakeSolid = std::function<std::unique_ptr<Solver>()>;

const NeoHookean soft_law{.lambda = 1.1, .mu = 0.7};
constexpr SolidOptions fully_damped = {.rho = 1.3,
                                       .limiter = Limiter::minmod,
                                       .tangential_stress = {.rate = 0.5, .scaled = 0.1},
                                       .displacement = {.rate = 0.5, .scaled = 0.1},
                                       .relaxation = {.rate = 0.5, .scaled = 0.1},
                                       .bulk_diffusion = 0.25};

/// Every point another motion, in a body that is squeezed to 1 - squeeze of its lengths.
void shake(Solver& solver, double size, double squeeze = 0) {
  solver.assign_initial_conditions(
      [size, squeeze](double x, double y, double) -> Vec2 {
        return {0.02 * size * std::sin(3 * x + 2 * y) - squeeze * x,
                0.02 * size * std::cos(2 * x - 5 * y) - squeeze * y};
      },
      [size](double x, double y, double) -> Vec2 {
        return {size * std::sin(91.7 * x + 37.3 * y), size * std::cos(57.1 * x - 83.9 * y)};
      });
}

/// A skewed block of other than as many points one way as the other.
std::unique_ptr<Solver> block(const Kinds& kinds, int n1, int n2,
                              const SolidOptions& options = fully_damped) {
  Boundaries boundaries;
  for (std::size_t side = 0; side < 4; ++side) {
    boundaries[side].condition = kinds[side];
    if (kinds[side] == Traction::condition) {
      boundaries[side].vector = [](double x, double y, double t) -> Vec2 {
        return {-0.02 * y, 0.01 + 0.05 * t * x};
      };
    }
  }
  grid::GridDescription grid{
      .name = "block", .n1 = n1, .n2 = n2, .mapping = [](double r, double s, double) -> Vec2 {
        return {r + 0.1 * s, s + 0.05 * r};
      }};
  grid.periodic1 = kinds[0] == Periodic::condition;
  grid.periodic2 = kinds[2] == Periodic::condition;
  if (grid.periodic1 || grid.periodic2)
    grid.mapping = [](double r, double s, double) -> Vec2 { return {r, s}; };
  auto solver =
      std::make_unique<Solver>(grid::MovingGrid(std::move(grid), 0), soft_law, options, boundaries, 0);
  shake(*solver, 0.02);
  return solver;
}

std::unique_ptr<Solver> disk(Condition rim_kind) {
  Boundary rim;
  rim.condition = rim_kind;
  test::DiskGrids grids = test::disk_of(20, std::move(rim));
  auto solver = std::make_unique<Solver>(std::move(grids.parts), grids.bodies, soft_law, fully_damped, 0);
  shake(*solver, 0.01);
  return solver;
}

/// Interfaces that are told what they show, a little damped: the coupler's part.
struct Shown {
  std::vector<double> n, v_n, w_n;
};

Shown shown(const Solver& solver, Side side, int grid) {
  SolidInterface state;
  solver.interface_state(side, state, grid);
  const std::size_t points = state.x.size() / 2;
  Shown told;
  told.n.resize(2 * points);
  for (std::size_t k = 0; k < points; ++k) {
    const Vec2 n0 = [&] {
      const std::vector<double> x = solver.grid(grid).side_points(side);
      return Vec2(x[k] - 0.4, x[points + k] - 0.45).normalized();
    }();
    told.n[k] = n0.x();
    told.n[points + k] = n0.y();
    told.v_n.push_back(0.9 * (n0.x() * state.v[k] + n0.y() * state.v[points + k]));
    told.w_n.push_back(0.8 * (n0.x() * state.w[k] + n0.y() * state.w[points + k]));
  }
  return told;
}

/// A step of all ranks: what rank 0 sees of the interfaces, all are told.
double step(Solver& solver, Ranks& ranks, double t, Look look) {
  const double dt = solver.compute_time_step().dt;
  solver.advance_solid(t, dt, look);
  std::vector<Shown> told;
  std::vector<InterfaceValues> values;
  for (int grid = 0; grid < solver.grids(); ++grid) {
    for (const Side side : all_sides) {
      if (solver.condition(side, grid) != Interface::condition) continue;
      Shown one;
      if (ranks.first()) one = shown(solver, side, grid);
      for (std::vector<double>* list : {&one.n, &one.v_n, &one.w_n}) ranks.broadcast(*list);
      told.push_back(std::move(one));
      values.push_back({.side = side, .n = {}, .v_n = {}, .w_n = {}, .grid = grid});
    }
  }
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k].n = told[k].n, values[k].v_n = told[k].v_n, values[k].w_n = told[k].w_n;
  solver.apply_solid_bcs(t + dt, values);
  return t + dt;
}

/// Everything that a checkpoint would hold after some steps, and where the body then is.
Archive::Entries after_steps(const MakeSolid& make, int ranks, int steps, int recut_every = 0) {
  Archive::Entries entries;
  fsi::test::on_ranks(ranks, [&](const std::shared_ptr<Ranks>& mine) {
    const std::unique_ptr<Solver> solver = make();
    solver->share(mine, {.every = recut_every});
    solver->apply_solid_bcs(0);
    double t = 0;
    for (int k = 0; k < steps; ++k) t = step(*solver, *mine, t, k % 2 == 0 ? Look::soundness : Look::all);
    const Pose pose = solver->pose();
    solver->collect_all();
    Archive archive;
    solver->archive(archive);
    if (!mine->first()) return;
    entries = archive.entries();
    entries["pose"] = {pose.centre.x(), pose.centre.y(), pose.velocity.x(), pose.velocity.y(), pose.angle};
  });
  return entries;
}

void expect_same(const Archive::Entries& one, const Archive::Entries& other, const std::string& what) {
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [name, values] : one) {
    const std::vector<double>& others = other.at(name);
    ASSERT_EQ(values.size(), others.size()) << name;
    std::size_t different = 0;
    for (std::size_t k = 0; k < values.size(); ++k) different += values[k] == others[k] ? 0U : 1U;
    EXPECT_EQ(different, 0U) << name << ", " << what;
  }
}

void expect_same_on_ranks(const MakeSolid& make, int steps) {
  const Archive::Entries whole = after_steps(make, 1, steps);
  ASSERT_FALSE(whole.empty());
  for (const int ranks : {2, 3, 7, 13})
    expect_same(whole, after_steps(make, ranks, steps), std::to_string(ranks) + " ranks");
  expect_same(whole, after_steps(make, 4, steps, 3), "4 ranks with new rows every 3 steps");
}

class SolidOnRanks : public testing::TestWithParam<Kinds> {};

TEST_P(SolidOnRanks, OneGrid) {
  for (const auto& [n1, n2] : {std::pair(17, 29), {29, 13}})
    expect_same_on_ranks([&, n1 = n1, n2 = n2] { return block(GetParam(), n1, n2); }, 10);
}

/// Where upwinding of the stress is softened; squeezed bodies spring back.
TEST_P(SolidOnRanks, OneGridUnderPressure) {
  const auto squeezed = [&] {
    auto solver = block(GetParam(), 17, 29);
    shake(*solver, 0.02, 0.05);
    return solver;
  };
  expect_same_on_ranks(squeezed, 6);
  const Archive::Entries entries = after_steps(squeezed, 3, 6);
  double coupled = 0;
  for (const auto& [name, values] : entries) {
    if (name.ends_with("coupled")) coupled += values.front();
  }
  EXPECT_EQ(coupled, 1);
}

INSTANTIATE_TEST_SUITE_P(
    EveryKindOfSide, SolidOnRanks,
    testing::Values(
        Kinds{Traction::condition, Traction::condition, Traction::condition, Traction::condition},
        Kinds{Displacement::condition, Traction::condition, SlipWall::condition, Traction::condition},
        Kinds{Interface::condition, Displacement::condition, Symmetry::condition, Interface::condition},
        Kinds{SlipWall::condition, Interface::condition, Displacement::condition, Symmetry::condition},
        Kinds{Interface::condition, Interface::condition, Periodic::condition, Periodic::condition},
        Kinds{Periodic::condition, Periodic::condition, Displacement::condition, Traction::condition},
        Kinds{Interface::condition, Traction::condition, Displacement::condition, SlipWall::condition}),
    [](const auto& kinds) { return "Set" + std::to_string(kinds.index); });

TEST(SolidOnSeveralRanks, OverlappingGrids) {
  for (const Condition rim : {Interface::condition, Traction::condition})
    expect_same_on_ranks([rim] { return disk(rim); }, 8);
}

/// A body whose motion is chosen: sources in all equations, here those that leave it as it is.
TEST(SolidOnSeveralRanks, AChosenSolution) {
  const MakeSolid make = [] {
    auto solver = block(
        {Traction::condition, Displacement::condition, SlipWall::condition, Traction::condition}, 15, 23);
    solver->choose(
        {.state =
             [](double x, double y, double t) {
               return SolidState{.u = {0.01 * x * t, 0.02 * y * t}, .v = {0.01 * x, 0.02 * y}, .P = {}};
             },
         .source =
             [](double x, double y, double t) {
               return SolidState{.u = {0.1 * y, 0.2 * t}, .v = {x, -y * t}, .P = {0.1 * x, y, 0.2, x}};
             },
         .offset =
             [](double x, double y, double t) {
               return Tensor2{0.01 * x, 0.02 * y, 0.01 * t, 0};
             }});
    shake(*solver, 0.01);
    return solver;
  };
  expect_same_on_ranks(make, 8);
}

TEST(SolidOnSeveralRanks, SidePointsWithoutWavesAreCountedOnce) {
  const MakeSolid make = [] {
    auto solver = block(
        {Displacement::condition, Displacement::condition, Displacement::condition, Displacement::condition},
        15, 23);
    // Wide one way, narrow the other: log J > 1 + mu (1 + F11^2) / lambda, and no p-waves go the narrow way.
    solver->assign_initial_conditions([](double x, double y, double) { return Vec2(-0.5 * x, 19 * y); },
                                      [](double x, double y, double) { return Vec2(y, x); });
    return solver;
  };
  const auto counted = [&make](int ranks) {
    const Archive::Entries entries = after_steps(make, ranks, 0);
    const auto found = std::ranges::find_if(
        entries, [](const auto& entry) { return entry.first.ends_with("boundary.waveless"); });
    return found == entries.end() ? -1 : found->second.front();
  };
  EXPECT_GT(counted(1), 20);
  for (const int ranks : {2, 3, 7, 13}) EXPECT_EQ(counted(ranks), counted(1)) << ranks;
}

TEST(SolidOnSeveralRanks, NumbersBreakOnAllOfThemAlike) {
  const auto broken = [](int ranks, const MakeSolid& make) {
    std::string words;
    fsi::test::on_ranks(ranks, [&](const std::shared_ptr<Ranks>& mine) {
      const std::unique_ptr<Solver> solver = make();
      solver->share(mine, {});
      solver->apply_solid_bcs(0);
      try {
        for (int k = 0; k < 50; ++k) {
          solver->advance_solid(k, 1);
          solver->apply_solid_bcs(k + 1);
        }
      } catch (const Diverged& failure) {
        if (mine->rank() == mine->size() - 1) words = failure.what();
      }
    });
    return words;
  };
  for (const MakeSolid& make :
       {MakeSolid([] {
          return block({SlipWall::condition, SlipWall::condition, SlipWall::condition, SlipWall::condition},
                       15, 21);
        }),
        MakeSolid([] { return disk(Traction::condition); })}) {
    EXPECT_NE(broken(1, make), "");
    EXPECT_EQ(broken(1, make), broken(4, make));
  }
}

}  // namespace
}  // namespace fsi::solid
