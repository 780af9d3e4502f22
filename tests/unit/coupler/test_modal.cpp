/// Bodies with a few degrees of freedom in a gas.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "coupler/modal.hpp"

namespace fsi::coupler {
namespace {

/// A piston of area 2 that moves along its normal, in a gas of impedance `z_f` at rest at p_e.
struct Piston {
  double mass = 0;
  double force = 0;
  double z_f = 1;

  ModalLoad load() const {
    const Eigen::MatrixXd N = Eigen::MatrixXd::Ones(1, 3);
    const std::vector<NormalSide> gas(3, NormalSide{.z = z_f, .v_n = 0, .w_n = 0});
    const std::vector<double> ds{0.5, 1.0, 0.5};
    return modal_load(N, gas, ds);
  }
  double exact(double t) const {
    const double drag = 2 * z_f;
    return force / drag * (1 - std::exp(-drag * t / mass));
  }
  /// Largest error up to t = 1 with steps that alternate between `dt` (1 + wobble) and `dt` (1 - wobble).
  double error(int steps, double wobble) const {
    ModalMotion motion(Eigen::VectorXd::Zero(1));
    double t = 0;
    double worst = 0;
    for (int k = 0; k < steps; ++k) {
      const double dt = (1 + (k % 2 == 0 ? wobble : -wobble)) / steps;
      motion.advance(Eigen::MatrixXd::Constant(1, 1, mass), Eigen::VectorXd::Constant(1, force), load(), dt);
      t += dt;
      worst = std::max(worst, std::abs(motion.q_dot()(0) - exact(t)));
    }
    return worst;
  }
};

TEST(ModalMotion, AMassPushedThroughGasFollowsTheExactSolutionToSecondOrder) {
  const Piston piston{.mass = 0.8, .force = 1.5, .z_f = 1.3};
  for (const double wobble : {0.0, 0.3}) {
    const double coarse = piston.error(320, wobble);
    const double fine = piston.error(640, wobble);
    EXPECT_LE(fine, 2e-5);
    EXPECT_GE(std::log2(coarse / fine), 1.9) << "steps alternate by " << wobble;
  }
}

TEST(ModalMotion, AMasslessBodyForgetsAStepLoadAtOnce) {
  const Piston piston{.mass = 0, .force = 0, .z_f = 1.3};
  ModalMotion motion(Eigen::VectorXd::Zero(1));
  const Eigen::MatrixXd M = Eigen::MatrixXd::Zero(1, 1);
  for (int k = 0; k < 5; ++k) motion.advance(M, Eigen::VectorXd::Constant(1, 1.0), piston.load(), 0.1);
  EXPECT_NEAR(motion.q_dot()(0), 1.0 / (2 * 1.3), 1e-15);
  motion.advance(M, Eigen::VectorXd::Zero(1), piston.load(), 0.1);
  EXPECT_EQ(motion.q_dot()(0), 0.0);
}

TEST(ModalMotion, AVeryLightBodyForgetsAStepLoadInAFewSteps) {
  const Piston piston{.mass = 1e-3, .force = 0, .z_f = 1.3};
  ModalMotion motion(Eigen::VectorXd::Zero(1));
  const Eigen::MatrixXd M = Eigen::MatrixXd::Constant(1, 1, piston.mass);
  for (int k = 0; k < 20; ++k) motion.advance(M, Eigen::VectorXd::Constant(1, 1.0), piston.load(), 0.1);
  const double loaded = motion.q_dot()(0);
  for (int k = 0; k < 4; ++k) motion.advance(M, Eigen::VectorXd::Zero(1), piston.load(), 0.1);
  // A / M is 260 per step: each one leaves about sqrt(1/2 / 260) = 4 percent.
  EXPECT_LE(std::abs(motion.q_dot()(0)), 1e-5 * loaded);
}

TEST(ModalLoad, Eq19GasAtRestResistsEveryMotionOfARigidBody) {
  // A square of side 2 about the origin, modes: two translations and the rotation.
  Eigen::MatrixXd N(3, 8);
  std::vector<NormalSide> gas;
  const std::vector<double> ds(8, 1.0);
  for (int side = 0; side < 4; ++side) {
    const double angle = side * std::acos(0.0);
    const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
    for (int half = 0; half < 2; ++half) {
      const Eigen::Vector2d x = n + (half - 0.5) * Eigen::Vector2d(-n.y(), n.x());
      N.col(2 * side + half) << n.x(), n.y(), n.y() * x.x() - n.x() * x.y();
      gas.push_back({.z = 1.3, .v_n = 0, .w_n = -0.4});
    }
  }
  const ModalLoad load = modal_load(N, gas, ds);
  EXPECT_LE(load.f.norm(), 1e-14);  // a uniform pressure around a closed body neither pushes nor turns it
  EXPECT_LE((load.A - load.A.transpose()).norm(), 0.0);
  EXPECT_NEAR(load.A(0, 0), 1.3 * 4, 1e-14);  // two sides of length 2 face the motion
  EXPECT_NEAR(load.A(0, 2), 0.0, 1e-14);      // symmetry: translation and rotation do not mix
  EXPECT_GT(load.A(2, 2), 0.0);
}

}  // namespace
}  // namespace fsi::coupler
