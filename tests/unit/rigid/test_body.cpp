/// A rigid body and the coupler's modal projection, in a gas that is at rest wherever it comes to.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "common/grid/shapes/circle.hpp"
#include "common/grid/shapes/ellipse.hpp"
#include "common/interface/modal.hpp"
#include "common/interface/point_lengths.hpp"
#include "common/wire/sparse.hpp"
#include "coupler/exchange/interface_exchange.hpp"
#include "solid_solver/bodies/load.hpp"
#include "solid_solver/rigid/body.hpp"

namespace fsi::rigid {
namespace {

using coupler::InterfaceExchange;
using std::numbers::pi;

constexpr double z_f = 1.3, p_e = 1;

RigidBody body_within(const std::vector<double>& x, double rho, const Vec3& start = Vec3::Zero()) {
  RigidBody body(Outline{.x = x}, inertia_of(x), rho, {});
  body.start(start);
  return body;
}

RigidBody disk(double rho, const Vec3& start = Vec3::Zero()) {
  return body_within(grid::points_on(grid::circle({0.3, -0.2}, 0.5), 201), rho, start);
}

/// An ellipse with semi-axes 1.25 and 0.5 about (-1, 0).
RigidBody ellipse(double rho, int points, double angle = 0) {
  return body_within(
      grid::points_on(grid::ellipse({.centre = {-1, 0}, .a = 1.25, .b = 0.5, .angle = angle}), points), rho);
}

/// Pressure of the gas at a place and a time.
using Pressure = std::function<double(const Vec2& x, double t)>;

/// One body with its half of the coupler.
class InGas {
 public:
  InGas(RigidBody body, Pressure pressure, const Vec3& own = Vec3::Zero())
      : body_(std::move(body)), pressure_(std::move(pressure)), own_(own), exchange_(pair(), {}, 1) {
    exchange(0);
  }

  void step(double dt) {
    t_ += dt;
    body_.advance(t_, dt);
    ++step_;
    exchange(dt);
  }
  void run(double t_end, int steps) {
    for (int k = 0; k < steps; ++k) step(t_end / steps);
  }

  const RigidBody& body() const { return body_; }
  const bodies::GasLoad& impulse() const { return impulse_.sum(); }

 private:
  RigidBody body_;
  Pressure pressure_;
  Vec3 own_;
  InterfaceExchange exchange_;
  coupler::ModalBody modes_;
  bodies::Impulse impulse_;
  double t_ = 0;
  std::uint64_t step_ = 0;

  coupler::InterfacePair pair() const {
    const Outline& outline = body_.outline();
    return {.fluid = "fluid",
            .solid = "body",
            .name = "body",
            .x = outline.x,
            .n0 = grid::normals(outline.x, outline.ends, outline.orientation)};
  }

  void exchange(double dt) {
    const std::size_t n = body_.points();
    wire::PredictedInterface solid, gas;
    solid.x = gas.x = body_.positions();
    solid.v = body_.velocities(solid.x);
    const Eigen::VectorXd g = body_.history(own_), q_dot = body_.modal_velocity();
    solid.modal = {.modes = 3,
                   .S = wire::lower_entries_of(body_.response().sparseView()),
                   .g = {g.begin(), g.end()},
                   .N = wire::entries_of(body_.mode_vectors().sparseView()),
                   .q_dot = {q_dot.begin(), q_dot.end()}};
    gas.v.assign(2 * n, 0.0);
    gas.z_f.assign(n, z_f);
    gas.p_e = p_e;
    for (std::size_t k = 0; k < n; ++k) gas.p.push_back(pressure_({gas.x[k], gas.x[n + k]}, t_));
    const coupler::Moment moment{.step = step_, .t = t_, .dt = dt};
    exchange_.take(moment, gas, solid);
    const coupler::ModalSide sides[] = {exchange_.modal_side()};
    exchange_.project_interface(moment, dt > 0 ? modes_.project(solid.modal, sides, dt) : q_dot);
    wire::ProjectedInterface answer;
    exchange_.fill_state(answer);
    if (dt > 0) body_.correct(Eigen::Map<const Eigen::VectorXd>(exchange_.q_dot().data(), 3));
    impulse_.add(bodies::load_of_gas(body_.positions(), answer.n, answer.w_n, answer.v_n), dt);
  }
};

double at_rest(const Vec2& /*x*/, double /*t*/) {
  return p_e;
}

/// A as the coupler sums it: z_f N N^T ds.
Eigen::Matrix3d added_mass(const RigidBody& body) {
  const Eigen::MatrixXd N = body.mode_vectors();
  const std::vector<double> x = body.positions();
  const std::size_t n = body.points();
  std::vector<double> ds(n);
  point_lengths(x, grid::normals(x, grid::Curve::closed, 1), ds);
  return Eigen::Matrix3d(
      modal_load(N.sparseView(), std::vector<NormalSide>(n, {.z = z_f, .v_n = 0, .w_n = 0}), ds).A);
}

TEST(RigidBody, AGasResistsADiskInBothDirectionsAndNotItsRotation) {
  const Eigen::Matrix3d A = added_mass(disk(1)) / (z_f * pi * 0.5);
  EXPECT_LE((A - Eigen::Matrix3d(Vec3(1, 1, 0).asDiagonal())).norm(),
            2.4e-4);  // chords of two steps of 200 fall short by (2 pi / 200)^2 / 6, in both directions
}

TEST(RigidBody, TheAddedMassOfAnEllipseIsThatOfAFineQuadrature) {
  const double a = 1.25, b = 0.5;
  Vec3 exact = Vec3::Zero();  // diagonal in the axes of the ellipse
  constexpr int nodes = 4000;
  for (int k = 0; k < nodes; ++k) {
    const double phi = 2 * pi * k / nodes, c = std::cos(phi), s = std::sin(phi), w = std::hypot(a * s, b * c);
    exact +=
        z_f * 2 * pi / nodes / w * Vec3(b * b * c * c, a * a * s * s, std::pow((a * a - b * b) * s * c, 2));
  }
  const auto error = [&](int points) {
    return (added_mass(ellipse(1, points)) - Eigen::Matrix3d(exact.asDiagonal())).norm();
  };
  EXPECT_LE(error(321), 2.2e-3);
  EXPECT_GE(std::log2(error(161) / error(321)), 1.9);
}

TEST(RigidBody, ADiskThatIsPushedSlowsDownExponentiallyToSecondOrder) {
  const Vec3 start(0.4, -0.3, 0);
  const auto errors = [&](int steps) {
    InGas run(disk(0.7, start), at_rest);
    const double m = run.body().masses().mass, drag = added_mass(run.body())(0, 0);
    const Vec2 centre = run.body().pose().centre;
    run.run(1, steps);
    const Vec2 v = start.head<2>() * std::exp(-drag / m), way = (start.head<2>() - v) * m / drag;
    return Vec2((run.body().velocity().head<2>() - v).norm(),
                (run.body().pose().centre - centre - way).norm());
  };
  const Vec2 coarse = errors(160), fine = errors(320);
  EXPECT_LE(fine.maxCoeff(), 1e-4);
  for (int k = 0; k < 2; ++k) EXPECT_GE(std::log2(coarse[k] / fine[k]), 1.9);
}

TEST(RigidBody, ADiskKeepsItsRotationWhichPressureCannotChange) {
  InGas run(disk(0.7, {0.4, -0.3, 2}), at_rest);
  run.run(5, 200);
  EXPECT_NEAR(run.body().velocity()[2], 2, 1e-8);
  EXPECT_NEAR(run.body().pose().angle, 10, 1e-7);
}

TEST(RigidBody, AMomentTurnsADiskThoughTheOutlineDoesNotShowIt) {
  InGas run(disk(0.7), at_rest, {0, 0, 0.1});
  run.run(2, 40);
  const double rate = 0.1 / run.body().masses().moment_of_inertia;
  EXPECT_NEAR(run.body().velocity()[2], 2 * rate, 1e-8);
  EXPECT_NEAR(run.body().pose().angle, 2 * rate, 1e-8);
}

TEST(RigidBody, TheChangeOfItsMomentumIsTheImpulseOfTheForceThatIsWrittenToSecondOrder) {
  const Pressure push = [](const Vec2& x, double t) {
    return p_e + std::sin(2 * t) * (0.2 * x.x() - 0.3 * x.y());
  };
  const auto error = [&](int steps) {
    InGas run(ellipse(0.1, 161, 0.8), push);
    run.run(2, steps);
    EXPECT_GT(run.body().momentum().norm(), 0.01);
    return Vec3(run.impulse().force.x() - run.body().momentum().x(),
                run.impulse().force.y() - run.body().momentum().y(),
                run.impulse().moment - run.body().angular_momentum())
        .norm();
  };
  const double coarse = error(640), fine = error(1280);
  EXPECT_LE(fine, 1e-5);
  EXPECT_GE(std::log2(coarse / fine), 1.9);
}

TEST(RigidBody, AnAlmostMasslessBodyForgetsAStepLoadInAFewSteps) {
  const double dt = 0.05;
  const Pressure push = [=](const Vec2& x, double t) { return t < 10.5 * dt ? p_e - 0.3 * x.x() : p_e; };
  InGas run(ellipse(1e-6, 161, 0.8), push);
  run.run(10 * dt, 10);
  const double loaded = run.body().velocity().norm();
  EXPECT_GT(loaded, 0.05);
  for (int k = 0; k < 4; ++k) run.step(dt);
  EXPECT_LE(run.body().velocity().norm(), 1e-6 * loaded);
}

TEST(RigidBody, PointsThatGoRoundAccelerateTowardsTheCentre) {
  RigidBody body = disk(0.7, {0.4, -0.3, 2});
  const std::vector<double> x = body.positions(), v = body.velocities(x);
  const std::vector<double> a = body.initial_accelerations(x);
  const double dt = 1e-5;
  body.advance(dt, dt);  // without a load
  const std::vector<double> later = body.velocities(body.positions());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(a[i], (later[i] - v[i]) / dt, 1e-4) << i;
}

TEST(RigidBody, ItsOutlineKeepsItsShape) {
  InGas run(ellipse(0.1, 81, 0.8), [](const Vec2& x, double) { return p_e + (x.x() + 1) * (x.x() + 1); });
  const std::vector<double> before = run.body().positions();
  run.run(3, 60);
  const std::vector<double> after = run.body().positions();
  EXPECT_GT(std::abs(run.body().pose().angle), 0.05);
  for (std::size_t k = 1; k < 81; ++k) {
    const auto chord = [k](const std::vector<double>& x) {
      return std::hypot(x[k] - x[0], x[81 + k] - x[81]);
    };
    EXPECT_NEAR(chord(after), chord(before), 1e-13);
  }
}

}  // namespace
}  // namespace fsi::rigid
