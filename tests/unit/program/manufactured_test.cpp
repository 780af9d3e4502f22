#include "solid_solver/measures/manufactured.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solid_solver/kernels/state.hpp"
#include "solid_solver/laws/linear_elastic.hpp"
#include "solid_solver/laws/neo_hookean.hpp"

namespace fsi::solid {
namespace {

/// Plane p-wave along a direction: an exact solution of the linear law without any force.
TEST(Manufactured, Eq2NeedsNoForceForAPlaneWaveOfTheLinearLaw) {
  const LinearElastic law{1.3, 0.7};
  const double rho = 2.0, c_p = std::sqrt((law.lambda + 2 * law.mu) / rho);
  const Vec2 n(0.6, 0.8);
  const Manufactured wave({.u = [=](double x, double y, double t) -> Vec2 {
                            return 0.01 * std::sin(3 * (n[0] * x + n[1] * y - c_p * t)) * n;
                          }},
                          law, rho, 1);
  // Inertia alone is rho (3 c_p)^2 0.01 = 0.24; what is left is the error of the differences.
  EXPECT_LT(wave.body_force(0.3, 0.2, 0.4).norm(), 1e-9);
}

TEST(Manufactured, ForceIsInertiaMinusTheDivergenceOfTheStressOfEq10) {
  const NeoHookean law{1.1, 0.8};
  const Manufactured motion(
      {.u = [](double x, double y, double t) -> Vec2 {
        return {0.05 * std::sin(2 * x + y) * std::cos(t), 0.04 * std::cos(x - 2 * y) * std::sin(t + 1)};
      }},
      law, 1.5, 1);
  const double x = 0.2, y = -0.3, t = 0.7, h = 1e-3;
  const auto P = [&](double a, double b) { return motion.state(a, b, t).P; };
  const auto rate = [&](double a) { return motion.velocity(x, y, a); };
  const Vec2 v_t = (8 * (rate(t + h) - rate(t - h)) - (rate(t + 2 * h) - rate(t - 2 * h))) / (12 * h);
  const auto d = [&](auto component, double a, double b) {
    return (8 * (component(P(x + a, y + b)) - component(P(x - a, y - b))) -
            (component(P(x + 2 * a, y + 2 * b)) - component(P(x - 2 * a, y - 2 * b)))) /
           (12 * h);
  };
  const Vec2 div(
      d([](const Tensor2& p) { return p.a11; }, h, 0) + d([](const Tensor2& p) { return p.a21; }, 0, h),
      d([](const Tensor2& p) { return p.a12; }, h, 0) + d([](const Tensor2& p) { return p.a22; }, 0, h));
  EXPECT_LT((motion.body_force(x, y, t) - (1.5 * v_t - div)).norm(), 1e-9);
}

/// u, v and P that do not belong to each other, as in paper eq. (46): with the sources, their rates are those
/// of the equations.
TEST(Eq46ChosenFields, SourcesAreWhatTheRatesOfEq4Lack) {
  const NeoHookean law{1.1, 0.8};
  const double rho = 1.5, x = 0.2, y = -0.3, t = 0.7;
  const ChosenFields fields{.u = [](double a, double b, double c) -> Vec2 {
                              return {0.1 * a * c, 0.2 * b * b * c};
                            },
                            .v = [](double a, double b, double c) -> Vec2 {
                              return {a * b, c * c * a};
                            },
                            .P = [](double a, double b, double c) -> Tensor2 {
                              return {a * a, 3 * c, a * b, b * c};
                            }};
  const Manufactured chosen(fields, law, rho, 1);
  const SolidState source = chosen.source(x, y, t);
  EXPECT_LT((source.u + fields.v(x, y, t) - Vec2(0.1 * x, 0.2 * y * y)).norm(), 1e-9);       // du/dt
  EXPECT_LT((rho * source.v + Vec2(2 * x + x, t) - rho * Vec2(0, 2 * t * x)).norm(), 1e-8);  // dv/dt
  const Tensor2 F = {1 + 0.1 * t, 0, 0, 1 + 0.4 * y * t};
  const Tensor2 work = contract(law.K(F), {y, x, t * t, 0});
  EXPECT_NEAR(source.P.a11 + work.a11, 0, 1e-8);
  EXPECT_NEAR(source.P.a12 + work.a12, 3, 1e-8);
  EXPECT_NEAR(source.P.a21 + work.a21, 0, 1e-8);
  EXPECT_NEAR(source.P.a22 + work.a22, y, 1e-8);
  EXPECT_NEAR(chosen.offset(x, y, t).a12, 3 * t - law.P(F).a12, 1e-9);
}

TEST(Eq46ChosenFields, NeedOnlyTheBodyForceWhereVelocityAndStressFollowFromTheDisplacement) {
  const NeoHookean law{1.1, 0.8};
  const Manufactured motion(
      {.u = [](double x, double y, double t) -> Vec2 {
        return {0.05 * std::sin(2 * x + y) * std::cos(t), 0.04 * std::cos(x - 2 * y) * std::sin(t + 1)};
      }},
      law, 1.5, 1);
  const SolidState source = motion.source(0.2, -0.3, 0.7);
  EXPECT_LT(source.u.norm(), 1e-9);
  EXPECT_LT((source.v - motion.body_force(0.2, -0.3, 0.7) / 1.5).norm(), 1e-7);
  EXPECT_LT(std::abs(source.P.a11) + std::abs(source.P.a12) + std::abs(source.P.a21) + std::abs(source.P.a22),
            1e-7);
}

TEST(Manufactured, IsTheSameToTheBitInOtherUnits) {
  constexpr double length = 0x1p-5, time = 0x1p9, density = 0x1p3, speed = length / time,
                   pressure = density * speed * speed;
  const VectorFunction u = [](double x, double y, double t) -> Vec2 {
    return {0.05 * std::sin(2 * x + y) * std::cos(t), 0.04 * std::cos(x - 2 * y) * std::sin(t + 1)};
  };
  const VectorFunction its_u = [&](double x, double y, double t) -> Vec2 {
    return length * u(x / length, y / length, t / time);
  };
  const Manufactured one({.u = u}, NeoHookean{1.1, 0.8}, 1.5, 1.3);
  const Manufactured other({.u = its_u}, NeoHookean{1.1 * pressure, 0.8 * pressure}, 1.5 * density,
                           1.3 * length);
  constexpr double x = 0.2, y = -0.3, t = 0.7;
  EXPECT_EQ(Vec2(speed * one.velocity(x, y, t)), other.velocity(x * length, y * length, t * time));
  EXPECT_EQ(Vec2(pressure / length * one.body_force(x, y, t)),
            other.body_force(x * length, y * length, t * time));
  const SolidState source = one.source(x, y, t), its = other.source(x * length, y * length, t * time);
  EXPECT_EQ(Vec2(speed * source.u), its.u);
  EXPECT_EQ(Vec2(speed / time * source.v), its.v);
  EXPECT_EQ(pressure / time * source.P.a12, its.P.a12);
}

}  // namespace
}  // namespace fsi::solid
