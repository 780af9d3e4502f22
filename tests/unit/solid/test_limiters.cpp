// Limiters of the slopes in a solid: what each lets through, and what they cost a body that turns.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "solid_solver/boundary/every_boundary.hpp"
#include "solid_solver/kernels/sweep/sweep_rows.hpp"
#include "solid_solver/neo_hookean_solver.hpp"

namespace fsi::solid::limiters {
namespace {

/// Half slopes of one triple.
struct Slopes {
  double none, minmod, mc;
  Slopes(double lower, double middle, double upper)
      : none(half_slope<Limiter::none>(lower, middle, upper)),
        minmod(half_slope<Limiter::minmod>(lower, middle, upper)),
        mc(half_slope<Limiter::mc>(lower, middle, upper)) {}
};

TEST(LimitersOfASolid, LieBetweenNothingAndTheCentredSlope) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same numbers every time
  std::uniform_real_distribution<double> number(-1, 1);
  int centred = 0, cut = 0;
  for (int k = 0; k < 1000; ++k) {
    const double lower = number(random), middle = number(random), upper = number(random);
    const Slopes of(lower, middle, upper), mirrored(upper, middle, lower), turned(-lower, -middle, -upper);
    EXPECT_EQ(of.mc, -mirrored.mc);
    EXPECT_EQ(of.mc, -turned.mc);
    if ((middle - lower) * (upper - middle) <= 0) {
      EXPECT_EQ(of.mc, 0);
      EXPECT_EQ(of.minmod, 0);
      continue;
    }
    const double sign = of.none > 0 ? 1 : -1;
    EXPECT_LE(0, sign * of.minmod);
    EXPECT_LE(sign * of.minmod, sign * of.mc);
    EXPECT_LE(sign * of.mc, sign * of.none);
    // Where one difference is up to three times the other the slope is centred; beyond, the values at the cell's ends
    // reach those of the neighbours and no farther.
    const double ratio = (middle - lower) / (upper - middle);
    const bool smooth = ratio < 3 && ratio > 1.0 / 3;
    if (smooth) {
      EXPECT_EQ(of.mc, of.none);
    } else {
      EXPECT_DOUBLE_EQ(of.mc, 2 * of.minmod);
    }
    ++(smooth ? centred : cut);
  }
  EXPECT_GT(centred, 100);
  EXPECT_GT(cut, 100);
}

/// Angular momentum that a bar of 16 x 4 cells gains, in parts of the whole, while it turns once: nothing acts on it.
double gained_in_a_turn(Limiter limiter) {
  constexpr double omega = 6, stiffness = 100;
  grid::MovingGrid bar({.name = "bar",
                        .n1 = 17,
                        .n2 = 5,
                        .mapping = [](double r, double s, double) -> Vec2 {
                          return {0.6 * (r - 0.5), 0.1 * (s - 0.5)};
                        }},
                       0);
  const SolidOptions options = {.rho = 3,
                                .limiter = limiter,
                                .tangential_stress = {.scaled = 0.5},
                                .displacement = {.scaled = 0.5},
                                .relaxation = {.scaled = 0.2}};
  SolidSolver<NeoHookean> solver(std::move(bar), {.lambda = stiffness, .mu = stiffness}, options, {}, 0);
  solver.assign_initial_conditions(
      [](double, double, double) -> Vec2 {
        return {0, 0};
      },
      [](double x, double y, double) -> Vec2 {
        return {-omega * y, omega * x};
      });
  const double initial = solver.totals().angular_momentum;
  double t = 0;
  solver.apply_solid_bcs(t);
  while (t < 2 * std::numbers::pi / omega) {
    const double dt = solver.compute_time_step().dt;
    solver.advance_solid(t, dt);
    t += dt;
    solver.apply_solid_bcs(t);
  }
  return solver.totals().angular_momentum / initial - 1;
}

TEST(LimitersOfASolid, ATurningBarGainsNoMoreWithMcThanWithout) {
  const double none = std::abs(gained_in_a_turn(Limiter::none)), mc = std::abs(gained_in_a_turn(Limiter::mc)),
               minmod = std::abs(gained_in_a_turn(Limiter::minmod));
  EXPECT_LT(mc, 1.5 * none);
  EXPECT_LT(mc, 0.25 * minmod);
  EXPECT_LT(mc, 0.004);
}

}  // namespace
}  // namespace fsi::solid::limiters
