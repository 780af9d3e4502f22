/// The largest stable step from the eigenvalue of the discrete operator.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "fluid_solver/kernels/time_step.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

/// How far Lambda dt lies out of the ellipse of stability: 1 on its edge.
double reach(const Eigenvalue& lambda, double dt) {
  const std::complex<double> z(-lambda.damping * dt, lambda.waves * dt);
  return std::hypot(z.real() / 2, z.imag() / 1);
}

TEST(Eq45StableStep, PutsTheEigenvalueOfEq44OnTheEdgeOfTheEllipse) {
  for (const double damping : {0.0, 0.7, 40.0}) {
    for (const double waves : {0.5, 3.0, 200.0}) {
      const Eigenvalue lambda{damping, waves};
      EXPECT_NEAR(reach(lambda, 1 / stable_rate(lambda)), 1, 1e-14);
    }
  }
}

TEST(Eq45StableStep, ShrinksWithEveryCause) {
  const double rate = stable_rate({1, 2});
  EXPECT_GT(stable_rate({2, 2}), rate);
  EXPECT_GT(stable_rate({1, 3}), rate);
}

GasSolver box(const GasOptions& options, const State& state, const Vec2& size, double rotation = 0) {
  const Mat2 turn{{std::cos(rotation), -std::sin(rotation)}, {std::sin(rotation), std::cos(rotation)}};
  grid::GridDescription description{.n1 = 11, .n2 = 11, .mapping = [size, turn](double r, double s, double) {
                                      return Vec2(turn * Vec2(r * size[0], s * size[1]));
                                    }};
  const StateField field = [state](double, double, double) { return state; };
  return test::solver(description, options, {Outflow{}, Outflow{}, Outflow{}, Outflow{}}, field);
}

TEST(Eq44GasEigenvalue, SumsTheWavesOfBothDirections) {
  // gas at rest with a = 2 on spacings 0.1 and 0.2: Lambda_i = 2/0.1 + 2/0.2
  const GasOptions options{.gamma = 1.6, .cfl = 0.5};
  EXPECT_NEAR(box(options, {1, 0, 0, 2.5}, {1, 2}).compute_time_step().dt, 0.5 / 30, 1e-14);
  EXPECT_NEAR(box(options, {1, -1, 3, 2.5}, {1, 2}).compute_time_step().dt, 0.5 / 55, 1e-14);
}

TEST(Eq44GasEigenvalue, IsTheSameOnATurnedGrid) {
  const GasOptions options{.cfl = 0.9};
  const double angle = 0.6, u = 1.3, v = -0.4;
  const State turned{1, std::cos(angle) * u - std::sin(angle) * v, std::sin(angle) * u + std::cos(angle) * v,
                     0.8};
  EXPECT_NEAR(box(options, turned, {1, 2}, angle).compute_time_step().dt,
              box(options, {1, u, v, 0.8}, {1, 2}).compute_time_step().dt, 1e-14);
}

TEST(Eq44GasEigenvalue, CountsDiffusionAsItsRealPart) {
  // -Lambda_r = 8 * 50 from undivided differences, Lambda_i
  // = 30: the ellipse gives dt = 1 / sqrt(200^2 + 30^2)
  const GasOptions options{.gamma = 1.6, .linear_diffusion = 50, .cfl = 1};
  EXPECT_NEAR(box(options, {1, 0, 0, 2.5}, {1, 2}).compute_time_step().dt, 1 / std::hypot(200.0, 30.0),
              1e-14);
}

TEST(Eq44GasEigenvalue, KnowsThatTheGridRunsWithTheGas) {
  // gas and grid move together: after the first step only the sound waves count
  const State state{1, 3, 0, 1 / 1.4};
  grid::GridDescription description{
      .n1 = 11,
      .n2 = 11,
      .mapping = [](double r, double s, double t) { return Vec2(r + 3 * t, s); },
      .moving = true};
  const StateField field = [state](double, double, double) { return state; };
  GasSolver gas = test::solver(description, {.cfl = 1}, {Outflow{}, Outflow{}, Outflow{}, Outflow{}}, field);
  gas.apply_fluid_bcs(0);
  EXPECT_NEAR(gas.compute_time_step().dt, 1.0 / 50, 1e-12);
  gas.move_grids(0.01, 0.01);
  gas.advance_fluid(0.01, 0.01);
  EXPECT_NEAR(gas.compute_time_step().dt, 1.0 / 20, 1e-12);
}

/// A solver that looks at all points once for the time step and the health says of each state what one says that looks
/// whenever it is asked.
TEST(TimeStepAndHealth, AreTheSameWithOneLookAtAState) {
  const StateField bump = [](double x, double y, double) {
    const double height = std::exp(-20 * ((x - 0.4) * (x - 0.4) + (y - 0.5) * (y - 0.5)));
    return State{.rho = 1 + height, .v1 = 1 - height, .v2 = 0.2 * height, .p = 1 + 3 * height};
  };
  const auto make = [&](double viscosity) {
    return test::solver(
        {.n1 = 21, .n2 = 17, .mapping = [](double r, double s, double) { return Vec2(r, s); }},
        {.shock_viscosity = viscosity}, {Outflow{}, Outflow{}, Outflow{}, Outflow{}}, bump);
  };
  for (const double viscosity : {0.0, 0.5}) {
    GasSolver once = make(viscosity), often = make(viscosity);
    double t = 0;
    const auto compare = [&](const char* state) {
      once.look();
      EXPECT_EQ(once.compute_time_step().dt, often.compute_time_step().dt) << state << t;
      EXPECT_EQ(once.compute_time_step().reason, often.compute_time_step().reason) << state << t;
      EXPECT_EQ(once.health().min_rho, often.health().min_rho) << state << t;
      EXPECT_EQ(once.health().min_p, often.health().min_p) << state << t;
    };
    for (int step = 0; step < 4; ++step) {
      for (GasSolver* gas : {&once, &often}) gas->apply_fluid_bcs(t);
      compare("projected, t = ");
      const double dt = often.compute_time_step().dt;
      t += dt;
      for (GasSolver* gas : {&once, &often}) {
        gas->move_grids(t, dt);
        gas->advance_fluid(t, dt);
      }
      compare("predicted, t = ");
    }
  }
}

TEST(TimeStepReason, NamesGridPointAndPosition) {
  const TimeStep step = box({}, {1, 0, 0, 1}, {1, 1}).compute_time_step();
  EXPECT_NE(step.reason.find("grid \"grid\", point ("), std::string::npos) << step.reason;
}

}  // namespace
}  // namespace fsi::fluid
