/// Bodies with degrees of freedom in a gas.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/core/time/backward_difference.hpp"
#include "common/interface/modal_system.hpp"
#include "common/wire/sparse.hpp"

namespace fsi {
namespace {

Eigen::SparseMatrix<double> sparse(const Eigen::MatrixXd& matrix) {
  return matrix.sparseView();
}

/// A piston of area 2 that moves along its normal, in a gas of impedance `z_f` at rest at p_e.
struct Piston {
  double mass = 0;
  double force = 0;
  double z_f = 1;

  ModalLoad load() const {
    const std::vector<NormalSide> gas(3, NormalSide{.z = z_f, .v_n = 0, .w_n = 0});
    const std::vector<double> ds{0.5, 1.0, 0.5};
    return modal_load(sparse(Eigen::MatrixXd::Ones(1, 3)), gas, ds);
  }
  double exact(double t) const {
    const double drag = 2 * z_f;
    return force / drag * (1 - std::exp(-drag * t / mass));
  }
};

/// Its velocity, from rest.
class Motion {
 public:
  explicit Motion(const Piston& piston) : piston_(piston) {}

  double advance(double force, double dt) {
    const BackwardDifference bdf = backward_difference(dt, dt_before_);
    const Eigen::MatrixXd S = Eigen::MatrixXd::Constant(1, 1, bdf.leading * piston_.mass);
    const Eigen::VectorXd g =
        Eigen::VectorXd::Constant(1, piston_.mass * bdf.history(now_, before_) + dt * force);
    before_ = now_;
    now_ = project_modes(sparse(S), g, piston_.load(), dt)(0);
    dt_before_ = dt;
    return now_;
  }

 private:
  Piston piston_;
  double now_ = 0, before_ = 0, dt_before_ = 0;
};

/// Largest error up to t = 1 with steps that alternate between `dt` (1 + wobble) and `dt` (1 - wobble).
double error(const Piston& piston, int steps, double wobble) {
  Motion motion(piston);
  double t = 0, worst = 0;
  for (int k = 0; k < steps; ++k) {
    const double dt = (1 + (k % 2 == 0 ? wobble : -wobble)) / steps;
    t += dt;
    worst = std::max(worst, std::abs(motion.advance(piston.force, dt) - piston.exact(t)));
  }
  return worst;
}

TEST(ModalProjection, AMassPushedThroughGasFollowsTheExactSolutionToSecondOrder) {
  const Piston piston{.mass = 0.8, .force = 1.5, .z_f = 1.3};
  for (const double wobble : {0.0, 0.3}) {
    const double coarse = error(piston, 320, wobble), fine = error(piston, 640, wobble);
    EXPECT_LE(fine, 2e-5);
    EXPECT_GE(std::log2(coarse / fine), 1.9) << "steps alternate by " << wobble;
  }
}

TEST(ModalProjection, AMasslessBodyForgetsAStepLoadAtOnce) {
  Motion motion({.mass = 0, .force = 0, .z_f = 1.3});
  double loaded = 0;
  for (int k = 0; k < 5; ++k) loaded = motion.advance(1, 0.1);
  EXPECT_NEAR(loaded, 1.0 / (2 * 1.3), 1e-15);
  EXPECT_EQ(motion.advance(0, 0.1), 0.0);
}

TEST(ModalProjection, AVeryLightBodyForgetsAStepLoadInAFewSteps) {
  Motion motion({.mass = 1e-3, .force = 0, .z_f = 1.3});
  double loaded = 0, left = 0;
  for (int k = 0; k < 20; ++k) loaded = motion.advance(1, 0.1);
  for (int k = 0; k < 4; ++k) left = motion.advance(0, 0.1);
  // A / M is 260 per step: each one leaves about sqrt(1/2 / 260) = 4 percent.
  EXPECT_LE(std::abs(left), 1e-5 * loaded);
}

TEST(ModalProjection, ManyModesAreSolvedAsFewAre) {
  // A string of 40 masses with springs to the neighbours, each before a point of the gas.
  constexpr int k = 40;
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(k, k), N = Eigen::MatrixXd::Identity(k, k);
  for (int m = 0; m < k; ++m) {
    S(m, m) = 2.5;
    if (m > 0) S(m, m - 1) = S(m - 1, m) = -1;
    if (m > 0) N(m, m - 1) = 0.5;
  }
  std::vector<NormalSide> gas;
  for (int i = 0; i < k; ++i) gas.push_back({.z = 1 + 0.1 * i, .v_n = std::sin(i), .w_n = std::cos(i)});
  const ModalLoad load = modal_load(sparse(N), gas, std::vector<double>(k, 0.2));
  const Eigen::VectorXd g = Eigen::VectorXd::LinSpaced(k, -1, 1);
  const Eigen::VectorXd q_dot = project_modes(sparse(S.triangularView<Eigen::Lower>()), g, load, 0.3);
  EXPECT_LE((S * q_dot - g - 0.3 * (load.f - load.A * q_dot)).norm(), 1e-13);
}

/// Mode vectors of a chain: each point moves with two neighbouring modes, or with modes `apart` from each
/// other.
Eigen::SparseMatrix<double> chain(int modes, int points, int apart) {
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(modes, points);
  for (int i = 0; i < points; ++i) {
    N(i % modes, i) = 1 + 0.1 * i;
    N((i + apart) % modes, i) = 0.7 - 0.05 * i;
  }
  return sparse(N);
}

TEST(AddedMass, IsTheLoadOfTheGasWhereverItsEntriesAre) {
  constexpr int modes = 20, points = 33;
  std::vector<NormalSide> gas;
  std::vector<double> ds;
  for (int i = 0; i < points; ++i) {
    gas.push_back({.z = 1 + 0.1 * i, .v_n = std::sin(i), .w_n = std::cos(i)});
    ds.push_back(0.3 + 0.01 * i);
  }
  AddedMass added;
  for (const int apart : {1, 1, 7, 1}) {
    const Eigen::SparseMatrix<double> N = (apart + 0.5) * chain(modes, points, apart);
    added.take(N);
    const ModalLoad& load = added.load(gas, ds);
    const ModalLoad expected = modal_load(N, gas, ds);
    const Eigen::MatrixXd A = Eigen::MatrixXd(load.A).selfadjointView<Eigen::Lower>();
    EXPECT_LE((A - Eigen::MatrixXd(expected.A)).norm(), 1e-12 * A.norm()) << apart;
    EXPECT_LE((load.f - expected.f).norm(), 1e-12 * load.f.norm()) << apart;
  }
}

TEST(ModalSolver, SolvesForEachMatrixWhateverItSolvedBefore) {
  constexpr int modes = 40;
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(modes, -1, 2);
  ModalSolver solver;
  for (const int apart : {1, 1, 9, 1}) {
    const Eigen::SparseMatrix<double> N = chain(modes, 60, apart);
    const Eigen::SparseMatrix<double> S = 0.1 * apart * Eigen::SparseMatrix<double>(N * N.transpose());
    const Eigen::VectorXd x = solver.solve(S, right);
    ASSERT_EQ(x.size(), modes);
    EXPECT_LE((S * x - right).norm(), 1e-9 * right.norm()) << apart;
  }
  Eigen::SparseMatrix<double> singular(modes, modes);
  singular.setIdentity();
  singular.coeffRef(3, 3) = 0;
  EXPECT_EQ(solver.solve(singular, right).size(), 0);
  EXPECT_EQ(solver.solve(chain(modes, modes, 9) * chain(modes, modes, 9).transpose(), right).size(), modes);
}

/// The places of S and of A are each their own: entries of one, of the other, of both.
TEST(ModalSolver, ProjectsForEachSumWhateverPlacesItsPartsHave) {
  constexpr int modes = 40;
  constexpr double dt = 0.3;
  const Eigen::VectorXd g = Eigen::VectorXd::LinSpaced(modes, -1, 2);
  ModalSolver solver;
  for (const auto& [of_S, of_A] : {std::pair{1, 9}, {1, 9}, {9, 1}, {1, 1}, {3, 11}}) {
    const Eigen::SparseMatrix<double> N = chain(modes, 60, of_S), gas = chain(modes, 50, of_A);
    const Eigen::SparseMatrix<double> S = 0.1 * of_S * Eigen::SparseMatrix<double>(N * N.transpose());
    const ModalLoad load{.A = gas * gas.transpose(), .f = Eigen::VectorXd::LinSpaced(modes, 3, 1)};
    const Eigen::VectorXd lower = solver.project(S.triangularView<Eigen::Lower>(), g,
                                                 {load.A.triangularView<Eigen::Lower>(), load.f}, dt),
                          whole = solver.project(S, g, load, dt);
    ASSERT_EQ(lower.size(), modes);
    const double size = (g + dt * load.f).norm();
    EXPECT_LE((S * lower - g - dt * (load.f - load.A * lower)).norm(), 1e-9 * size) << of_S << ", " << of_A;
    EXPECT_LE((whole - lower).norm(), 1e-9 * lower.norm()) << of_S << ", " << of_A;
  }
}

TEST(SparseMessage, IsTheSameMatrixInAnyOrderOfItsEntries) {
  const Eigen::SparseMatrix<double> N = chain(6, 9, 2);
  const wire::SparseMatrix ordered = wire::entries_of(N);
  wire::SparseMatrix reversed = ordered, doubled = ordered;
  for (auto* numbers : {&reversed.row, &reversed.column}) std::ranges::reverse(*numbers);
  std::ranges::reverse(reversed.value);
  doubled.row.push_back(ordered.row.front());  // entries of one place add up
  doubled.column.push_back(ordered.column.front());
  doubled.value.push_back(2);
  EXPECT_EQ((wire::matrix_of(ordered, 6, 9) - N).norm(), 0);
  EXPECT_EQ((wire::matrix_of(reversed, 6, 9) - N).norm(), 0);
  EXPECT_EQ((wire::matrix_of(doubled, 6, 9) - N).norm(), 2);
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
  const ModalLoad load = modal_load(sparse(N), gas, ds);
  const Eigen::MatrixXd A(load.A);
  EXPECT_LE(load.f.norm(), 1e-14);  // a uniform pressure around a closed body neither pushes nor turns it
  EXPECT_LE((A - A.transpose()).norm(), 1e-15);
  EXPECT_NEAR(A(0, 0), 1.3 * 4, 1e-14);  // two sides of length 2 face the motion
  EXPECT_NEAR(A(0, 2), 0.0, 1e-14);      // symmetry: translation and rotation do not mix
  EXPECT_GT(A(2, 2), 0.0);
}

/// A mass and a moment of inertia that are compared with each other would choose another order of elimination in
/// other units.
TEST(ModalProjection, FewModesHaveTheSameSolutionToTheBitInOtherUnits) {
  Eigen::MatrixXd S(3, 3);
  S << 1.3, 0, 0.2, 0, 1.7, -0.4, 0.2, -0.4, 0.9;
  const Eigen::Vector3d right(0.3, -0.7, 1.1);
  const Eigen::VectorXd x = solve_few_modes(S, right);
  EXPECT_LT((S * x - right).norm(), 1e-15);
  for (const double length : {0x1p-20, 0x1p-1, 0x1p9}) {
    const Eigen::DiagonalMatrix<double, 3> lever(1, 1, length);  // of a rotation
    const Eigen::VectorXd in_units = solve_few_modes(lever * S * lever, lever * right);
    EXPECT_EQ(in_units[0], x[0]);
    EXPECT_EQ(in_units[1], x[1]);
    EXPECT_EQ(length * in_units[2], x[2]);
  }
}

TEST(ModalProjection, ADirectionThatNothingResistsGetsNoVelocity) {
  const Eigen::Vector3d along(0.6, 0.8, 0.1), across(0.8, -0.6, 0);
  const Eigen::MatrixXd S = 2.3 * along * along.transpose() + 0.7 * across * across.transpose();
  const Eigen::Vector3d load = S * Eigen::Vector3d(0.4, -0.2, 0.5);
  const Eigen::VectorXd x = solve_few_modes(S, load);
  EXPECT_EQ(x[2], 0);
  EXPECT_LT((S * x - load).norm(), 1e-14);
}

}  // namespace
}  // namespace fsi
