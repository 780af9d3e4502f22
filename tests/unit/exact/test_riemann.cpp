// The Riemann solution is judged by the conservation laws across its waves.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "common/core/failure.hpp"
#include "common/exact/riemann.hpp"

namespace fsi::exact {
namespace {

constexpr double gamma = 1.4;
const TubeState sod_left{.rho = 1, .v = 0, .p = 1};
const TubeState sod_right{.rho = 0.125, .v = 0, .p = 0.1};

double energy(const TubeState& q) {
  return q.p / (gamma - 1) + 0.5 * q.rho * q.v * q.v;
}

void expect_rankine_hugoniot(const TubeState& a, const TubeState& b, double shock) {
  const auto jump = [&](double flux_a, double flux_b, double density_a, double density_b) {
    return flux_b - flux_a - shock * (density_b - density_a);
  };
  const double size = std::abs(shock) * energy(a) + energy(b) * (1 + std::abs(b.v));
  EXPECT_NEAR(jump(a.rho * a.v, b.rho * b.v, a.rho, b.rho), 0, 1e-13 * size);
  EXPECT_NEAR(jump(a.rho * a.v * a.v + a.p, b.rho * b.v * b.v + b.p, a.rho * a.v, b.rho * b.v), 0,
              1e-13 * size);
  EXPECT_NEAR(jump((energy(a) + a.p) * a.v, (energy(b) + b.p) * b.v, energy(a), energy(b)), 0, 1e-13 * size);
}

/// Ray on which the sampled state leaves that of the outer right gas.
double right_front(const Riemann& riemann, const TubeState& right, double fastest) {
  double inside = riemann.v_star(), outside = fastest;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (inside + outside);
    (riemann.sample(middle).p == right.p ? outside : inside) = middle;
  }
  return outside;
}

TEST(Riemann, ShockOfTheSodTubeSatisfiesRankineHugoniot) {
  const Riemann riemann(sod_left, sod_right, gamma);
  const double shock = right_front(riemann, sod_right, 10);
  EXPECT_NEAR(shock, 1.7522, 5e-5);  // the well-known shock speed of this tube
  expect_rankine_hugoniot(riemann.sample(shock - 1e-9), sod_right, shock);
}

TEST(Riemann, StarPressureOfTheSodTubeIsTheWellKnownOne) {
  EXPECT_NEAR(Riemann(sod_left, sod_right, gamma).p_star(), 0.30313, 5e-6);
}

TEST(Riemann, FanIsIsentropicAndCarriesItsInvariant) {
  const Riemann riemann(sod_left, sod_right, gamma);
  const auto sound = [](const TubeState& q) { return std::sqrt(gamma * q.p / q.rho); };
  for (const double speed : {-1.1, -0.6, -0.2, 0.0, 0.5}) {
    const TubeState q = riemann.sample(speed);
    EXPECT_NEAR(q.p / std::pow(q.rho, gamma), 1, 1e-14) << speed;
    EXPECT_NEAR(q.v + 2 * sound(q) / (gamma - 1), 2 * std::sqrt(gamma) / (gamma - 1), 1e-13) << speed;
    const bool inside_the_fan = q.v > 0 && q.v < riemann.v_star() * (1 - 1e-9);
    if (inside_the_fan) {
      EXPECT_NEAR(q.v - sound(q), speed, 1e-14);
    }
  }
}

TEST(Riemann, PressureAndVelocityDoNotJumpOverTheContact) {
  const Riemann riemann(sod_left, sod_right, gamma);
  const TubeState a = riemann.sample(riemann.v_star() - 1e-9), b = riemann.sample(riemann.v_star() + 1e-9);
  EXPECT_NEAR(a.p, b.p, 1e-15);
  EXPECT_NEAR(a.v, b.v, 1e-15);
  EXPECT_GT(std::abs(a.rho - b.rho), 0.1);
}

TEST(Riemann, TwoStreamsThatMeetMakeTwoEqualShocks) {
  const TubeState left{.rho = 1, .v = 2, .p = 0.1}, right{.rho = 1, .v = -2, .p = 0.1};
  const Riemann riemann(left, right, gamma);
  EXPECT_NEAR(riemann.v_star(), 0, 1e-15);
  const double shock = right_front(riemann, right, 10);
  expect_rankine_hugoniot(riemann.sample(0.5 * shock), right, shock);
  expect_rankine_hugoniot(riemann.sample(-0.5 * shock), left, -shock);
}

TEST(Riemann, MirroredStatesGiveTheMirroredSolution) {
  const Riemann there(sod_left, sod_right, gamma), back(sod_right, sod_left, gamma);
  for (const double speed : {-2.0, -1.0, -0.3, 0.2, 0.9, 1.5}) {
    EXPECT_NEAR(there.sample(speed).rho, back.sample(-speed).rho, 1e-14);
    EXPECT_NEAR(there.sample(speed).v, -back.sample(-speed).v, 1e-14);
  }
}

TEST(Riemann, VeryStrongBlastIsSolvedToo) {
  const TubeState left{.rho = 1, .v = 0, .p = 1e5}, right{.rho = 1, .v = 0, .p = 1e-2};
  const Riemann riemann(left, right, gamma);
  const double shock = right_front(riemann, right, 1e4);
  expect_rankine_hugoniot(riemann.sample(shock * (1 - 1e-9)), right, shock);
}

TEST(Riemann, EqualStatesStayAsTheyAre) {
  const TubeState state{.rho = 0.7, .v = 0.3, .p = 2};
  const Riemann riemann(state, state, gamma);
  for (const double speed : {-3.0, 0.0, 0.3, 3.0}) {
    EXPECT_DOUBLE_EQ(riemann.sample(speed).rho, state.rho);
    EXPECT_DOUBLE_EQ(riemann.sample(speed).p, state.p);
  }
}

TEST(Riemann, AVacuumIsRefused) {
  EXPECT_THROW(Riemann({.rho = 1, .v = -10, .p = 1}, {.rho = 1, .v = 10, .p = 1}, gamma),
               std::invalid_argument);
}

TEST(RiemannTube, ShowsTheTwoGasesAtTimeZeroAndTheFanLater) {
  const auto tube = make_solution(ReferenceKind::riemann, {{"x_0", 0.25}}, "");
  EXPECT_EQ(tube->gas(0.2, 0.9, 0).rho, 1);
  EXPECT_EQ(tube->gas(0.3, 0.9, 0).rho, 0.125);
  EXPECT_NEAR(tube->gas(0.25 + 0.1 * 1.2, 0, 0.1).p, 0.30313, 5e-6);
}

TEST(MakeSolution, SaysWhichNumberItDoesNotKnowAndWhichItHas) {
  try {
    make_solution(ReferenceKind::elastic_piston, {{"density", 1}}, "");
    FAIL() << "an unknown number must be refused";
  } catch (const UserMistake& mistake) {
    EXPECT_NE(std::string(mistake.what()).find("'density'"), std::string::npos);
    EXPECT_NE(std::string(mistake.what()).find("density_ratio"), std::string::npos);
  }
}

TEST(MakeSolution, IsForNamedSolutionsAlone) {
  for (const ReferenceKind kind :
       {ReferenceKind::none, ReferenceKind::expressions, ReferenceKind::manufactured})
    EXPECT_THROW(make_solution(kind, {}, ""), UserMistake);
}

}  // namespace
}  // namespace fsi::exact
