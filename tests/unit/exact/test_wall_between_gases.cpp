// Sound that meets a wall between two gases: checked by the equations of gas and wall, never by its own formulas.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/exact/wall_between_gases.hpp"

namespace fsi::exact {
namespace {

/// Two gases that differ, a pulse of size 1: the solution is linear in it.
WallBetweenGasesData data_with() {
  WallBetweenGasesData data;
  data.gamma_left = 1.4;
  data.rho_left = 1.4;
  data.gamma_right = 5.0 / 3;
  data.rho_right = 0.4;
  data.p = 1;
  data.thickness = 0.5;
  data.rho_bar = 2;
  data.c_p = 1.3;
  data.size = 1;
  data.distance = 0.1;
  data.length = 0.8;
  return data;
}

WallBetweenGasesData of_mass(double mass) {
  WallBetweenGasesData data = data_with();
  data.mass = mass;
  return data;
}

WallBetweenGasesData clamped() {
  WallBetweenGasesData data = data_with();
  data.clamped = true;
  return data;
}

template <class Function>
double slope_at(Function f, double at, double h = 1e-3) {
  return (8 * (f(at + h) - f(at - h)) - (f(at + 2 * h) - f(at - 2 * h))) / (12 * h);
}

/// h^4 times a fifth derivative of the pulse, of some 1e4.
constexpr double of_differences = 1e-7;

constexpr std::array times{0.05, 0.3, 0.51, 0.77, 1.1, 1.6, 2.4};

TEST(WallBetweenGases, BothGasesObeyTheEquationsOfSound) {
  for (const bool stiff : {false, true}) {
    const WallBetweenGases wall(stiff ? of_mass(0.7) : data_with());
    for (const auto& [x, rho, square] :
         {std::array{-0.4, 1.4, 1.0}, std::array{-0.05, 1.4, 1.0}, std::array{0.6, 0.4, 5.0 / 3 / 0.4}}) {
      for (const double t : times) {
        const auto rate = [&](auto member) {
          return slope_at([&](double s) { return member(wall.gas(x, 0, s)); }, t);
        };
        const auto along = [&](auto member) {
          return slope_at([&](double s) { return member(wall.gas(s, 0, t)); }, x);
        };
        const auto p = [](const GasState& q) { return q.p; };
        const auto v = [](const GasState& q) { return q.v1; };
        const auto density = [](const GasState& q) { return q.rho; };
        EXPECT_NEAR(rho * rate(v), -along(p), of_differences) << x << " " << t;
        EXPECT_NEAR(rate(p), -rho * square * along(v), of_differences * square) << x << " " << t;
        EXPECT_NEAR(square * rate(density), rate(p), of_differences * square) << x << " " << t;
      }
    }
  }
}

TEST(WallBetweenGases, GasAndElasticWallMoveTogetherAndPressAlikeAtBothFaces) {
  const WallBetweenGases wall(data_with());
  for (const double t : times) {
    for (const double x : {0.0, 0.5}) {
      const double beside = x > 0 ? 1e-13 : -1e-13;
      const GasState gas = wall.gas(x + beside, 0, t);
      const SolidState solid = wall.solid(x, 0, t);
      EXPECT_NEAR(gas.v1, solid.v[0], 1e-10);
      EXPECT_NEAR(1 - gas.p, solid.P(0, 0), 1e-10);
    }
  }
}

void expect_elastic(const WallBetweenGases& wall) {
  const double modulus = 2 * 1.3 * 1.3;
  for (const double x : {0.11, 0.25, 0.4}) {
    for (const double t : times) {
      const auto u_of_t = [&](double s) { return wall.solid(x, 0, s).u[0]; };
      const auto u_of_x = [&](double s) { return wall.solid(s, 0, t).u[0]; };
      const auto v_of_t = [&](double s) { return wall.solid(x, 0, s).v[0]; };
      const auto P_of_x = [&](double s) { return wall.solid(s, 0, t).P(0, 0); };
      const SolidState solid = wall.solid(x, 0, t);
      EXPECT_NEAR(slope_at(u_of_t, t), solid.v[0], of_differences);
      EXPECT_NEAR(modulus * slope_at(u_of_x, x), solid.P(0, 0), of_differences);
      EXPECT_NEAR(modulus / 3 * slope_at(u_of_x, x), solid.P(1, 1), of_differences);
      EXPECT_NEAR(2 * slope_at(v_of_t, t), slope_at(P_of_x, x), of_differences);
    }
  }
}

TEST(WallBetweenGases, TheElasticWallObeysHookesLawAndItsMomentumIsBalanced) {
  expect_elastic(WallBetweenGases(data_with()));
}

TEST(WallBetweenGases, AClampedWallHasOneGasAndDoesNotMoveAtItsFarFace) {
  const WallBetweenGases wall(clamped());
  expect_elastic(wall);
  for (const double t : times) {
    const GasState gas = wall.gas(-1e-13, 0, t);
    const SolidState face = wall.solid(0, 0, t), far = wall.solid(0.5, 0, t);
    EXPECT_NEAR(gas.v1, face.v[0], 1e-10);
    EXPECT_NEAR(1 - gas.p, face.P(0, 0), 1e-10);
    EXPECT_NEAR(far.u[0], 0, 1e-12);
    EXPECT_NEAR(far.v[0], 0, 1e-12);
    EXPECT_NEAR(wall.right_face(t), 0, 1e-12);
  }
  EXPECT_LT(wall.solid(0.5, 0, 1.1).P(0, 0), -0.1);  // it presses against what holds it
}

TEST(WallBetweenGases, AClampedWallIsTheLimitOfAHeavyGasBehindIt) {
  WallBetweenGasesData heavy = data_with();
  heavy.rho_right = 1e14;
  const WallBetweenGases limit(heavy), wall(clamped());
  for (const double t : times) {
    for (const double x : {0.0, 0.2, 0.5})
      EXPECT_NEAR(wall.solid(x, 0, t).v[0], limit.solid(x, 0, t).v[0], 1e-6);
  }
}

TEST(WallBetweenGases, AWallOfMassAloneIsMovedByTheDifferenceOfThePressures) {
  for (const double mass : {1e-3, 0.03, 0.1, 0.2, 1.0, 30.0, 1e3}) {
    const WallBetweenGases wall(of_mass(mass));
    for (const double t : times) {
      const auto v = [&](double s) { return wall.left_face(s); };
      const double push = wall.gas(-1e-13, 0, t).p - wall.gas(0.5 + 1e-13, 0, t).p;
      EXPECT_NEAR(mass * slope_at(v, t), push, std::max(1.0, mass) * of_differences) << mass << " " << t;
      EXPECT_NEAR(wall.gas(-1e-13, 0, t).v1, v(t), 1e-10);
      EXPECT_NEAR(wall.gas(0.5 + 1e-13, 0, t).v1, v(t), 1e-10);
      EXPECT_NEAR(slope_at([&](double s) { return wall.solid(0, 0, s).u[0]; }, t), v(t), of_differences);
    }
  }
}

TEST(WallBetweenGases, AWallOfNoMassIsTheLimitOfLightOnes) {
  const WallBetweenGases none(of_mass(0)), light(of_mass(1e-7));
  for (const double t : times) {
    EXPECT_NEAR(none.left_face(t), light.left_face(t), 1e-6);
    EXPECT_NEAR(none.gas(-1e-13, 0, t).p, none.gas(0.5 + 1e-13, 0, t).p, 1e-11);
  }
}

TEST(WallBetweenGases, BeforeThePulseComesAllIsAtRest) {
  const WallBetweenGases wall(data_with());
  EXPECT_EQ(wall.left_face(0.0999), 0);
  EXPECT_EQ(wall.gas(0.6, 0, 0).rho, 0.4);
  EXPECT_EQ(wall.gas(-1.2, 0, 0).p, 1);
  EXPECT_GT(wall.gas(-0.5, 0, 0).p, 1.9);  // the middle of the pulse
}

/// Whatever the wall is made of, gases that are compressed by the way of the wall take the momentum of the pulse and of its
/// reflection: (z_left + z_right) u = 2 I, I the time integral of its pressure.
TEST(WallBetweenGases, LongAfterThePulseTheElasticWallRestsWhereTheGasesHoldIt) {
  WallBetweenGasesData data = data_with();
  constexpr double impulse =
      256 * 576.0 / 362880 * 0.8;  // of (4 s (1 - s))^4 over a length of 0.8, a = p = size = 1
  const double z = 1.4 + std::sqrt(5.0 / 3 * 0.4);
  for (const double thickness : {0.5, 0.01}) {
    data.thickness = thickness;
    const WallBetweenGases wall(data);
    for (const double t : {40.0, 1e3, 1e300}) {
      for (const double x : {0.0, 0.5 * thickness, thickness}) {
        EXPECT_NEAR(wall.solid(x, 0, t).u[0], 2 * impulse / z, 1e-12) << thickness << " " << t << " " << x;
        EXPECT_NEAR(wall.solid(x, 0, t).v[0], 0, 1e-12) << thickness << " " << t << " " << x;
      }
    }
  }
}

TEST(WallBetweenGases, AWallTooThinForItsEchoesIsToldItsMass) {
  WallBetweenGasesData data = data_with();
  data.thickness = 1e-6;
  EXPECT_THROW(WallBetweenGases{data}, std::invalid_argument);
  data.mass = data.rho_bar * data.thickness;
  EXPECT_NO_THROW(WallBetweenGases{data});
}

TEST(WallBetweenGases, DataWithoutASolutionAreRefused) {
  WallBetweenGasesData data = data_with();
  data.rho_right = 0;
  EXPECT_THROW(WallBetweenGases{data}, std::invalid_argument);
  EXPECT_THROW(WallBetweenGases{of_mass(-1)}, std::invalid_argument);
  data = data_with();
  data.distance = -0.1;
  EXPECT_THROW(WallBetweenGases{data}, std::invalid_argument);
  data = of_mass(1);
  data.clamped = true;
  EXPECT_THROW(WallBetweenGases{data}, std::invalid_argument);
}

}  // namespace
}  // namespace fsi::exact
