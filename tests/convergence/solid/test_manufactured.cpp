// Manufactured motions of a skewed block: second order in the maximum norm with every boundary condition and
// law.

#include <gtest/gtest.h>

#include <string>

#include "tests/convergence/solid/manufactured_motion.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid::test {
namespace {

/// Sides left, right, bottom, top by letter: x exact, d displacement, t traction, s slip.
struct Setup {
  std::string sides;
  double q = 0.4;       ///< 0 makes y = 0 a slip wall of the motion
  double rate_P = 1.9;  ///< least rate of P between h = 1/32 and 1/64
};

template <class L>
Boundary boundary_of(char letter, Side side, const ManufacturedMotion<L>& motion) {
  Boundary boundary;
  if (letter == 'x') {
    boundary.kind = Boundary::Kind::dirichlet;
    boundary.state = [motion](double x, double y, double t) { return motion.state(x, y, t); };
  } else if (letter == 'd') {
    boundary.kind = Boundary::Kind::displacement;
    boundary.vector = [motion](double x, double y, double t) { return motion.u(x, y, t); };
    boundary.velocity = [motion](double x, double y, double t) { return motion.v(x, y, t); };
  } else if (letter == 't') {
    boundary.kind = Boundary::Kind::traction;
    boundary.vector = [motion, side](double x, double y, double t) {
      return motion.traction(skewed_normal(side, x, y), x, y, t);
    };
  } else {
    boundary.kind = Boundary::Kind::slip;
  }
  return boundary;
}

/// Largest errors over four times: those of a single one go up and down with the waves of the error.
template <class L>
Errors run(const Setup& setup, int cells) {
  constexpr double t_end = 0.8;
  const L law{.lambda = 1.1, .mu = 0.7};
  const SolidOptions options = {.rho = 1.2,
                                .tangential_stress = {.scaled = 0.1},
                                .displacement = {.scaled = 0.1},
                                .relaxation = {.rate = 1.0}};
  const ManufacturedMotion<L> motion(law, options.rho, setup.q);
  Boundaries boundaries;
  for (const Side side : all_sides) {
    const auto k = static_cast<std::size_t>(side);
    boundaries[k] = boundary_of(setup.sides[k], side, motion);
  }
  const StateFunction exact = [&](double x, double y, double t) { return motion.state(x, y, t); };
  SolidSolver<L> solver(skewed_grid(cells), law, options, boundaries, 0);
  solver.set_body_force([&](double x, double y, double t) { return motion.force(x, y, t); });
  solver.assign_initial_conditions(exact);
  double t = 0;
  Errors largest;
  for (const double t_check : {0.25, 0.5, 0.75, 1.0}) {
    while (t < t_check * t_end - 1e-12) {
      const double left = t_check * t_end - t, dt = left / std::ceil(left / solver.compute_time_step().dt);
      solver.advance_solid(t, dt);
      t += dt;
      solver.apply_solid_bcs(t);
    }
    const Errors now = solver.errors(exact, t);
    largest = {
        .u = std::max(largest.u, now.u), .v = std::max(largest.v, now.v), .P = std::max(largest.P, now.P)};
  }
  return largest;
}

/// Rates between the two grids at least 1.9 for u and v, and errors below bounds that are twice what is
/// measured: the amplitude of u is 0.03, of v 0.09 and of P about 0.2. P is second order at all points but
/// corners where two kinds of condition meet: u is not smooth there on the scale of the grid, and its
/// differences lose up to half an order at that one point (1.5 to 1.8 measured).
template <class L>
void expect_second_order(const Setup& setup) {
  const Errors coarse = run<L>(setup, 32), fine = run<L>(setup, 64);
  const std::string what = setup.sides + " " + std::string(L::name) +
                           fmt::format(": u {:.2e} v {:.2e} P {:.2e}", fine.u, fine.v, fine.P);
  EXPECT_GE(std::log2(coarse.u / fine.u), 1.9) << what;
  EXPECT_GE(std::log2(coarse.v / fine.v), 1.9) << what;
  EXPECT_GE(std::log2(coarse.P / fine.P), setup.rate_P) << what;
  EXPECT_LT(fine.u, 2e-5) << what;
  EXPECT_LT(fine.v, 6e-5) << what;
  EXPECT_LT(fine.P, 2.5e-4) << what;
}

template <class L>
class Eq32ManufacturedMotion : public testing::Test {};
using Laws = testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(Eq32ManufacturedMotion, Laws);

TYPED_TEST(Eq32ManufacturedMotion, IsSecondOrderInsideExactSides) {
  expect_second_order<TypeParam>({"xxxx", 0.4, 1.9});
}
TYPED_TEST(Eq32ManufacturedMotion, IsSecondOrderWithGivenDisplacement) {
  expect_second_order<TypeParam>({"dddd", 0.4, 1.85});
}
TYPED_TEST(Eq32ManufacturedMotion, Eq43IsSecondOrderWithGivenTraction) {
  expect_second_order<TypeParam>({"tttt", 0.4, 1.9});
}
TYPED_TEST(Eq32ManufacturedMotion, IsSecondOrderWhereTractionMeetsDisplacement) {
  expect_second_order<TypeParam>({"ttdd", 0.4, 1.5});
}
TYPED_TEST(Eq32ManufacturedMotion, IsSecondOrderWhereDisplacementMeetsSlip) {
  expect_second_order<TypeParam>({"ddst", 0.0, 1.7});
}
TYPED_TEST(Eq32ManufacturedMotion, IsSecondOrderWhereTractionMeetsSlip) {
  expect_second_order<TypeParam>({"ttst", 0.0, 1.7});
}

}  // namespace
}  // namespace fsi::solid::test
