// The gas on a background and a ring that moves and deforms before it.

#include <gtest/gtest.h>

#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/shapes/circle.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

using test::pi;

/// Outline of a body that drifts, turns and beats: not a circle after the start.
std::vector<double> outline_at(double t, int points) {
  std::vector<double> x(2 * static_cast<std::size_t>(points));
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * pi * (k % (points - 1)) / (points - 1);
    const double radius = 1 + 0.1 * std::sin(2 * t) * std::cos(3 * angle);
    const auto i = static_cast<std::size_t>(k);
    x[i] = 0.2 + 0.3 * t + radius * std::cos(angle + 0.4 * t);
    x[static_cast<std::size_t>(points) + i] = -0.1 - 0.2 * t + radius * std::sin(angle + 0.4 * t);
  }
  return x;
}

/// [-3, 3]^2 around the body; `on_body` holds on its outline, `far` on the outer boundary.
GasSolver around_body(int factor, const GasOptions& options, const Boundary& on_body, const Boundary& far) {
  const double h = 0.1 / factor;
  const int n = 60 * factor + 1, points = static_cast<int>(std::lround(2 * pi / h)) + 1;
  const grid::HyperbolicGrid ring{
      .name = "ring", .points = points, .lines = 8, .curve = Side::top, .spacing = h};
  std::vector<GasPart> parts;
  parts.push_back({grid::MovingGrid(test::rectangle(n, n, {-3, -3}, {3, 3}), 0), {far, far, far, far}});
  parts.push_back({grid::MovingGrid(grid::marched_from(ring, outline_at(0, points)), 0),
                   {Periodic{}, Periodic{}, Idle{}, on_body}});
  return {std::move(parts), {{.name = "ring", .n1 = points, .n2 = 8, .curve = Side::top}}, options, 0};
}

int run_with_outline(GasSolver& gas, double t_end) {
  const int points = gas.grid(1).layout().n1;
  return test::run_commanded(gas, t_end, {}, [points](double t) { return outline_at(t, points); },
                             {.side = Side::top, .grid = 1});
}

class Eq31CompositeGas : public testing::TestWithParam<Limiter> {};

TEST_P(Eq31CompositeGas, UniformFlowStaysUniform) {
  const StateField uniform = [](double, double, double) { return State{1.2, 0.4, -0.3, 0.9}; };
  const Boundary exact = Dirichlet{uniform};
  GasSolver gas = around_body(1, {.limiter = GetParam()}, exact, exact);
  gas.assign_initial_conditions(uniform);
  const int steps = run_with_outline(gas, 1);
  EXPECT_GT(steps, 20);
  EXPECT_LT(test::largest_error(gas.errors(uniform, 1)), 1e-13 * steps);
}

INSTANTIATE_TEST_SUITE_P(Limiters, Eq31CompositeGas, testing::Values(Limiter::none, Limiter::minmod),
                         [](const auto& test) { return test.param == Limiter::none ? "none" : "minmod"; });

TEST(Eq31CompositeGas, VortexPastAMovingBodyIsSecondOrder) {
  const test::Vortex vortex{.u = 0.3, .v = 0.2, .x_0 = -0.5, .y_0 = 0.3};
  const Boundary exact = Dirichlet{vortex};
  std::vector<double> errors;
  for (const int factor : {1, 2, 4}) {
    GasSolver gas = around_body(factor, {.limiter = Limiter::none}, exact, exact);
    gas.assign_initial_conditions(vortex);
    run_with_outline(gas, 0.7);
    errors.push_back(test::largest_error(gas.errors(vortex, 0.7)));
  }
  EXPECT_GT(test::rate(errors), 1.9) << errors[0] << " " << errors[1] << " " << errors[2];
  EXPECT_LT(errors.back(), 5e-4);
}

TEST(CompositeGasTotals, AreThoseOfTheGasWithoutTheBody) {
  const StateField uniform = [](double, double, double) { return State{1.2, 0.4, -0.3, 0.9}; };
  const Boundary exact = Dirichlet{uniform};
  std::vector<double> errors;
  for (const int factor : {1, 2, 4}) {
    GasSolver gas = around_body(factor, {}, exact, exact);
    gas.assign_initial_conditions(uniform);
    const Totals totals = gas.totals();
    EXPECT_NEAR(totals.momentum2 / totals.mass, -0.3, 1e-12);
    errors.push_back(std::fabs(totals.mass - 1.2 * (36 - pi)));
  }
  EXPECT_GT(test::rate(errors), 1.9);
  EXPECT_LT(errors.back(), 1e-3);
}

}  // namespace
}  // namespace fsi::fluid
