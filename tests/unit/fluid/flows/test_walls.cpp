/// Interfaces and slip walls: boundary points and ghosts.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/core/failure.hpp"
#include "common/exact/riemann.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

using test::pi;

constexpr double gamma = 1.4;

test::OwnedInterface uniform_interface(std::size_t n, Vec2 normal, double v_n, double w_n) {
  test::OwnedInterface side;
  side.n.assign(n, normal[0]);
  side.n.resize(2 * n, normal[1]);
  side.v_n.assign(n, v_n);
  side.w_n.assign(n, w_n);
  side.v.assign(2 * n, 0);
  side.a.assign(2 * n, 0);
  return side;
}

GasSolver box_with_interface(const StateField& initial, double p_e, Limiter limiter = Limiter::none) {
  return test::solver(test::rectangle(11, 9, {0, 0}, {1, 1}), {.p_e = p_e, .limiter = limiter},
                      {Interface{}, Outflow{}, Outflow{}, Outflow{}}, initial);
}

TEST(Eq31Interface, PutsTheProjectedValuesOnTheBoundaryAndKeepsEntropyAndShear) {
  const State state{1.2, 0.3, -0.5, 0.9};
  GasSolver gas = box_with_interface([=](double, double, double) { return state; }, 0.8);
  const Vec2 n = Vec2(0.8, 0.6);
  const test::OwnedInterface side = uniform_interface(9, n, 0.25, 0.3);
  const std::vector<InterfaceValues> values{side.view()};
  gas.apply_fluid_bcs(0, values);
  const ConstFieldView q = gas.state();
  for (int j = 0; j < 9; ++j) {
    const Vec2 v(q(1, 0, j), q(2, 0, j)), t(-n[1], n[0]);
    EXPECT_NEAR(n.dot(v), 0.25, 1e-15);
    EXPECT_NEAR(t.dot(v), t.dot(Vec2(state.v1, state.v2)), 1e-15);
    EXPECT_NEAR(q(3, 0, j), 0.5, 1e-15);
    EXPECT_NEAR(q(3, 0, j) / std::pow(q(0, 0, j), gamma), state.p / std::pow(state.rho, gamma), 1e-14);
    EXPECT_EQ(q(0, 1, j), state.rho);
  }
}

TEST(Eq31Interface, ReportsAPressureThatIsNotPositiveByPlace) {
  GasSolver gas = box_with_interface([](double, double, double) { return State{1, 0, 0, 1}; }, 1);
  test::OwnedInterface side = uniform_interface(9, {1, 0}, 0, 0);
  side.w_n[4] = 1.5;
  const std::vector<InterfaceValues> values{side.view()};
  try {
    gas.apply_fluid_bcs(0.25, values);
    FAIL() << "no complaint about p^I = -0.5";
  } catch (const Diverged& broke) {
    EXPECT_NE(std::string(broke.what()).find("t = 0.25, grid \"grid\", point (0, 4) at (0, 0.5): p^I = -0.5"),
              std::string::npos)
        << broke.what();
  }
}

TEST(Eq31Interface, KeepsAVacuumPositiveWhoseTractionIsThatOfNoPressure) {
  const double p = 1e-11;  // what 1 - 1e-18 does not hold of p_e
  for (const double lost : {0.0, 2e-16}) {
    GasSolver gas = box_with_interface([=](double, double, double) { return State{1e-6, 0.3, 0, p}; }, 1);
    const test::OwnedInterface side = uniform_interface(9, {-1, 0}, 1, 1 + lost);
    const std::vector<InterfaceValues> values{side.view()};
    gas.apply_fluid_bcs(0, values);
    for (int j = 0; j < 9; ++j) {
      EXPECT_GT(gas.state()(3, 0, j), 0);
      EXPECT_LT(gas.state()(3, 0, j), 1e-6 * p);
      EXPECT_GT(gas.state()(0, 0, j), 0);
    }
  }
}

TEST(Eq31Interface, KeepsAVacuumPositiveWithoutAPressureOutside) {
  GasSolver gas = box_with_interface([](double, double, double) { return State{1, 0.3, 0, 1}; }, 0);
  test::OwnedInterface side = uniform_interface(9, {-1, 0}, 1, -1);
  side.w_n[4] = 1e-16;  // -p - dp, whose round-off is that of p
  const std::vector<InterfaceValues> values{side.view()};
  gas.apply_fluid_bcs(0, values);
  EXPECT_GT(gas.state()(3, 0, 4), 0);
  EXPECT_LT(gas.state()(3, 0, 4), 1e-6);
}

/// Of second degree, whatever pressure the wall itself was given; with a limiter, gas of one pressure shows no slope.
TEST(Eq31WallGhosts, ContinueThePressureInsideWhereNoAccelerationIsKnown) {
  for (const Limiter limiter : {Limiter::none, Limiter::minmod}) {
    for (const double curvature : {0.0, 0.02}) {
      const double slope = limiter == Limiter::none || curvature > 0 ? 0.1 : 0;
      const auto p = [=](double x) { return 1 + slope * x + curvature * x * x; };
      GasSolver gas = box_with_interface(
          [=](double x, double, double) {
            return State{1, 0, 0, p(x)};
          },
          0.8, limiter);
      test::OwnedInterface side = uniform_interface(9, {1, 0}, 0, 0.8 - p(0));
      side.a.clear();
      const std::vector<InterfaceValues> values{side.view()};
      gas.apply_fluid_bcs(0, values);
      EXPECT_NEAR(gas.state()(3, -1, 4), p(-0.1), 1e-14);
      EXPECT_NEAR(gas.state()(3, -2, 4), p(-0.2), 1e-14);
    }
  }
}

TEST(Eq31WallGhosts, ContinueThePressureOfAnAcceleratedColumnOfGas) {
  // In a column accelerated with a, gas of constant density
  // has dp/dx = -rho a: the ghosts lie on the same line.
  const double a = 0.7, rho = 1.3;
  const StateField column = [=](double x, double, double) { return State{rho, 0, 0, 2 - rho * a * x}; };
  for (const Limiter limiter : {Limiter::none, Limiter::minmod}) {
    GasSolver gas = box_with_interface(column, 2, limiter);
    test::OwnedInterface side = uniform_interface(9, {1, 0}, 0, 0);
    std::fill_n(side.a.begin(), 9, a);
    const std::vector<InterfaceValues> values{side.view()};
    gas.apply_fluid_bcs(0, values);
    for (int j = 0; j < 9; ++j) {
      for (const int i : {-1, -2}) EXPECT_NEAR(gas.state()(3, i, j), 2 - rho * a * 0.1 * i, 1e-13);
    }
  }
}

/// A box whose left side, an interface, leans away from the gas over the wall at its bottom, or over the gas.
GasSolver leaning_box(const StateField& initial, double lean = -1.5) {
  grid::GridDescription description = test::rectangle(11, 9, {0, 0}, {1, 1});
  description.mapping = [lean](double r, double s, double) { return Vec2(r + lean * s, s); };
  return test::solver(description, {.p_e = 0.8}, {Interface{}, Outflow{}, SlipWall{}, SlipWall{}}, initial);
}

TEST(Eq31SlipWall, AndALeaningInterfaceHoldTheGasAtTheirCornerBoth) {
  for (const double lean : {-1.5, 1.5}) {
    const Vec2 n = Vec2(1, -lean).normalized(), t(-n[1], n[0]);
    const double into = 0.2, along = 0.1;  // of the gas, seen from the interface; which stands
    const Vec2 v = into * n + along * t;
    const State state{1.2, v[0], v[1], 0.9};
    GasSolver gas = leaning_box([=](double, double, double) { return state; }, lean);
    const test::OwnedInterface side = uniform_interface(9, n, 0, -0.3);
    const std::vector<InterfaceValues> values{side.view()};
    gas.apply_fluid_bcs(0, values);
    const ConstFieldView q = gas.state();
    // p^I = 1.1; then the wave that takes what goes along the interface and leaves it as it is: in a narrow corner that wave
    // runs along the interface, in a wide one off the wall
    const double p_I = 1.1, rho_I = state.rho * (p_I + 0.9 / 6) / (p_I / 6 + 0.9);
    const double a_I = std::sqrt(gamma * p_I / rho_I), strength = lean > 0 ? along : along * t[1];
    for (const int c : {1, 2}) EXPECT_NEAR(q(c, 0, 0), 0, 1e-15);
    EXPECT_NEAR(q(3, 0, 0), p_I * std::pow(1 - 0.2 * strength / a_I, 7), 0.02);
    EXPECT_LT(q(3, 0, 0), p_I);
    EXPECT_NEAR(q(3, 0, 0) / std::pow(q(0, 0, 0), gamma), q(3, 0, 1) / std::pow(q(0, 0, 1), gamma), 1e-14);
    EXPECT_NEAR(q(3, 0, 1), p_I, 1e-15);
    EXPECT_EQ(q(2, 3, 0), 0);  // elsewhere the wall acts along its normal
    EXPECT_EQ(q(1, 3, 0), state.v1);
  }
}

/// An interface that lies ever flatter on the wall gives the corner what the wall alone gives the points beside it.
TEST(Eq31SlipWall, BesideAnInterfaceThatIsNearlyItsContinuationActsAsAlone) {
  const State state{1, 1.5, -0.1, 1};
  for (const double lean : {-3.0, -5.0, -9.0}) {
    GasSolver gas = leaning_box([=](double, double, double) { return state; }, lean);
    const Vec2 n = Vec2(1, -lean).normalized();
    test::OwnedInterface side = uniform_interface(9, n, n.dot(Vec2(state.v1, state.v2)), -0.2);  // p^I = 1
    const std::vector<InterfaceValues> values{side.view()};
    gas.apply_fluid_bcs(0, values);
    EXPECT_NEAR(gas.state()(3, 0, 0), gas.state()(3, 4, 0), 1e-14) << lean;
    EXPECT_NEAR(gas.state()(0, 0, 0), gas.state()(0, 4, 0), 1e-14) << lean;
  }
}

TEST(Eq31WallGhosts, OfACornerBetweenInterfaceAndWallDoNotFeedOnItsPressure) {
  GasSolver gas = leaning_box([](double, double, double) { return State{1, 0, 0, 1}; });
  test::OwnedInterface side = uniform_interface(9, Vec2(1, 1.5).normalized(), 0, -0.2);
  side.w_n[0] = -0.4;  // p^I = 1.2 at the corner, 1 elsewhere
  const std::vector<InterfaceValues> values{side.view()};
  gas.apply_fluid_bcs(0, values);
  const ConstFieldView q = gas.state();
  EXPECT_NEAR(q(3, 0, 0), 1.2, 1e-15);
  for (const int m : {1, 2}) {
    EXPECT_NEAR(q(3, -m, 0), q(3, m, 0), 1e-15);  // behind the interface
    EXPECT_NEAR(q(3, 0, -m), q(3, 0, m), 1e-15);  // below the wall
  }
}

/// Gas in solid-body rotation between two cylinders: exact, steady, with dp/dr = rho v^2 / r.
State rotating_gas(double x, double y, double /*t*/) {
  const double W = 0.5, T = 1 + 0.5 * (gamma - 1) / gamma * W * W * (x * x + y * y);
  const double rho = std::pow(T, 1 / (gamma - 1));
  return {rho, -W * y, W * x, rho * T};
}

/// Ring 0.5 <= r <= 1.5, its lines across skewed by `skew`, turning with varying speed if `spin` is not zero.
grid::GridDescription ring(int n, double skew, double spin) {
  return {.n1 = 6 * n + 1,
          .n2 = n + 1,
          .mapping =
              [=](double r, double s, double t) {
                const double angle = -(2 * pi * r + skew * s * (1 + s) + spin * (t + 0.5 * t * t));
                return Vec2((0.5 + s) * std::cos(angle), (0.5 + s) * std::sin(angle));
              },
          .moving = spin != 0,
          .periodic1 = true};
}

TEST(Eq31WallGhosts, BalanceTheCentrifugalForceOnCurvedSkewedTurningWalls) {
  std::vector<double> errors;
  for (const int n : {10, 20, 40}) {
    GasSolver gas = test::solver(ring(n, 0.3, 0.8), {.limiter = Limiter::none},
                                 {Periodic{}, Periodic{}, SlipWall{}, SlipWall{}}, rotating_gas);
    gas.apply_fluid_bcs(0);
    double error = 0;
    for (int i = 0; i < 6 * n; ++i) {
      for (const int j : {-1, n + 1}) {
        error =
            std::max(error, std::fabs(gas.state()(3, i, j) -
                                      rotating_gas(gas.grid().x()(0, i, j), gas.grid().x()(1, i, j), 0).p));
      }
    }
    errors.push_back(error);
  }
  EXPECT_GT(test::rate(errors), 2.8);  // a ghost value from a second-order derivative over two spacings
  EXPECT_LT(errors.back(), 2e-5);
}

TEST(Eq31SlipWall, ReflectsAShockAsTheJumpConditionsSay) {
  for (const double M : {1.3, 1.6, 2.0, 3.0, 10.0}) {
    const double p1 = 1 + 2 * gamma / (gamma + 1) * (M * M - 1),
                 rho1 = (gamma + 1) * M * M / ((gamma - 1) * M * M + 2);
    const double u1 = std::sqrt(gamma) * 2 / (gamma + 1) * (M - 1 / M);
    const double p2 = p1 * ((3 * gamma - 1) * p1 - (gamma - 1)) / ((gamma - 1) * p1 + (gamma + 1));
    const double rho2 = rho1 * (6 * p2 + p1) / (p2 + 6 * p1);
    const StateField shock = [=](double x, double, double) {
      return x < 0.5 ? State{rho1, u1, 0, p1} : State{1, 0, 0, 1};
    };
    for (const Boundary& wall : {Boundary(SlipWall{}), Boundary(Symmetry{})}) {
      GasSolver gas = test::solver(test::rectangle(101, 5, {0, 0}, {1, 0.1}), {},
                                   {Imposed{shock}, wall, Symmetry{}, SlipWall{}}, shock);
      test::run(gas, 0.7 / (M * std::sqrt(gamma)));
      EXPECT_NEAR(gas.state()(3, 100, 2), p2, 0.01 * p2)
          << M;  // the wall's own start-up error has left by now
      // but for its entropy, which stays at the wall
      EXPECT_NEAR(gas.state()(0, 100, 2), rho2, (M > 3 ? 0.15 : 0.05) * rho2) << M;
      EXPECT_NEAR(gas.state()(0, 99, 2), rho2, (M > 3 ? 0.15 : 0.03) * rho2) << M;
      EXPECT_EQ(gas.state()(1, 100, 2), 0);
    }
  }
}

/// A stream against a wall, from the start: its mirror image comes from behind the wall, and a shock goes back.
TEST(Eq31SlipWall, StopsAStreamOfAnySpeedByAShockThatLeaves) {
  for (const double M : {0.5, 1.5, 2.0, 3.0, 5.0, 8.0, 20.0}) {
    const exact::TubeState stream{.rho = 1, .v = M * std::sqrt(gamma), .p = 1},
        mirrored{.rho = 1, .v = -stream.v, .p = 1};
    const exact::TubeState stopped = exact::Riemann(stream, mirrored, gamma).sample(-1e-9);
    const double speed =
        stream.v / (stopped.rho - 1);  // of the shock: what comes in fills the room behind it
    const StateField all = [=](double, double, double) { return State{1, stream.v, 0, 1}; };
    for (const Boundary& wall : {Boundary(SlipWall{}), Boundary(Symmetry{})}) {
      GasSolver gas = test::solver(test::rectangle(101, 5, {0, 0}, {1, 0.1}), {},
                                   {Imposed{all}, wall, Symmetry{}, Symmetry{}}, all);
      test::run(gas, 0.5 / speed);
      const ConstFieldView q = gas.state();
      EXPECT_NEAR(q(3, 100, 2), stopped.p, 0.02 * stopped.p) << M;
      EXPECT_NEAR(q(3, 60, 2), stopped.p, 0.02 * stopped.p) << M;
      EXPECT_NEAR(q(0, 60, 2), stopped.rho, 0.02 * stopped.rho) << M;
      EXPECT_NEAR(q(3, 30, 2), 1, 1e-9) << M;
      double mass = 0;
      for (int i = 0; i <= 100; ++i) mass += 0.01 * (i % 100 == 0 ? 0.5 : 1) * q(0, i, 2);
      EXPECT_NEAR(mass, 1 + stream.v * 0.5 / speed, 0.01 * mass) << M;
    }
  }
}

/// Three times as dense as the gas beyond, at the same pressure: no shock, and the wall's acceleration presses as ever.
TEST(Eq31WallGhosts, ContinueThePressureOfADenseLayer) {
  const double a = 0.7, rho = 3;
  const StateField layer = [=](double x, double, double) {
    return State{x < 0.05 ? rho : 1, 0, 0, 5 - rho * a * x};
  };
  GasSolver gas = box_with_interface(layer, 5, Limiter::minmod);
  test::OwnedInterface side = uniform_interface(9, {1, 0}, 0, 0);
  std::fill_n(side.a.begin(), 9, a);
  const std::vector<InterfaceValues> values{side.view()};
  gas.apply_fluid_bcs(0, values);
  for (int j = 0; j < 9; ++j) {
    for (const int i : {-1, -2}) EXPECT_NEAR(gas.state()(3, i, j), 5 - rho * a * 0.1 * i, 1e-12);
  }
}

/// Pressure at the stagnation point of a cylinder of so many cells along its radius that is put into a stream of Mach M.
double stagnation_pressure(double M, int cells) {
  const StateField stream = [=](double, double, double) { return State{1, M * std::sqrt(gamma), 0, 1}; };
  const grid::GridDescription front = {
      .n1 = 3 * cells + 1, .n2 = 3 * cells + 1, .mapping = [](double r, double s, double) {
        const double angle = pi * (1.5 - s), R = 4 - 3 * r;
        return Vec2(R * std::cos(angle), R * std::sin(angle));
      }};
  GasSolver gas = test::solver(front, {}, {Imposed{stream}, SlipWall{}, Outflow{}, Outflow{}}, stream);
  test::run(gas, 20 / M);
  return gas.state()(3, 3 * cells, 3 * cells / 2);
}

/// Rayleigh's pitot formula: a shock, then at constant entropy to rest.
double pitot_pressure(double M) {
  const double jump = 1 + 2 * gamma / (gamma + 1) * (M * M - 1);
  const double behind = (1 + 0.5 * (gamma - 1) * M * M) / (gamma * M * M - 0.5 * (gamma - 1));  // Mach^2
  return jump * std::pow(1 + 0.5 * (gamma - 1) * behind, gamma / (gamma - 1));
}

/// Also where the layer behind the shock is two cells thick and gas could leave along the wall as fast as it comes.
TEST(Eq31SlipWall, AStreamMakesABowShockBeforeACylinderOfAFewCells) {
  for (const double M : {2.0, 3.0, 4.0, 6.0, 8.0}) {
    for (const int cells : {4, 6, 10})
      EXPECT_NEAR(stagnation_pressure(M, cells) / pitot_pressure(M), 1, 0.1) << M << " " << cells;
  }
}

/// Points of sides that a bound held, of gas that is given its sides once, with a wall on the right of a stream of Mach M.
std::uint64_t bounded_by_wall(double M, Limiter limiter) {
  const StateField stream = [M](double, double, double) { return State{1, M * std::sqrt(gamma), 0, 1}; };
  GasSolver gas = test::solver(test::rectangle(21, 5, {0, 0}, {1, 0.2}), {.limiter = limiter},
                               {Imposed{stream}, SlipWall{}, Symmetry{}, Symmetry{}}, stream);
  gas.apply_fluid_bcs(0);
  return gas.health().bounded_side_points;
}

/// 1 - (gamma - 1) M / 2 of the speed of sound is left at a wall that runs away: a tenth at M = 4.5. Behind a wall that is run
/// into, the density is held from half of that inside on.
TEST(Eq31SlipWall, CountsThePointsWhereABoundHoldsWhatItLeaves) {
  for (const Limiter limiter : {Limiter::none, Limiter::minmod}) {
    for (const double gentle : {0.0, 0.1, -0.1}) EXPECT_EQ(bounded_by_wall(gentle, limiter), 0U) << gentle;
    EXPECT_GE(bounded_by_wall(-4.6, limiter), 5U);  // a side has five points
  }
  EXPECT_EQ(bounded_by_wall(5, Limiter::minmod), 5U);
}

TEST(Extrapolation, CountsWhatWouldBeNegative) {
  const StateVector one(1, 0, 0, 1), tenth(0.1, 0, 0, 0.1), more(1.2, 0.1, 0, 1.1);
  EXPECT_FALSE(extrapolated(one, more, one, false).bounded);
  const BoundedState below = extrapolated(tenth, one, 2 * one, false);  // -0.9 and less
  EXPECT_TRUE(below.bounded);
  EXPECT_EQ(below.q, tenth);
}

TEST(Outflow, LetsASoundWaveLeave) {
  const StateField pulse = [](double x, double, double) {
    const double e = 1e-3 * std::exp(-100 * (x - 0.5) * (x - 0.5)), a = 1;  // runs to the right
    return State{1 + e, a * e, 0, 1 / gamma + a * a * e};
  };
  GasSolver gas = test::solver(test::rectangle(101, 5, {0, 0}, {1, 0.1}), {.limiter = Limiter::none},
                               {Outflow{}, Outflow{}, Symmetry{}, Symmetry{}}, pulse);
  test::run(gas, 1.2);
  const double left = test::largest_error(gas.errors(
      [](double, double, double) {
        return State{1, 0, 0, 1 / gamma};
      },
      0));
  EXPECT_LT(left, 1e-5);  // one per cent of the pulse
}

/// An interface on the left of gas at rest that moves with v_n and has the pressure of the exact wave.
struct SuddenWall {
  exact::TubeState star;
  State at_wall;

  explicit SuddenWall(double v_n) {
    const State rest{1.3, 0, 0.2, 0.8};
    const exact::TubeState right{.rho = rest.rho, .v = 0, .p = rest.p},
        mirrored{.rho = rest.rho, .v = 2 * v_n, .p = rest.p};  // its contact moves with v_n
    const exact::Riemann waves(mirrored, right, 1.4);
    star = waves.sample(v_n + 1e-9);
    GasSolver gas = box_with_interface([rest](double, double, double) { return rest; }, 0.5);
    const test::OwnedInterface side = uniform_interface(9, {1, 0}, v_n, 0.5 - star.p);
    const std::vector<InterfaceValues> values{side.view()};
    gas.apply_fluid_bcs(0, values);
    const ConstFieldView q = gas.state();
    at_wall = {.rho = q(0, 0, 4), .v1 = q(1, 0, 4), .v2 = q(2, 0, 4), .p = q(3, 0, 4)};
  }
};

TEST(InterfaceState, IsThatBehindTheExactShockOrRarefactionOfAnyStrength) {
  for (const double v_n : {-2.5, -0.3, 0.4, 3.0}) {
    const SuddenWall wall(v_n);
    EXPECT_NEAR(wall.at_wall.rho, wall.star.rho, 1e-12 * wall.star.rho) << v_n;
    EXPECT_NEAR(wall.at_wall.p, wall.star.p, 1e-12 * wall.star.p) << v_n;
    EXPECT_NEAR(wall.at_wall.v1, v_n, 1e-12);
    EXPECT_EQ(wall.at_wall.v2, 0.2);
  }
}

}  // namespace
}  // namespace fsi::fluid
