// What holds on the sides after apply_solid_bcs.

#include <gtest/gtest.h>

#include <numbers>

#include "common/core/failure.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid {
namespace {
using test::skewed_grid;

Vec2 small_motion(double x, double y, double) {
  return {0.03 * std::sin(2 * x + y), 0.02 * std::cos(x - 2 * y)};
}

template <class L>
class GivenTraction : public testing::Test {};
using Laws = testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(GivenTraction, Laws);

TYPED_TEST(GivenTraction, Eq42HoldsPerCurrentAreaAndEq43HoldsWithTheGhostPoints) {
  const TypeParam law{.lambda = 1.3, .mu = 0.9};
  const Vec2 tau(0.02, -0.01);
  Boundaries boundaries;
  boundaries[1].vector = [=](double, double, double) { return tau; };
  SolidSolver<TypeParam> solver(skewed_grid(12), law, {}, boundaries, 0);
  solver.assign_initial_conditions(small_motion, small_motion);
  const ConstFieldView q = solver.state(), x = solver.reference();
  const ReferenceMetrics metrics(x);
  for (int j = 1; j < 12; ++j) {
    const SideMetrics m = side_metrics(metrics, q.layout, Side::right, j);
    const SolidState s = load(q, q.layout.at(12, j));
    const auto length = [&](bool deformed) {
      const Vec2 d(x(0, 12, j + 1) - x(0, 12, j - 1), x(1, 12, j + 1) - x(1, 12, j - 1));
      const Vec2 du(q(plane::u1, 12, j + 1) - q(plane::u1, 12, j - 1),
                    q(plane::u2, 12, j + 1) - q(plane::u2, 12, j - 1));
      return (deformed ? d + du : d).norm();
    };
    const Vec2 force = traction_of(s.P, m.n0) * length(false);
    EXPECT_LT((force - tau * length(true)).norm(), 1e-15);
    // The law with central differences through the ghost point gives the traction of the boundary point.
    const MappedRow row(metrics, j);
    const Tensor2 P = law.P(deformation_gradient(row, StateRows(q, j), 12, 0.0));
    EXPECT_LT((traction_of(P, m.n0) - traction_of(s.P, m.n0)).norm(), 1e-11);  // Newton's tolerance on strain
  }
}

TYPED_TEST(GivenTraction, Eq43FindsTheStrainOfACornerFromItsStress) {
  const TypeParam law{.lambda = 1.3, .mu = 0.9};
  const Tensor2 P = law.P({1.1, 0.04, 0.04, 0.95});
  const auto F = match_corner(law, P, Tensor2{1, 0, 0, 1});
  ASSERT_TRUE(F);
  const Tensor2 apart = minus(law.P(*F), P);
  EXPECT_LT(std::abs(apart.a11) + std::abs(apart.a12) + std::abs(apart.a21) + std::abs(apart.a22), 1e-11);
}

// Pressed across and pulled along: det P < 0 needs a principal stretch f > 0 under pressure, and this law
// bears none above f (3 (1 - f^2) + 1) / 2 < 1.1 there.
TEST(CornerOfTwoTractions, IsNamedWhereNoStrainGivesItsStress) {
  const SaintVenantKirchhoff law{.lambda = 1, .mu = 1};
  const auto at_corner = [](double x, double y) { return std::hypot(x, y) < 1e-9 ? 10.0 : 0.0; };
  Boundaries boundaries;
  boundaries[0].load = boundaries[2].load = LoadConfiguration::reference;
  boundaries[0].vector = [=](double x, double y, double) -> Vec2 { return {at_corner(x, y), 0}; };
  boundaries[2].vector = [=](double x, double y, double) -> Vec2 { return {0, -at_corner(x, y)}; };
  grid::GridDescription square{
      .name = "square", .n1 = 11, .n2 = 11, .mapping = [](double r, double s, double) { return Vec2(r, s); }};
  SolidSolver<SaintVenantKirchhoff> solver(grid::MovingGrid(square, 0), law, {}, boundaries, 0);
  const VectorFunction at_rest = [](double, double, double) -> Vec2 { return Vec2::Zero(); };
  try {
    solver.assign_initial_conditions(at_rest, at_rest);
    FAIL() << "the corner bears more than it can";
  } catch (const Diverged& broke) {
    const std::string words = broke.what();
    EXPECT_NE(words.find("grid \"square\", point (0, 0)"), std::string::npos) << words;
  }
}

// The stretch along the side enters with a difference of higher order.
TEST(Interface, StressAlongAMirroredSideIsSharperThanCentralDifferences) {
  const LinearElastic law{.lambda = 1, .mu = 1};
  const double k = std::numbers::pi;
  Boundaries boundaries;
  for (Boundary& side : boundaries) side.condition = Symmetry::condition;
  boundaries[1].condition = Interface::condition;
  const auto u = [=](double, double y, double) -> Vec2 { return {0, std::sin(k * y)}; };
  const grid::GridDescription square{
      .name = "square", .n1 = 13, .n2 = 13, .mapping = [](double r, double s, double) -> Vec2 {
        return {r, s};
      }};
  SolidSolver<LinearElastic> solver(grid::MovingGrid(square, 0), law, {}, boundaries, 0);
  solver.assign_initial_conditions(u, [](double, double, double) -> Vec2 { return {0, 0}; });
  const ConstFieldView q = solver.state(), x = solver.reference();
  for (int j = 1; j < 12; ++j) {  // the stress at the corners began with one-sided differences
    const double y = x(1, 12, j), modulus = law.lambda + 2 * law.mu, exact = modulus * k * std::cos(k * y);
    const double central = modulus * 0.5 * 12 * (std::sin(k * (y + 1.0 / 12)) - std::sin(k * (y - 1.0 / 12)));
    if (std::abs(central - exact) < 0.01) continue;  // where the central difference happens to be right
    EXPECT_LT(std::abs(q(plane::P22, 12, j) - exact), 0.1 * std::abs(central - exact)) << j;
  }
}

TEST(GivenDisplacement, HoldsAtEveryPointOfTheSideWithItsVelocity) {
  Boundaries boundaries;
  for (Boundary& boundary : boundaries) {
    boundary.condition = Displacement::condition;
    boundary.vector = [](double x, double y, double t) -> Vec2 { return (1 + t) * small_motion(x, y, t); };
    boundary.velocity = small_motion;
  }
  SolidSolver<SaintVenantKirchhoff> solver(skewed_grid(12), {.lambda = 1, .mu = 1}, {}, boundaries, 0);
  solver.assign_initial_conditions(small_motion, small_motion);
  solver.advance_solid(0, 0.01);
  solver.apply_solid_bcs(0.01);
  const ConstFieldView q = solver.state(), x = solver.reference();
  for (int k = 0; k <= 12; ++k) {
    const Vec2 u = 1.01 * small_motion(x(0, 0, k), x(1, 0, k), 0);
    EXPECT_EQ(q(plane::u1, 0, k), u.x());
    EXPECT_EQ(q(plane::u2, 0, k), u.y());
  }
}

TEST(SlipWall, HoldsTheNormalMotionAndTheShear) {
  Boundaries boundaries;
  boundaries[2].condition = SlipWall::condition;
  SolidSolver<NeoHookean> solver(skewed_grid(12), {.lambda = 1, .mu = 1}, {}, boundaries, 0);
  solver.assign_initial_conditions(small_motion, small_motion);
  for (int i = 0; i <= 12; ++i) {
    const SolidState s = load(solver.state(), solver.state().layout.at(i, 0));
    EXPECT_NEAR(s.u.y(), 0, 1e-16);  // the wall is y = 0
    EXPECT_NEAR(s.v.y(), 0, 1e-16);
    EXPECT_NEAR(s.P.a21, 0, 1e-16);
  }
}

// What is above the corner decides, not a ghost point below the wall that was extrapolated.
TEST(SlipWall, MakesNoShearAtItsCornerWithALoadedSide) {
  Boundaries boundaries;
  boundaries[2].condition = SlipWall::condition;
  boundaries[1].vector = [](double, double, double) -> Vec2 { return {-0.2, 0}; };
  SolidSolver<NeoHookean> solver(test::unit_square(12), {.lambda = 1, .mu = 1}, {}, boundaries, 0);
  const auto ripple = [](double, double y, double) -> Vec2 {
    return {1e-3 * std::cos(12 * std::numbers::pi * y), 0};
  };
  solver.assign_initial_conditions(ripple, ripple);
  const ConstFieldView q = std::as_const(solver).state();
  for (const int plane : {plane::u1, plane::v1}) EXPECT_NEAR(q(plane, 12, -1), q(plane, 12, 1), 1e-15);
  EXPECT_NEAR(q(plane::P21, 12, 0), 0, 1e-16);
  EXPECT_NEAR(q(plane::P12, 12, 0), 0, 1e-16);
}

// A law that bears little pressure is asked for a lot: the step of Newton's method lands where no waves are.
TEST(TractionOfASide, Eq43IsFoundFromAFarStartWhereThereIsAStateWithWaves) {
  const SaintVenantKirchhoff law{.lambda = 1, .mu = 1};
  for (const double strain : {-0.4, -0.3, 0.1, 0.8, 3.0}) {
    for (const double begin : {-1.5, -0.6, 0.0, 2.0}) {
      const BoundaryStrain at = {.F = {1, 0, 0, 1}, .across = {10, 0}, .n0 = {1, 0}, .sign = 1};
      const Vec2 d(0.1 * strain, 0.02);
      const Vec2 T = traction_of(law.P(plus_dyad(at.F, d, at.across)), at.n0);
      const auto found = match_traction(law, at, T, Vec2(0.1 * begin, 0));
      ASSERT_TRUE(found) << strain << " from " << begin;
      EXPECT_LT((traction_of(law.P(plus_dyad(at.F, *found, at.across)), at.n0) - T).norm(), 1e-12);
    }
  }
}

TEST(TractionOfASide, ThatNoStateWithWavesHasIsRefusedByName) {
  Boundaries boundaries;
  boundaries[1].vector = [](double, double, double) -> Vec2 { return {-1, 0}; };
  SolidSolver<SaintVenantKirchhoff> solver(test::unit_square(8), {.lambda = 1, .mu = 1}, {}, boundaries, 0);
  const VectorFunction at_rest = [](double, double, double) -> Vec2 { return Vec2::Zero(); };
  try {
    solver.assign_initial_conditions(at_rest, at_rest);
    FAIL() << "the law bears 0.58 only";
  } catch (const Diverged& broke) {
    const std::string words = broke.what();
    EXPECT_NE(words.find("cannot bear the traction (-1, 0)"), std::string::npos) << words;
    EXPECT_NE(words.find("saint_venant_kirchhoff"), std::string::npos) << words;
  }
}

/// Half of a square with a mirror on its left must do what the whole square does.
TEST(Symmetry, HalfABodyMovesAsTheWholeOne) {
  const auto block = [](int cells, double from) {
    return grid::MovingGrid({.name = "block",
                             .n1 = cells + 1,
                             .n2 = 17,
                             .mapping = [=](double r, double s, double) -> Vec2 {
                               return {from + (1 - from) * r, s};
                             }},
                            0);
  };
  const VectorFunction at_rest = [](double, double, double) -> Vec2 { return {0, 0}; };
  const VectorFunction kick = [](double x, double y, double) -> Vec2 {
    return {0.1 * x * y, 0.1 * (1 - x * x) * y};
  };
  Boundaries whole, half;
  half[0].condition = Symmetry::condition;
  SolidSolver<SaintVenantKirchhoff> one(block(32, -1), {.lambda = 1, .mu = 1}, {}, whole, 0);
  SolidSolver<SaintVenantKirchhoff> other(block(16, 0), {.lambda = 1, .mu = 1}, {}, half, 0);
  one.assign_initial_conditions(at_rest, kick);
  other.assign_initial_conditions(at_rest, kick);
  for (int step = 0; step < 20; ++step) {
    for (SolidSolver<SaintVenantKirchhoff>* solver : {&one, &other}) {
      solver->advance_solid(step * 0.01, 0.01);
      solver->apply_solid_bcs((step + 1) * 0.01);
    }
  }
  for (int k = 0; k < plane::count; ++k) {
    for (int j = 0; j < 17; ++j) {
      for (int i = 0; i < 17; ++i)
        EXPECT_NEAR(other.state()(k, i, j), one.state()(k, i + 16, j), 1e-13);  // round-off
    }
  }
}

// In uniaxial strain Saint Venant-Kirchhoff's stress has a minimum at F = 1 / sqrt(3): below, no p-waves that
// way. With lambda = 0 all other waves go on.
TEST(SidePoints, WithoutWavesKeepTheirPredictionAndAreCounted) {
  const auto counted = [](double stretch) {
    Boundaries boundaries;
    for (Boundary& side : boundaries) {
      side.condition = Displacement::condition;
      side.vector = [stretch](double x, double, double) { return Vec2((stretch - 1) * x, 0); };
    }
    SolidSolver<SaintVenantKirchhoff> solver(test::unit_square(8), {.lambda = 0, .mu = 0.7}, {}, boundaries,
                                             0);
    solver.assign_initial_conditions(
        [stretch](double x, double, double) { return Vec2((stretch - 1) * x, 0); },
        [](double, double, double) { return Vec2(0.1, 0.2); });
    const double before = solver.health().waveless;
    solver.apply_solid_bcs(0);
    return solver.health().waveless - before;
  };
  EXPECT_EQ(counted(1), 0);
  EXPECT_EQ(counted(0.65), 0);
  EXPECT_EQ(counted(0.5),
            18);  // left and right with their corners: along the others shear waves go on, and p-waves
}

// Their displacement is extrapolated; beside a singular corner it may be anything.
TEST(GhostPoints, ThatAreInsideOutDoNotBreakTheBodyBesideThem) {
  for (const double pushed : {0.0, -0.5}) {
    SolidSolver<NeoHookean> solver(test::unit_square(12), {.lambda = 1, .mu = 1}, {}, Boundaries{}, 0);
    solver.assign_initial_conditions(small_motion, small_motion);
    solver.state()(plane::u1, 14, 6) += pushed;  // the second ghost line turns the first one over
    solver.state()(plane::u2, 6, 14) += pushed;
    const double dt = solver.compute_time_step().dt;
    solver.advance_solid(0, dt);
    EXPECT_EQ(solver.health().settled > 0, pushed != 0);  // and that is told
    const ConstFieldView q = std::as_const(solver).state();
    for (int k = 0; k < plane::count; ++k) {
      for (int j = 0; j < 13; ++j) {
        for (int i = 0; i < 13; ++i) EXPECT_LT(std::abs(q(k, i, j)), 0.5) << k << " at " << i << ", " << j;
      }
    }
  }
}

TEST(PeriodicSides, MustComeInPairs) {
  Boundaries boundaries;
  boundaries[0].condition = Periodic::condition;
  EXPECT_THROW(SolidSolver<LinearElastic>(skewed_grid(12), {.lambda = 1, .mu = 1}, {}, boundaries, 0),
               UserMistake);
}

}  // namespace
}  // namespace fsi::solid
