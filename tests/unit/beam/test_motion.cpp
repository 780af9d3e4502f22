/// A beam that moves, in steps.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "beams.hpp"
#include "common/core/failure.hpp"

namespace fsi::beam {
namespace {

using namespace testing;

Eigen::VectorXd nothing(const BeamModel& model) {
  return Eigen::VectorXd::Zero(model.freedoms());
}

/// A free beam that turns about its middle, half a turn in a unit of time, for one turn; momentum, angular
/// momentum and energy lost, in parts of what was there.
std::array<double, 3> lost_in_a_turn(int steps) {
  const Section stiff{.EA = 1e6, .GA = 1e6, .EI = 2, .mass = 0.7, .inertia = 0.01};
  BeamMotion motion(straight(stiff, 10), loose);
  const BeamModel& model = motion.model();
  constexpr double omega = pi, drift = 0.3;
  Eigen::VectorXd v(model.freedoms());
  for (int node = 0; node < model.nodes(); ++node) {
    const Vec2 x = model.line().x[static_cast<std::size_t>(node)];
    v.segment<3>(freedom_of(node)) << -omega * x.y(), omega * (x.x() - 0.5) + drift, omega;
  }
  motion.start(v);
  const Vec2 momentum = motion.momentum();
  const double turning = motion.angular_momentum(), energy = motion.kinetic_energy();
  EXPECT_NEAR(momentum.y(), 0.7 * drift, 1e-14);
  for (int k = 0; k < steps; ++k) motion.advance(2.0 / steps, nothing(model), nullptr);
  const double now = motion.kinetic_energy() + model.strain_energy(motion.u());
  return {(motion.momentum() - momentum).norm() / momentum.norm(),
          std::abs(motion.angular_momentum() / turning - 1), std::abs(now / energy - 1)};
}

TEST(BeamMotion, AFreeBeamThatTurnsKeepsItsMomentumAndToSecondOrderTheRest) {
  const auto coarse = lost_in_a_turn(200), fine = lost_in_a_turn(400);
  note("free beam, one turn in 400 steps: momentum lost", fine[0]);
  EXPECT_LE(fine[0], 1e-9);  // round-off of axial forces of 1e6
  for (const int what : {1, 2}) {
    const auto k = static_cast<std::size_t>(what);
    note(fmt::format("free beam, one turn in 400 steps: {} lost", what == 1 ? "angular momentum" : "energy"),
         fine[k], coarse[k]);
    EXPECT_LE(fine[k], 2e-3);
    EXPECT_GE(std::log2(coarse[k] / fine[k]), 1.9) << (what == 1 ? "angular momentum" : "energy");
  }
}

/// Deflection at the tip of a thin cantilever that is let go in its first mode, after one period.
double error_after_a_period(int steps) {
  constexpr int elements = 30;
  const BeamModel model = straight(slender(0.7), elements);
  const double beta = 1.8751041, omega = beta * beta / std::sqrt(0.7);
  const double ratio = (std::cosh(beta) + std::cos(beta)) / (std::sinh(beta) + std::sin(beta));
  constexpr double size = 1e-5;
  Eigen::VectorXd v = nothing(model);
  for (int node = 0; node <= elements; ++node) {
    const double s = beta * node / elements;
    v[3 * node + 1] = size * (std::cosh(s) - std::cos(s) - ratio * (std::sinh(s) - std::sin(s)));
    v[3 * node + 2] = size * beta * (std::sinh(s) + std::sin(s) - ratio * (std::cosh(s) - std::cos(s)));
  }
  BeamMotion motion(model, cantilever);
  motion.start(v);
  const double dt = 2 * pi / omega / steps;
  for (int k = 0; k < steps; ++k) motion.advance(dt, nothing(model), nullptr);
  return std::abs(motion.u_dot()[model.freedoms() - 2] / v[model.freedoms() - 2] - 1);
}

TEST(BeamMotion, ACantileverVibratesInItsFirstModeToSecondOrder) {
  const double coarse = error_after_a_period(200), fine = error_after_a_period(400);
  note("thin cantilever, one period of its first mode in 400 steps: velocity of the tip", fine, coarse);
  EXPECT_LE(fine, 2e-3);
  EXPECT_GE(std::log2(coarse / fine), 1.9);
}

TEST(BeamMotion, WithoutMassItIsInEquilibriumAtOnceAndDoesNotRing) {
  const BeamModel model = straight(slender(), 10);
  const Eigen::VectorXd load = on_tip(model, 1, 1e-3);
  BeamMotion motion(model, cantilever);
  for (int k = 0; k < 6; ++k) {
    motion.advance(0.1, load, nullptr);
    EXPECT_NEAR(motion.u()[model.freedoms() - 2] / (1e-3 / 3), 1, 1e-5);
  }
  for (int k = 0; k < 3; ++k) motion.advance(0.1, nothing(model), nullptr);
  EXPECT_LE(motion.u().norm(), 1e-12);
}

TEST(BeamMotion, WhatIsFreeToMoveWithoutMassIsRefused) {
  BeamMotion motion(straight(slender(), 10), loose);
  EXPECT_THROW(motion.advance(0.1, nothing(motion.model()), nullptr), Diverged);
}

TEST(BeamMotion, ItsPredictionWithoutAGasIsWhatItsResponseSays) {
  BeamMotion motion(straight({.EA = 3, .GA = 1, .EI = 0.1, .mass = 0.5, .inertia = 0.01}, 8), cantilever);
  const BeamModel& model = motion.model();
  for (int k = 0; k < 5; ++k) {
    motion.advance(0.1 + 0.03 * (k % 2), on_tip(model, 1, -0.2), nullptr);
    const Response response = motion.response();
    EXPECT_LE((response.S * motion.q_dot() - response.g).norm(), 1e-10);
  }
}

TEST(BeamMotion, APlateWithGuidedEndsMovesInAGasAsAPiston) {
  // Mass m per length, pushed by the pressure P: m v' = P - z v.
  constexpr int elements = 8;
  for (const double m : {1e-6, 1e-3, 1.0, 1e3}) {
    const auto error = [&](int steps) {
      Section section = plate_section(1, 4, 2, 0.02);
      section.mass = m;
      BeamMotion motion(straight(section, elements), guided);
      Eigen::MatrixXd N = Eigen::MatrixXd::Zero(motion.modes(), elements + 1);
      for (int node = 0; node <= elements; ++node) {
        for (Eigen::Index k = 0; k < motion.modes(); ++k)
          N(k, node) = Eigen::MatrixXd(motion.free_motions())(3 * node + 1, k);
      }
      std::vector<double> ds(elements + 1, 1.0 / elements);
      ds.front() = ds.back() = 0.5 / elements;
      constexpr double z = 1.3, P = 1e-3;
      const ModalLoad gas =
          modal_load(N.sparseView(), std::vector<NormalSide>(elements + 1, {.z = z, .v_n = 0, .w_n = P}), ds);
      double worst = 0;
      for (int k = 1; k <= steps; ++k) {
        const double dt = 1.0 / steps;
        motion.advance(dt, nothing(motion.model()), &gas);
        const Response response = motion.response();
        motion.correct(project_modes(response.S, response.g, gas, dt));
        const double exact = P / z * (1 - std::exp(-z * k * dt / m));
        for (int node = 0; node <= elements; ++node)
          worst = std::max(worst, std::abs(motion.u_dot()[3 * node + 1] / (P / z) - exact / (P / z)));
      }
      return worst;
    };
    const double coarse = error(100), fine = error(200);
    if (m == 1e-6) {
      EXPECT_LE(fine, 1e-3);  // of a velocity that is there after the first step
    } else if (m > 0.1) {
      EXPECT_LE(fine, 5e-5);
      EXPECT_GE(std::log2(coarse / fine), 1.9) << "mass " << m;
    }
    EXPECT_LE(fine, 0.5);
  }
}

}  // namespace
}  // namespace fsi::beam
