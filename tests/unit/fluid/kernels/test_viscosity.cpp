/// What artificial viscosity does to a gas: one step with it and one without, and the difference.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

constexpr int n1 = 17, n2 = 15;
constexpr double dt = 1e-3, bend = 0.3, turn = 0.4;

using test::open_sides;

/// A Cartesian grid, and a turned and sheared one.
grid::GridDescription parallelogram(const Vec2& along_r1, const Vec2& along_r2) {
  return {.n1 = n1, .n2 = n2, .mapping = [=](double r, double s, double) {
            return Vec2(r * (n1 - 1) * along_r1 + s * (n2 - 1) * along_r2);
          }};
}

/// One step of gas that goes apart at `rate` (towards a point
/// where that is negative), its density a parabola of x.
GasSolver stepped(const grid::GridDescription& grid, double rate, const GasOptions& options) {
  const StateField flow = [=](double x, double y, double) {
    return State{1 + bend * x * x, 0.5 * rate * x - turn * y, 0.5 * rate * y + turn * x, 1};
  };
  GasSolver gas = test::solver(grid, options, open_sides, flow);
  gas.apply_fluid_bcs(0);
  gas.advance_fluid(dt, dt);
  return gas;
}

/// Expects of a gas with viscosity that a step adds `factor` times the undivided second differences of the
/// density along both grid directions, 2 bend (dx)^2, and nothing else to it.
void expect_diffusion(double rate, const GasOptions& options, double factor) {
  const Vec2 slanted(0.1, 0.03), steep(-0.04, 0.08);
  for (const auto& [along_r1, along_r2] : {std::pair{Vec2(0.1, 0), Vec2(0, 0.08)}, {slanted, steep}}) {
    const grid::GridDescription grid = parallelogram(along_r1, along_r2);
    const GasSolver with = stepped(grid, rate, options), without = stepped(grid, rate, {});
    const double squares = along_r1.x() * along_r1.x() + along_r2.x() * along_r2.x();
    for (int j = 3; j < n2 - 3; ++j) {
      for (int i = 3; i < n1 - 3; ++i) {
        EXPECT_NEAR(with.state()(0, i, j) - without.state()(0, i, j), factor * 2 * bend * squares, 1e-14);
      }
    }
  }
}

TEST(ShockViscosity, SpreadsCompressedGasByItsCoefficientTimesTheRateOfCompression) {
  for (const double rate : {-0.5, -4.0}) {
    expect_diffusion(rate, {.shock_viscosity = 0.5}, dt * 0.5 * -rate);
    expect_diffusion(rate, {.shock_viscosity = 1.5}, dt * 1.5 * -rate);
  }
}

TEST(ShockViscosity, ChangesNothingWhereGasExpands) {
  const GasOptions none, some{.shock_viscosity = 0.5};
  for (const auto& grid : {parallelogram({0.1, 0}, {0, 0.08}), parallelogram({0.1, 0.03}, {-0.04, 0.08})}) {
    const GasSolver with = stepped(grid, 2, some), without = stepped(grid, 2, none);
    for (int k = 0; k < 4; ++k) {
      for (int j = 2; j < n2 - 2; ++j) {
        for (int i = 2; i < n1 - 2; ++i) EXPECT_EQ(with.state()(k, i, j), without.state()(k, i, j));
      }
    }
  }
}

TEST(LinearDiffusion, SpreadsAnyGasAtItsRate) {
  for (const double rate : {-3.0, 0.0, 3.0}) expect_diffusion(rate, {.linear_diffusion = 5}, dt * 5);
}

TEST(ShockViscosity, ShortensTheStepWhereItActsOnly) {
  const GasOptions none, some{.shock_viscosity = 2};
  const auto step = [](double rate, const GasOptions& options) {
    return stepped(parallelogram({0.1, 0}, {0, 0.08}), rate, options).compute_time_step().dt;
  };
  EXPECT_LT(step(-20, some), step(-20, none) * 0.95);
  EXPECT_NEAR(step(2, some), step(2, none), 1e-15);
}

}  // namespace
}  // namespace fsi::fluid
