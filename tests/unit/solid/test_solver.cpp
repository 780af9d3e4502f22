// The solver as a whole: what it keeps, and how it fails.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid {
namespace {

template <class Solver>
void advance(Solver& solver, int steps) {
  double t = 0;
  for (int k = 0; k < steps; ++k) {
    const double dt = solver.compute_time_step().dt;
    solver.advance_solid(t, dt);
    t += dt;
    solver.apply_solid_bcs(t);
  }
}

constexpr SolidOptions full_dissipation = {.rho = 1.4,
                                           .limiter = Limiter::minmod,
                                           .tangential_stress = {.rate = 0.5, .scaled = 0.1},
                                           .displacement = {.rate = 0.5, .scaled = 0.1},
                                           .relaxation = {.rate = 0.5, .scaled = 0.1},
                                           .bulk_diffusion = 0.25};

template <class L>
class Eq36RigidTranslation : public testing::Test {};
using Laws = testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(Eq36RigidTranslation, Laws);

TYPED_TEST(Eq36RigidTranslation, StaysExactOnASkewedGridWithEverySideEq37) {
  const Vec2 velocity(0.7, -0.4);
  const StateFunction exact = [=](double, double, double t) {
    return SolidState{.u = velocity * t, .v = velocity, .P = {}};
  };
  for (const auto& [name, kind] : {std::pair{"traction", Traction::condition},
                                   {"displacement", Displacement::condition},
                                   {"dirichlet", Dirichlet::condition},
                                   {"interface", Interface::condition}}) {
    Boundaries boundaries;
    for (Boundary& boundary : boundaries) boundary.condition = kind;
    if (kind == Displacement::condition) {
      boundaries[0].vector = [=](double, double, double t) -> Vec2 { return velocity * t; };
      boundaries[0].velocity = [=](double, double, double) { return velocity; };
      boundaries[1] = boundaries[0];
      boundaries[2].condition = boundaries[3].condition = Traction::condition;
    }
    if (kind == Dirichlet::condition)
      boundaries[0].state = boundaries[1].state = boundaries[2].state = boundaries[3].state = exact;
    SolidSolver<TypeParam> solver(test::skewed_grid(16), TypeParam{.lambda = 1, .mu = 1}, full_dissipation,
                                  boundaries, 0);
    solver.assign_initial_conditions(exact);
    advance(solver, 40);
    const Errors errors = solver.errors(exact, solver.t());
    // Round-off of u = O(1), amplified by 1/h in the strains: 16 * 1e-16 a step.
    EXPECT_LT(errors.u, 1e-12) << name;
    EXPECT_LT(errors.v, 1e-12) << name;
    EXPECT_LT(errors.P, 1e-12) << name;
  }
}

TEST(Eq37Displacement, FollowsAUniformForceAsAStoneFallsEq2) {
  Boundaries all_free;
  SolidSolver<NeoHookean> solver(test::skewed_grid(12), NeoHookean{.lambda = 1, .mu = 1}, {.rho = 2},
                                 all_free, 0);
  solver.set_body_force([](double, double, double) -> Vec2 { return {0, -6}; });
  const StateFunction falling = [](double, double, double t) {
    return SolidState{.u = Vec2(0, -1.5 * t * t), .v = Vec2(0, -3 * t), .P = {}};
  };
  solver.assign_initial_conditions(falling);
  advance(solver, 30);
  const Errors errors = solver.errors(falling, solver.t());
  EXPECT_LT(errors.u, 1e-12);  // the scheme is exact for quadratic u(t); round-off over h
  EXPECT_LT(errors.v, 1e-12);
}

// Ghost points are no part of the body: that a formula has no value there says nothing.
TEST(Eq37Displacement, FollowsAForceThatHasValuesInTheBodyAlone) {
  const auto fall = [](bool everywhere) {
    Boundaries all_free;
    SolidSolver<NeoHookean> solver(test::unit_square(12), NeoHookean{.lambda = 1, .mu = 1}, {.rho = 2},
                                   all_free, 0);
    solver.set_body_force([everywhere](double x, double y, double) -> Vec2 {
      constexpr double none = std::numeric_limits<double>::quiet_NaN(), round_off = 1e-12;
      const bool inside = std::min(x, y) > -round_off && std::max(x, y) < 1 + round_off;
      return {0, everywhere || inside ? -6.0 : none};
    });
    solver.assign_initial_conditions([](double, double, double) { return SolidState{}; });
    advance(solver, 10);
    std::vector<double> values;
    for (int k = 0; k < plane::count; ++k) {
      for (int j = 0; j < 13; ++j) {
        for (int i = 0; i < 13; ++i) values.push_back(std::as_const(solver).state()(k, i, j));
      }
    }
    return values;
  };
  EXPECT_EQ(fall(false), fall(true));
}

TEST(SolidErrors, SayThatAValueIsNoNumberWhereverItIs) {
  Boundaries all_free;
  SolidSolver<NeoHookean> solver(test::skewed_grid(12), NeoHookean{.lambda = 1, .mu = 1}, {}, all_free, 0);
  solver.assign_initial_conditions([](double, double, double) { return SolidState{}; });
  const auto none_at = [](int which) {
    return [=, seen = 0](double, double, double) mutable {
      const double value = ++seen == which ? std::numeric_limits<double>::quiet_NaN() : 1.0;
      return SolidState{.u = Vec2(0, value), .v = Vec2(value, 0), .P = {0, 0, value, 0}};
    };
  };
  for (const int which : {1, 50, 13 * 13}) {
    const Errors errors = solver.errors(none_at(which), 0);
    EXPECT_TRUE(std::isnan(errors.u) && std::isnan(errors.v) && std::isnan(errors.P)) << "point " << which;
  }
  EXPECT_EQ(solver.errors(none_at(0), 0).v, 1.0);
}

TEST(Eq35Momentum, IsKeptToRoundOffInAPeriodicSolid) {
  Boundaries boundaries;
  for (Boundary& boundary : boundaries) boundary.condition = Periodic::condition;
  grid::GridDescription description;
  description.name = "periodic";
  description.n1 = 25;
  description.n2 = 21;
  description.periodic1 = description.periodic2 = true;
  constexpr double turn = 6.283185307179586;
  description.mapping = [](double r, double s, double) -> Vec2 {
    return {r + 0.03 * std::sin(turn * s), s + 0.03 * std::sin(turn * r)};
  };
  SolidSolver<SaintVenantKirchhoff> solver(grid::MovingGrid(description, 0), {.lambda = 1, .mu = 1}, {},
                                           boundaries, 0);
  solver.assign_initial_conditions(
      [](double x, double y, double) -> Vec2 {
        return {0.02 * std::sin(turn * x), 0.01 * std::cos(turn * (x + y))};
      },
      [](double x, double y, double) -> Vec2 {
        return {0.1 + 0.05 * std::cos(turn * y), 0.05 * std::sin(turn * x)};
      });
  // The control volumes weigh each point once: the scheme's own sum of momentum.
  const auto momentum = [&] {
    const ReferenceMetrics metrics(solver.reference());
    Vec2 sum = Vec2::Zero();
    for (int j = 0; j < 20; ++j) {
      for (int i = 0; i < 24; ++i) {
        const double area = 1.0 / metrics.values()(ReferenceMetrics::inverse_area, i, j);
        sum += area * Vec2(solver.state()(plane::v1, i, j), solver.state()(plane::v2, i, j));
      }
    }
    return sum;
  };
  const Vec2 before = momentum();
  advance(solver, 50);
  EXPECT_LT((momentum() - before).norm(), 1e-14);  // 50 steps of 480 terms of size 1e-3
}

TEST(Eq35Symmetry, MirroredDataStayMirroredToTheLastBit) {
  constexpr int n = 16;
  const auto grid = [] {
    return grid::MovingGrid({.name = "mirror",
                             .n1 = n + 1,
                             .n2 = n + 1,
                             .mapping = [](double r, double s, double) -> Vec2 {
                               return {r - 0.5, s};
                             }},
                            0);
  };
  Boundaries boundaries;
  boundaries[2].condition = Displacement::condition;
  SolidSolver<SaintVenantKirchhoff> solver(grid(), {.lambda = 1, .mu = 1}, full_dissipation, boundaries, 0);
  solver.assign_initial_conditions(
      [](double, double, double) -> Vec2 {
        return {0, 0};
      },
      [](double x, double y, double) -> Vec2 {
        return {0.2 * x * y, 0.1 * y * (1 - x * x)};
      });
  advance(solver, 25);
  const ConstFieldView q = solver.state();
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      EXPECT_EQ(q(plane::v1, i, j), -q(plane::v1, n - i, j));
      EXPECT_EQ(q(plane::v2, i, j), q(plane::v2, n - i, j));
      EXPECT_EQ(q(plane::P11, i, j), q(plane::P11, n - i, j));
      EXPECT_EQ(q(plane::P12, i, j), -q(plane::P12, n - i, j));
    }
  }
}

TEST(BrokenNumbers, AreNamedWithTimeGridAndPointOfTheReference) {
  Boundaries all_free;
  SolidSolver<NeoHookean> solver(test::unit_square(10), NeoHookean{.lambda = 1, .mu = 1}, {}, all_free, 0);
  solver.assign_initial_conditions(
      [](double, double, double) -> Vec2 {
        return {0, 0};
      },
      [](double x, double y, double) -> Vec2 {
        return {x > 0.45 && x < 0.55 && y > 0.45 && y < 0.55 ? 20.0 : 0.0, 0};
      });
  try {
    advance(solver, 50);
    FAIL() << "a velocity of twelve times the wave speed must break the material";
  } catch (const Diverged& failure) {
    const Place& place = failure.place();
    EXPECT_TRUE(place.t.has_value()) << failure.what();
    EXPECT_EQ(place.grid, "square");
    ASSERT_EQ(place.point.size(), 2U);
    EXPECT_TRUE(place.of_reference);
    EXPECT_NEAR(place.position.at(0), 0.1 * place.point[0], 1e-12) << "points of the reference are 0.1 apart";
    EXPECT_NE(failure.cause().find("det F"), std::string::npos) << failure.cause();
  }
}

/// Pressed together to 0.45 of its length in its middle, as it was at its free sides.
template <class L>
std::string words_about_a_pressed_block() {
  const auto pressed = [](double x, double y, double) -> Vec2 {
    return {-0.55 * (x - 0.5) * std::pow(16 * x * (1 - x) * y * (1 - y), 4), 0};
  };
  Boundaries all_free;
  SolidSolver<L> solver(test::unit_square(20), L{.lambda = 1, .mu = 1}, {}, all_free, 0);
  try {
    solver.assign_initial_conditions(pressed, [](double, double, double) -> Vec2 { return {0, 0}; });
    advance(solver, 3);
  } catch (const Diverged& failure) {
    return failure.cause();
  }
  return "";
}

TEST(BrokenNumbers, OfALawThatIsSoftUnderPressureNameTheLaw) {
  EXPECT_NE(words_about_a_pressed_block<SaintVenantKirchhoff>().find("`neo_hookean` does not"),
            std::string::npos)
      << words_about_a_pressed_block<SaintVenantKirchhoff>();
  EXPECT_EQ(words_about_a_pressed_block<NeoHookean>(), "");
}

TEST(SolidOptions, ThatCanNeverBeStableAreRefused) {
  Boundaries all_free;
  EXPECT_THROW(SolidSolver<NeoHookean>(test::unit_square(10), NeoHookean{.lambda = 1, .mu = 1},
                                       {.relaxation = {.scaled = 2.5}}, all_free, 0),
               UserMistake);
}

TEST(Probes, InterpolateLinearFieldsExactly) {
  Boundaries all_free;
  SolidSolver<LinearElastic> solver(test::skewed_grid(14), LinearElastic{.lambda = 1, .mu = 1}, {}, all_free,
                                    0);
  solver.assign_initial_conditions(
      [](double x, double y, double) -> Vec2 {
        return {0.01 * x, 0.02 * y};
      },
      [](double, double, double) -> Vec2 {
        return {0, 0};
      });
  const SolidState s = solver.value(solver.locate(0.43, 0.37));
  EXPECT_NEAR(s.u.x(), 0.0043, 1e-13);
  EXPECT_NEAR(s.u.y(), 0.0074, 1e-13);
  EXPECT_THROW(solver.locate(3, 3), UserMistake);
}

TEST(Totals, AreThoseOfASpinningSquare) {
  Boundaries all_free;
  SolidSolver<NeoHookean> solver(test::unit_square(20), NeoHookean{.lambda = 1, .mu = 1}, {.rho = 3},
                                 all_free, 0);
  solver.assign_initial_conditions(
      [](double, double, double) -> Vec2 {
        return {0, 0};
      },
      [](double x, double y, double) -> Vec2 {
        return {0.5 - y, x - 0.5};
      });
  const Totals totals = solver.totals();
  EXPECT_NEAR(totals.mass, 3, 1e-12);
  EXPECT_NEAR(totals.momentum.norm(), 0, 1e-12);
  EXPECT_NEAR(totals.angular_momentum, 0.5, 3e-3);  // rho / 6 on the unit square; trapezoidal rule, h = 1/20
  EXPECT_NEAR(totals.kinetic_energy, 0.25, 2e-3);
  EXPECT_NEAR(totals.strain_energy, 0, 1e-12);
}

}  // namespace
}  // namespace fsi::solid
