/// Rigid bodies that are held: at a point, by springs and dampers. Without a gas.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/grid/shapes/ellipse.hpp"
#include "common/interface/modal.hpp"
#include "solid_solver/rigid/body.hpp"

namespace fsi::rigid {
namespace {

/// What is free, in columns.
Eigen::MatrixXd freedoms(std::initializer_list<int> of) {
  Eigen::MatrixXd columns(3, static_cast<Eigen::Index>(of.size()));
  Eigen::Index column = 0;
  for (const int k : of) columns.col(column++) = Vec3::Unit(k);
  return columns;
}

/// An ellipse with semi-axes 0.8 and 0.3 about (1, 2), turned; density 0.7.
RigidBody held(Mounting mounting, const Vec3& start = Vec3::Zero()) {
  const std::vector<double> x =
      grid::points_on(grid::ellipse({.centre = {1, 2}, .a = 0.8, .b = 0.3, .angle = 0.4}), 121);
  RigidBody body(Outline{.x = x}, inertia_of(x), 0.7, std::move(mounting));
  body.start(start);
  return body;
}

/// After steps of 0.7 and 1.3 of their mean by turns.
RigidBody after(RigidBody body, double t, int steps, const Vec3& load = Vec3::Zero()) {
  double now = 0;
  for (int k = 0; k < steps; ++k) {
    const double dt = (k % 2 == 0 ? 0.7 : 1.3) * t / steps;
    body.advance(now += dt, dt);
    body.correct(solve_few_modes(body.response(), body.history(load)));
  }
  return body;
}

/// log2 of the ratio of the errors of 400 and of 800 steps. @param most the latter may be
double order(const std::function<double(int)>& error, double most) {
  const double coarse = error(400), fine = error(800);
  EXPECT_LE(fine, most);
  return std::log2(coarse / fine);
}

/// Angle and rate at t of angle'' = f(angle), by the classical Runge-Kutta method.
Vec2 swung(double t, double rate, const std::function<double(double)>& f) {
  constexpr int steps = 20000;
  const double h = t / steps;
  const auto slope = [&](const Vec2& y) { return Vec2(y[1], f(y[0])); };
  Vec2 y(0, rate);
  for (int k = 0; k < steps; ++k) {
    const Vec2 a = slope(y), b = slope(y + h / 2 * a), c = slope(y + h / 2 * b), d = slope(y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return y;
}

TEST(HeldBody, APendulumSwingsAboutItsPivotToSecondOrder) {
  const Vec2 pivot(1, 3.5);
  const Mounting mounting{.pivot = pivot, .freedoms = freedoms({2})};
  const RigidBody at_rest = held(mounting);
  const Vec2 arm = at_rest.reference_centre() - pivot;
  const double m = at_rest.masses().mass, weight = 2 * m, rate = 1.5;
  const double inertia = at_rest.masses().moment_of_inertia + m * arm.squaredNorm();
  const Vec3 start(-rate * arm.y(), rate * arm.x(), rate);
  const Vec2 exact = swung(5, rate, [&](double angle) {
    return -weight * (std::cos(angle) * arm.x() - std::sin(angle) * arm.y()) / inertia;
  });
  EXPECT_GT(rate * rate * inertia, weight * arm.norm());  // no small angles
  const auto error = [&](int steps) {
    const RigidBody body = after(held(mounting, start), 5, steps, {0, -weight, 0});
    EXPECT_NEAR((body.pose().centre - pivot).norm(), arm.norm(), 1e-13);
    EXPECT_LE((body.position(pivot) - pivot).norm(), 1e-13);
    EXPECT_LE(body.velocity_at(pivot).norm(), 1e-13);
    return (Vec2(body.pose().angle, body.velocity()[2]) - exact).norm();
  };
  EXPECT_GE(order(error, 1e-3), 1.9);
}

TEST(HeldBody, OneThatMayNotMoveAlongXKeepsItsEnergyAndItsMomentumAlongYToSecondOrder) {
  const Vec2 pivot(0.4, 2.3);
  const Mounting mounting{.pivot = pivot, .freedoms = freedoms({1, 2})};
  const RigidBody start = held(mounting, {0.1, 0.4, 2});
  const auto error = [&](int steps) {
    const RigidBody body = after(start, 4, steps);
    EXPECT_GT(body.pose().angle, 4);
    EXPECT_NEAR(body.position(pivot).x(), pivot.x(), 1e-13);
    EXPECT_NEAR(body.velocity_at(body.position(pivot)).x(), 0, 1e-13);
    EXPECT_GT(std::abs(body.momentum().x() - start.momentum().x()), 0.02);  // which the guide takes
    return std::abs(body.momentum().y() - start.momentum().y()) +
           std::abs(body.kinetic_energy() - start.kinetic_energy());
  };
  EXPECT_GE(order(error, 2e-4), 1.9);
}

TEST(HeldBody, WhereAFreeBodyIsHeldDoesNotMatter) {
  const Vec3 start(0.3, -0.2, 1.7);
  const auto error = [&](int steps) {
    const RigidBody body = after(held({.pivot = Vec2(0.2, 1.1)}, start), 3, steps);
    EXPECT_NEAR(body.pose().angle, 3 * 1.7, 1e-3);
    return (body.pose().centre - Vec2(1 + 3 * 0.3, 2 - 3 * 0.2)).norm();
  };
  EXPECT_GE(order(error, 1e-3), 1.9);
}

TEST(HeldBody, SpringsAndDampersMakeDampedOscillationsToSecondOrder) {
  const Vec3 start(0.5, -0.4, 0.8), spring(2, 5, 0.4), damper(0.1, 0, 0.02);
  const auto error = [&](int steps) {
    const RigidBody body = after(held({.spring = spring, .damper = damper}, start), 6, steps);
    const Vec3 masses = body.masses().diagonal();
    const Vec2 way = body.pose().centre - body.reference_centre();
    const Vec3 q(way.x(), way.y(), body.pose().angle);
    Vec3 exact;
    for (int k = 0; k < 3; ++k) {
      const double decay = damper[k] / (2 * masses[k]),
                   omega = std::sqrt(spring[k] / masses[k] - decay * decay);
      exact[k] = start[k] / omega * std::exp(-6 * decay) * std::sin(6 * omega);
    }
    return (q - exact).norm();
  };
  EXPECT_GE(order(error, 5e-3), 1.9);
}

TEST(HeldBody, ASpringHasWhatTheMotionLosesToSecondOrder) {
  const RigidBody start = held({.spring = {2, 0, 0}}, {0.5, 0, 0});
  const auto error = [&](int steps) {
    const RigidBody body = after(start, 0.8, steps);
    EXPECT_GT(body.spring_energy(), 0.3 * start.kinetic_energy());
    return std::abs(body.kinetic_energy() + body.spring_energy() - start.kinetic_energy());
  };
  EXPECT_GE(order(error, 1e-5), 1.9);
}

TEST(HeldBody, ASpringFarTooStiffForTheStepHoldsIt) {
  RigidBody body = held({.spring = {1e12, 1e12, 1e12}}, {0.5, -0.4, 0.8});
  body = after(body, 1, 10);
  EXPECT_LE(body.velocity().norm(), 1e-6);
  EXPECT_LE((body.pose().centre - body.reference_centre()).norm(), 1e-6);
}

TEST(HeldBody, StartsWithTheAccelerationThatItsMountingAsksFor) {
  const std::vector<Mounting> mountings{
      {.pivot = Vec2(0.4, 2.3), .freedoms = freedoms({2})},
      {.pivot = Vec2(0.4, 2.3), .freedoms = freedoms({1, 2}), .damper = {0, 0.3, 0.1}},
      {.pivot = Vec2(0.4, 2.3)},
      {.freedoms = freedoms({0}), .damper = {0.7, 0, 0}}};
  for (const Mounting& mounting : mountings) {
    RigidBody body = held(mounting, {0.3, -0.2, 1.7});
    const std::vector<double> x = body.positions(), v = body.velocities(x), a = body.initial_accelerations(x);
    EXPECT_TRUE(body.starts_unevenly());
    constexpr double dt = 1e-5;
    body = after(body, dt, 1);
    const std::vector<double> later = body.velocities(body.positions());
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(a[i], (later[i] - v[i]) / (0.7 * dt), 2e-4) << i;
  }
  EXPECT_FALSE(held({}, {0.3, -0.2, 0}).starts_unevenly());
}

TEST(HeldBody, AnImpulseGivesItWhatItsMountingLeaves) {
  const Vec2 pivot(0.4, 2.3);
  const RigidBody body = held({.pivot = pivot, .freedoms = freedoms({2})}, {0.3, -0.2, 0});
  const Vec2 arm = body.reference_centre() - pivot;
  const double m = body.masses().mass, inertia = body.masses().moment_of_inertia + m * arm.squaredNorm();
  EXPECT_NEAR(body.velocity()[2], m * (arm.x() * -0.2 - arm.y() * 0.3) / inertia, 1e-13);
}

/// Along x and y and its rotation, as far as there is a formula.
GivenMotion given(const std::array<const char*, 3>& formulas, double t_end) {
  GivenMotion::Formulas of;
  for (std::size_t k = 0; k < 3; ++k)
    if (!std::string(formulas[k]).empty()) of[k] = Expression(formulas[k], {});
  return {of, t_end};
}

TEST(GivenMotion, HasItsRateAndItsAccelerationFromTheStartOn) {
  const GivenMotion motion = given({"3 * sin(2 * t)", "", "t^2 - 0.3 * t"}, 5);
  for (const double t : {0.0, 1e-5, 0.7, 5.0}) {
    const Vec3 rate(6 * std::cos(2 * t), 0, 2 * t - 0.3), acceleration(-12 * std::sin(2 * t), 0, 2);
    EXPECT_LE((motion.rate(t) - rate).norm(), 1e-9) << t;
    EXPECT_LE((motion.acceleration(t) - acceleration).norm(), 1e-5) << t;
  }
  EXPECT_FALSE(GivenMotion());
  EXPECT_FALSE(given({"", "", ""}, 1));
}

TEST(HeldBody, GoesAsGivenWhateverLoadsIt) {
  const Vec2 pivot(0.4, 2.3);
  const Mounting mounting{
      .pivot = pivot, .freedoms = freedoms({}), .given = given({"0.2 * t^2", "", "sin(3 * t)"}, 2)};
  const RigidBody body = after(held(mounting), 2, 20, {1e9, -1e12, 1e9});
  EXPECT_EQ(body.modes(), 1);
  EXPECT_EQ(body.modal_velocity()[0], 1);
  EXPECT_NEAR(body.pose().angle, std::sin(6.0), 1e-13);
  EXPECT_LE((body.position(pivot) - pivot - Vec2(0.8, 0)).norm(), 1e-13);
  EXPECT_LE((body.velocity_at(body.position(pivot)) - Vec2(0.8, 0)).norm(), 1e-9);
  EXPECT_NEAR(body.velocity()[2], 3 * std::cos(6.0), 1e-9);
}

TEST(HeldBody, APendulumWhosePivotIsPulledAwaySwingsAsIfItsWeightLeanedBackToSecondOrder) {
  const Vec2 pivot(1, 3.5);
  const Mounting mounting{
      .pivot = pivot, .freedoms = freedoms({2}), .given = given({"0.6 * t^2", "0.1 * t", ""}, 3)};
  const RigidBody at_rest = held(mounting);
  const Vec2 arm = at_rest.reference_centre() - pivot;
  const double m = at_rest.masses().mass;
  const Vec2 pull(-1.2 * m, -2 * m);  // of what the pivot's acceleration is, and of the weight
  const double inertia = at_rest.masses().moment_of_inertia + m * arm.squaredNorm();
  const Vec2 exact = swung(3, 0, [&](double angle) {
    const Vec2 now(std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                   std::sin(angle) * arm.x() + std::cos(angle) * arm.y());
    return (now.x() * pull.y() - now.y() * pull.x()) / inertia;
  });
  EXPECT_GT(std::abs(exact[0]), 0.5);
  const auto error = [&](int steps) {
    const RigidBody body = after(held(mounting), 3, steps, {0, pull.y(), 0});
    EXPECT_LE((body.position(pivot) - pivot - Vec2(5.4, 0.3)).norm(), 1e-11);
    return (Vec2(body.pose().angle, body.velocity()[2]) - exact).norm();
  };
  EXPECT_GE(order(error, 1e-3), 1.9);
}

TEST(HeldBody, StartsWithTheAccelerationOfItsGivenMotion) {
  const std::vector<Mounting> mountings{
      {.pivot = Vec2(0.4, 2.3),
       .freedoms = freedoms({}),
       .given = given({"0.6 * t^2", "0.2 * t", "t^2 + t"}, 1)},
      {.pivot = Vec2(0.4, 2.3), .freedoms = freedoms({0}), .given = given({"", "", "2 * t^2 - t"}, 1)},
      {.freedoms = freedoms({2}), .damper = {0, 0, 0.1}, .given = given({"sin(t)", "t^2", ""}, 1)}};
  for (const Mounting& mounting : mountings) {
    RigidBody body = held(mounting);
    const std::vector<double> x = body.positions(), v = body.velocities(x), a = body.initial_accelerations(x);
    EXPECT_TRUE(body.starts_unevenly());
    constexpr double dt = 1e-5;
    body = after(body, dt, 1);
    const std::vector<double> later = body.velocities(body.positions());
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(a[i], (later[i] - v[i]) / (0.7 * dt), 5e-4) << i;
  }
}

}  // namespace
}  // namespace fsi::rigid
