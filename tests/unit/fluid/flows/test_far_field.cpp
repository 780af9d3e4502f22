/// Sides through which waves leave while a given state comes in.

#include <gtest/gtest.h>

#include "fluid_solver/boundary/far_field.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

constexpr double gamma = 1.4;

double sound(const StateVector& q) {
  return std::sqrt(gamma * q[3] / q[0]);
}

TEST(FarFieldState, IsTheStateOfBothSidesWhereTheyAreEqual) {
  const StateVector q(0.7, 0.3, -0.4, 1.3);
  EXPECT_EQ(between(q, q, {.n = Vec2(0.6, 0.8), .speed = 0.1, .gamma = gamma}).q, q);
}

TEST(FarFieldState, IsThatInsideOrThatBeyondWhereTheGasIsFasterThanSound) {
  const StateVector inside(1, 3, 0.2, 1), beyond(1.1, 2.8, 0.1, 1.2);
  EXPECT_EQ(between(inside, beyond, {.n = Vec2(1, 0), .gamma = gamma}).q, inside);
  EXPECT_LT((between(inside, beyond, {.n = Vec2(-1, 0), .gamma = gamma}).q - beyond).norm(), 1e-14);
}

TEST(FarFieldState, TakesEntropyShearAndOneInvariantFromWhereTheyComeFrom) {
  const StateVector inside(1, 0.3, 0.2, 1), beyond(1.1, 0.25, -0.1, 1.2);
  const auto entropy = [](const StateVector& q) { return q[3] / std::pow(q[0], gamma); };
  // Of gas with the entropy of `of` that has come to the pressure and the speed of q.
  const auto invariant = [](const StateVector& q, double sign, const StateVector& of) {
    return q[1] + sign * 2 / (gamma - 1) * sound(of) * std::pow(q[3] / of[3], (gamma - 1) / (2 * gamma));
  };
  for (const double out : {1.0, -1.0}) {  // the gas leaves through the side, or comes in
    const StateVector q = between(inside, beyond, {.n = Vec2(out, 0), .gamma = gamma}).q;
    const StateVector& carried = out > 0 ? inside : beyond;
    EXPECT_NEAR(invariant(q, out, inside), invariant(inside, out, inside), 1e-14);
    EXPECT_NEAR(invariant(q, -out, beyond), invariant(beyond, -out, beyond), 1e-14);
    EXPECT_NEAR(entropy(q), entropy(carried), 1e-14);
    EXPECT_NEAR(q[2], carried[2], 1e-15);
  }
}

TEST(FarFieldState, OfAContactIsThatOfTheSideFromWhichItComes) {
  for (const double g : {gamma, 1.000001}) {
    const StateVector inside(0.5, 0.3, 0.1, 1.2), beyond(1, 0.3, -0.2, 1.2);
    EXPECT_EQ(between(inside, beyond, {.n = Vec2(1, 0), .gamma = g}).q, inside);
    EXPECT_EQ(between(inside, beyond, {.n = Vec2(-1, 0), .gamma = g}).q, beyond);
    EXPECT_EQ(between(inside, beyond, {.n = Vec2(1, 0), .speed = 0.4, .gamma = g}).q, beyond);
  }
}

/// A shock of Mach 1.8 into a stream of Mach 2 is carried along, one into a stream of Mach 1.2 is not.
TEST(FarFieldState, IsThatBeyondWhereTheGasInsideCannotHoldItsStream) {
  const double a = std::sqrt(gamma);
  const StateVector at_rest(1, 0, 0, 1), fast(1, 2 * a, 0, 1), slower(1, 1.2 * a, 0, 1);
  EXPECT_EQ(between(at_rest, fast, {.n = Vec2(-1, 0), .gamma = gamma}).q, fast);
  EXPECT_GT(between(at_rest, slower, {.n = Vec2(-1, 0), .gamma = gamma}).q[3], 2);
}

/// Streams that part leave nothing between them from a difference of 4 / (gamma - 1) speeds of sound on, and on the side the speed
/// of sound is (1 - (gamma - 1) / 4 times that difference) of that inside, but not less than a tenth.
TEST(FarFieldState, OfStreamsThatTearTheGasApartIsBounded) {
  const auto side_between = [](double apart) {
    const double a = std::sqrt(gamma);
    return between({1, 0, 0, 1}, {1, apart * a, 0, 1}, {.n = Vec2(1, 0), .gamma = gamma});
  };
  for (const double apart : {-1.0, 0.0, 2.0, 8.9}) {
    EXPECT_FALSE(side_between(apart).bounded) << apart;
    EXPECT_NEAR(sound(side_between(apart).q), (1 - 0.1 * apart) * std::sqrt(gamma), 1e-12) << apart;
  }
  EXPECT_TRUE(side_between(9.1).bounded);
  EXPECT_NEAR(sound(side_between(12).q), 0.1 * std::sqrt(gamma), 1e-12);
}

TEST(FarField, KeepsUniformFlowOfAnyDirectionAndSpeed) {
  for (const Vec2& v : {Vec2(0.4, 0.1), Vec2(-0.5, 0.3), Vec2(0, 0), Vec2(2.5, -2)}) {
    const State stream{1.2, v[0], v[1], 0.9};
    const StateField uniform = [stream](double, double, double) { return stream; };
    const Boundary open = FarField{uniform};
    GasSolver gas = test::solver(test::wavy(21, 17, {0, 0}, {1, 1}), {}, {open, open, open, open}, uniform);
    test::run(gas, 0.3);
    EXPECT_LT(test::largest_error(gas.errors(uniform, 0.3)), 1e-13);
  }
}

/// A simple wave (2% of the pressure) that runs out of a tube
/// to the left, against a stream that comes in there.
struct Tube {
  GasSolver gas;

  explicit Tube(const Boundary& left)
      : gas(test::solver(test::rectangle(201, 5, {0, 0}, {1, 0.02}), {},
                         {left, Outflow{}, Symmetry{}, Symmetry{}}, wave)) {}

  static State wave(double x, double, double) {
    const double a_0 = std::sqrt(gamma), a = a_0 * (1 + 0.003 * std::exp(-std::pow((x - 0.4) / 0.08, 2)));
    const double rho = std::pow(a / a_0, 2 / (gamma - 1));
    return {rho, 0.4 - 2 / (gamma - 1) * (a - a_0), 0, std::pow(rho, gamma)};
  }
  double disturbance(int i) const { return std::fabs(gas.state()(3, i, 2) - 1); }
};

const StateField subsonic = [](double, double, double) { return State{1, 0.4, 0, 1}; };

TEST(FarField, LetsAWaveOutWithoutAnEcho) {
  Tube tube(FarField{subsonic});
  test::run(tube.gas, 1.05);  // it left at 0.8; what comes back is twice as fast
  for (int i = 0; i < 201; ++i) EXPECT_LT(tube.disturbance(i), 1e-6);  // 5e-5 of the wave
}

TEST(FarField, ShowsTheWaveOnTheSideThatAnInflowHides) {
  Tube tube(FarField{subsonic}), hidden(Imposed{subsonic});
  const double crest = 0.4 / (std::sqrt(gamma) - 0.4);  // the time it takes to the side
  test::run(tube.gas, crest);
  test::run(hidden.gas, crest);
  // Two points a sixteenth of the wave's width apart, about its crest.
  EXPECT_NEAR(tube.disturbance(0), tube.disturbance(1), 0.01 * tube.disturbance(1));
  EXPECT_GT(tube.disturbance(0), 0.018);
  EXPECT_EQ(hidden.disturbance(0), 0);
}

/// Warm or cold gas is carried out and other gas comes in: exact are one pressure and one velocity everywhere.
TEST(FarField, LetsContactsThrough) {
  for (const double other : {0.5, 2.0}) {
    const StateField start = [other](double x, double, double) {
      return State{1 + 0.5 * (other - 1) * (1 - std::tanh((std::fabs(x - 0.5) - 0.2) / 0.05)), 0.3, 0, 1};
    };
    const StateField beyond = [other](double x, double, double) {
      return State{x > 0.5 ? 1.0 : other, 0.3, 0, 1};
    };
    GasSolver gas = test::solver(test::rectangle(81, 5, {0, 0}, {1, 0.05}), {},
                                 {FarField{beyond}, FarField{beyond}, Symmetry{}, Symmetry{}}, start);
    test::run(gas, 2);
    for (int i = 0; i < 81; ++i) {
      EXPECT_NEAR(gas.state()(3, i, 2), 1, 1e-10) << other << " " << i;
      EXPECT_NEAR(gas.state()(1, i, 2), 0.3, 1e-10) << other << " " << i;
    }
    EXPECT_NEAR(gas.state()(0, 20, 2), other, 1e-3);
  }
}

TEST(FarField, KeepsSecondOrderWhereAVortexGoesThroughIt) {
  const test::Vortex vortex{.x_0 = 2};
  const Boundary open = FarField{vortex};
  std::vector<double> errors;
  for (const int n : {20, 40, 80}) {
    GasSolver gas = test::solver(test::rectangle(n + 1, n + 1, {-3, -3}, {3, 3}), {.limiter = Limiter::none},
                                 {open, open, open, open}, vortex);
    test::run(gas, 1);
    errors.push_back(test::largest_error(gas.errors(vortex, 1)));
  }
  EXPECT_GT(test::rate(errors), 1.9);
}

}  // namespace
}  // namespace fsi::fluid
