// A body on overlapping grids: what it keeps, what it is asked for, and what it shows.

#include <gtest/gtest.h>

#include <numbers>

#include "common/core/failure.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
#include "tests/convergence/solid/disk.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid {
namespace {

constexpr SolidOptions full_damping = {.rho = 1.4,
                                       .limiter = Limiter::minmod,
                                       .tangential_stress = {.rate = 0.5, .scaled = 0.1},
                                       .displacement = {.rate = 0.5, .scaled = 0.1},
                                       .relaxation = {.rate = 0.5, .scaled = 0.1},
                                       .bulk_diffusion = 0.25};

template <class L>
SolidSolver<L> disk_solver(int cells, Boundary rim = {}, const SolidOptions& options = full_damping) {
  test::DiskGrids disk = test::disk_of(cells, std::move(rim));
  return {std::move(disk.parts), disk.bodies, L{.lambda = 1, .mu = 1}, options, 0};
}

Vec2 at_rest(double /*x*/, double /*y*/, double /*t*/) {
  return Vec2::Zero();
}

template <class L>
class Eq36RigidTranslationOfADisk : public testing::Test {};
using Laws = testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(Eq36RigidTranslationOfADisk, Laws);

TYPED_TEST(Eq36RigidTranslationOfADisk, StaysExactOnTwoGridsEq37) {
  const Vec2 velocity(0.7, -0.4);
  const StateFunction exact = [=](double, double, double t) {
    return SolidState{.u = velocity * t, .v = velocity, .P = {}};
  };
  Boundary interface;
  interface.condition = Interface::condition;
  for (const Boundary& rim : {Boundary{}, interface}) {
    auto solver = disk_solver<TypeParam>(12, rim);
    solver.assign_initial_conditions(exact);
    double t = 0;
    for (int step = 0; step < 60; ++step) {
      const double dt = solver.compute_time_step().dt;
      solver.advance_solid(t, dt);
      t += dt;
      solver.apply_solid_bcs(t);
    }
    const Errors errors = solver.errors(exact, t);
    // Round-off of u = O(1), amplified by 1/h in the strains: 12 * 1e-16 a step.
    EXPECT_LT(errors.u, 1e-12);
    EXPECT_LT(errors.v, 1e-12);
    EXPECT_LT(errors.P, 1e-12);
    const Pose pose = solver.pose();
    EXPECT_NEAR((pose.centre - velocity * t).norm(), 0, 1e-3);  // second order in h
    EXPECT_NEAR((pose.velocity - velocity).norm(), 0, 1e-12);
    EXPECT_NEAR(pose.angle, 0, 1e-12);
  }
}

/// The upper half of a disk on the wall y = 0: both grids end there, and so do their interpolated points.
TYPED_TEST(Eq36RigidTranslationOfADisk, StaysExactWhereBothGridsEndOnASlipWall) {
  constexpr int cells = 16, points = 51, lines = 9;
  const grid::PlaneCurve arc{
      .ends = grid::Curve::open,
      .position =
          [](double s) { return Vec2(std::cos(std::numbers::pi * s), std::sin(std::numbers::pi * s)); },
      .slope = [](double s) -> Vec2 {
        return std::numbers::pi * Vec2(-std::sin(std::numbers::pi * s), std::cos(std::numbers::pi * s));
      }};
  const grid::HyperbolicGrid arch{.name = "arch",
                                  .points = points,
                                  .lines = lines,
                                  .ends = grid::Curve::open,
                                  .spacing = 1.0 / cells,
                                  .walls = {Vec2(1, 0), Vec2(1, 0)}};
  Boundaries inside, sides;
  for (Boundary& boundary : inside) boundary.condition = no_condition;
  inside[2].condition = sides[0].condition = sides[1].condition = SlipWall::condition;
  sides[3].condition = no_condition;
  std::vector<SolidPart> parts;
  parts.push_back({grid::MovingGrid({.name = "inside",
                                     .n1 = 41,
                                     .n2 = 21,
                                     .mapping = [](double r, double s, double) -> Vec2 {
                                       return {-1.25 + 2.5 * r, 1.25 * s};
                                     }},
                                    0),
                   inside});
  parts.push_back({grid::MovingGrid(grid::marched_from(arch, grid::points_on(arc, points)), 0), sides});
  const grid::BodyFittedGrid body{.name = "arch", .n1 = points, .n2 = lines, .ends = grid::Curve::open};
  SolidSolver<TypeParam> solver(std::move(parts), {body}, TypeParam{.lambda = 1, .mu = 1}, full_damping, 0);
  const StateFunction sliding = [](double, double, double t) {
    return SolidState{.u = Vec2(0.6 * t, 0), .v = Vec2(0.6, 0), .P = {}};
  };
  solver.assign_initial_conditions(sliding);
  double t = 0;
  for (int step = 0; step < 60; ++step) {
    const double dt = solver.compute_time_step().dt;
    solver.advance_solid(t, dt);
    solver.apply_solid_bcs(t += dt);
  }
  const Errors errors = solver.errors(sliding, t);
  EXPECT_LT(errors.u, 1e-12);
  EXPECT_LT(errors.v, 1e-12);
  EXPECT_LT(errors.P, 1e-12);
}

TEST(CompositeSolid, AsksForInitialValuesInsideTheBodyOnly) {
  auto solver = disk_solver<NeoHookean>(10);
  double farthest = 0;
  const VectorFunction u = [&](double x, double y, double) -> Vec2 {
    farthest = std::max(farthest, std::hypot(x, y));
    return {0.01 * x * y, 0};
  };
  solver.assign_initial_conditions(u, at_rest);
  EXPECT_LE(farthest, 1 + 1e-14);
  solver.assign_initial_conditions(
      [&](double x, double y, double t) { return SolidState{.u = u(x, y, t), .v = Vec2::Zero(), .P = {}}; });
  EXPECT_LE(farthest, 1 + 1e-14);
  EXPECT_EQ(solver.points(), solver.composite()->valid(0).points() + solver.composite()->valid(1).points());
}

TEST(CompositeSolid, IgnoresTheValuesOfUnusedPoints) {
  auto clean = disk_solver<NeoHookean>(10), spoilt = disk_solver<NeoHookean>(10);
  const VectorFunction v = [](double x, double y, double) -> Vec2 { return {0.2 * x * y, 0.1 * y}; };
  for (SolidSolver<NeoHookean>* solver : {&clean, &spoilt}) solver->assign_initial_conditions(at_rest, v);
  const FieldView q = spoilt.state(0);
  for (int j = -2; j < q.layout.n2 + 2; ++j) {
    for (int i = -2; i < q.layout.n1 + 2; ++i) {
      if (spoilt.composite()->kind(0, std::max(i, 0), std::max(j, 0)) != grid::PointKind::unused) continue;
      for (int k = 0; k < plane::count; ++k) q(k, i, j) = std::nan("");
    }
  }
  double t = 0;
  for (int step = 0; step < 20; ++step) {
    const double dt = clean.compute_time_step().dt;
    for (SolidSolver<NeoHookean>* solver : {&clean, &spoilt}) {
      solver->advance_solid(t, dt);
      solver->apply_solid_bcs(t + dt);
    }
    t += dt;
  }
  for (int g = 0; g < 2; ++g) {
    const ConstFieldView a = clean.state(g), b = spoilt.state(g);
    for (int j = 0; j < a.layout.n2; ++j) {
      for (const grid::Interval& run : clean.composite()->valid(g).row(j)) {
        for (int i = run.begin; i < run.end; ++i) ASSERT_EQ(a(plane::P12, i, j), b(plane::P12, i, j));
      }
    }
  }
}

TEST(CompositeSolid, ProbesFindLinearFieldsOnBothGrids) {
  auto solver = disk_solver<LinearElastic>(12);
  solver.assign_initial_conditions(
      [](double x, double y, double) -> Vec2 {
        return {0.01 * x, 0.02 * y};
      },
      at_rest);
  const ProbePoint middle = solver.locate(0.11, -0.07), rim = solver.locate(-0.6, 0.75);
  EXPECT_EQ(middle.grid, 0);
  EXPECT_EQ(rim.grid, 1);
  EXPECT_NEAR(solver.value(middle).u.y(), -0.0014, 1e-13);
  EXPECT_NEAR(solver.value(rim).u.x(), -0.006, 1e-13);
  EXPECT_THROW(solver.locate(0.9, 0.9), UserMistake);
}

TEST(Totals, OfASpinningDiskCountTheOverlapOnceToSecondOrder) {
  for (const int cells : {20, 40}) {
    auto solver = disk_solver<NeoHookean>(cells, {}, {.rho = 3});
    solver.assign_initial_conditions(at_rest, [](double x, double y, double) -> Vec2 { return {-y, x}; });
    const Totals totals = solver.totals();
    // The trapezoidal rule at the rim adds at most h^2 / 6 of the mass and h^2 of the second moment.
    const double h2 = 1.0 / (cells * cells), mass = 3 * std::numbers::pi;
    EXPECT_NEAR(totals.mass, mass, mass * h2 / 6);
    EXPECT_NEAR(totals.angular_momentum, mass / 2, mass / 2 * h2);
    EXPECT_NEAR(totals.kinetic_energy, mass / 4, mass / 4 * h2);
    EXPECT_NEAR(totals.momentum.norm(), 0, mass * h2 / 6);
    EXPECT_NEAR(totals.strain_energy, 0, 1e-13);
    EXPECT_NEAR(solver.pose().velocity.norm(), 0, h2 / 6);
  }
}

TEST(Totals, OfAStretchedDiskHaveTheStrainEnergyOfTheLaw) {
  const LinearElastic law{.lambda = 1, .mu = 1};
  auto solver = disk_solver<LinearElastic>(20);
  solver.assign_initial_conditions(
      [](double x, double y, double) -> Vec2 {
        return {0.1 * x + 0.05 * y, 0};
      },
      at_rest);
  const double exact = std::numbers::pi * law.psi({1.1, 0.05, 0, 1});
  EXPECT_NEAR(solver.totals().strain_energy, exact, exact / 400 / 6);
}

TEST(CompositeSolid, InterfacePointsAreThoseOfTheOutline) {
  Boundary rim;
  rim.condition = Interface::condition;
  auto solver = disk_solver<NeoHookean>(10, rim);
  solver.assign_initial_conditions(at_rest, [](double x, double y, double) -> Vec2 { return {x, y}; });
  SolidInterface state;
  solver.interface_state(Side::bottom, state, 1);
  const std::size_t n = state.x.size() / 2;
  ASSERT_EQ(n, static_cast<std::size_t>(solver.grid(1).side_size(Side::bottom)));
  std::vector<double> normal(2 * n), v_n(n, 0.3), w_n(n, -0.1);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(std::hypot(state.x[k], state.x[n + k]), 1, 1e-14);
    normal[k] = state.x[k], normal[n + k] = state.x[n + k];
  }
  const InterfaceValues values[] = {{.side = Side::bottom, .n = normal, .v_n = v_n, .w_n = w_n, .grid = 1}};
  solver.apply_solid_bcs(0, values);
  solver.interface_state(Side::bottom, state, 1);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(state.v[k] * normal[k] + state.v[n + k] * normal[n + k], 0.3, 1e-14);
    EXPECT_NEAR(state.w[k] * normal[k] + state.w[n + k] * normal[n + k], -0.1, 1e-3);  // polygon's normals
  }
  const SideLoad load = solver.side_load(Side::bottom, 1);
  EXPECT_NEAR(load.force.norm(), 0, 1e-12);
  // Central differences shorten the circle by at most (0.102 rad)^2 / 6.
  const double power = -0.1 * 0.3 * 2 * std::numbers::pi;
  EXPECT_NEAR(load.power, power, -power * 0.102 * 0.102 / 6);
}

TEST(CompositeSolid, BrokenNumbersNameTheGrid) {
  auto solver = disk_solver<NeoHookean>(10, {}, {});
  solver.assign_initial_conditions(at_rest, [](double x, double y, double) -> Vec2 {
    return {std::hypot(x - 0.2, y) < 0.1 ? 20.0 : 0.0, 0};
  });
  try {
    double t = 0;
    for (int step = 0; step < 50; ++step) {
      const double dt = solver.compute_time_step().dt;
      solver.advance_solid(t, dt);
      solver.apply_solid_bcs(t += dt);
    }
    FAIL() << "a velocity of twelve times the wave speed must break the material";
  } catch (const Diverged& failure) {
    EXPECT_NE(std::string(failure.what()).find("grid \"inside\", point ("), std::string::npos)
        << failure.what();
  }
}

TEST(CompositeSolid, GridsThatDoNotFitTogetherAreTheUsersMistake) {
  const auto refused = [](auto&& change) {
    test::DiskGrids disk = test::disk_of(10, {});
    change(disk);
    EXPECT_THROW(SolidSolver<NeoHookean>(std::move(disk.parts), disk.bodies, {.lambda = 1, .mu = 1}, {}, 0),
                 UserMistake);
  };
  refused([](test::DiskGrids& disk) { disk.bodies.clear(); });
  refused([](test::DiskGrids& disk) { ++disk.bodies[0].n1; });
  refused([](test::DiskGrids& disk) { disk.parts[1].boundaries[3].condition = Traction::condition; });
  refused([](test::DiskGrids& disk) { disk.bodies[0].ends = grid::Curve::open; });
  refused([](test::DiskGrids& disk) { std::swap(disk.parts[0], disk.parts[1]); });
}

/// All values of both grids.
std::vector<double> values_of(const SolidSolver<NeoHookean>& solver) {
  std::vector<double> values;
  for (int grid = 0; grid < solver.grids(); ++grid) {
    const ConstFieldView q = solver.state(grid);
    for (int k = 0; k < plane::count; ++k) {
      for (int j = 0; j < q.layout.n2; ++j) {
        for (int i = 0; i < q.layout.n1; ++i) values.push_back(q(k, i, j));
      }
    }
  }
  return values;
}

/// Makes the outer grid break in the next step and takes that.
std::vector<double> change_in_a_step_that_breaks(SolidSolver<NeoHookean>& solver) {
  const double dt = solver.compute_time_step().dt;
  solver.state(1)(plane::u1, 10, 4) += 1;  // ten cells
  std::vector<double> before = values_of(solver);
  EXPECT_THROW(solver.advance_solid(0, dt), Diverged);
  EXPECT_EQ(solver.t(), 0);
  EXPECT_EQ(solver.steps(), 0U);
  const std::vector<double> after = values_of(solver);
  for (std::size_t k = 0; k < before.size(); ++k) before[k] -= after[k];
  return before;
}

TEST(CompositeSolid, KeepsEveryGridWhereItWasWhenOneBreaks) {
  auto solver = disk_solver<NeoHookean>(10);
  solver.assign_initial_conditions(at_rest, [](double x, double y, double) -> Vec2 {
    return {0.2 * x * y, 0.1 * y};
  });
  for (const double change : change_in_a_step_that_breaks(solver)) EXPECT_EQ(change, 0);
}

TEST(CompositeSolid, GivesHalfOfTheSourceBackWhenOneGridBreaks) {
  auto solver = disk_solver<NeoHookean>(10);
  const StateFunction state = [](double, double, double) { return SolidState{}; };
  const StateFunction source = [](double x, double y, double) {
    return SolidState{.u = {1 + x, y}, .v = {2, x}, .P = {1, y, x, 2}};
  };
  solver.choose(
      {.state = state, .source = source, .offset = [](double, double, double) { return Tensor2{}; }});
  solver.assign_initial_conditions(state);
  // A sum and a difference leave round-off; half of the source is 1e-2.
  for (const double change : change_in_a_step_that_breaks(solver)) EXPECT_NEAR(change, 0, 1e-15);
}

}  // namespace
}  // namespace fsi::solid
