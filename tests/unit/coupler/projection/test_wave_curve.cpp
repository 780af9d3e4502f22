/// The gas-solid Riemann problem with jumps of any size, against the exact Riemann problem of two gases.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "common/exact/riemann.hpp"
#include "common/interface/modal.hpp"
#include "common/interface/wave_curve.hpp"

namespace fsi::coupler {
namespace {

constexpr double gamma_gas = 1.4, p_e = 0.6;

double sound(const exact::TubeState& gas) {
  return std::sqrt(gamma_gas * gas.p / gas.rho);
}

/// The gas on the right of an interface whose normal is the x axis.
GasSide side_of(const exact::TubeState& gas) {
  const double z = gas.rho * sound(gas);
  return {.state = {.z = z, .v_n = gas.v, .w_n = p_e - gas.p},
          .curve = {.z = z, .rho = gas.rho, .gamma = gamma_gas}};
}

/// Pairs of gases between which shocks up to Mach 4, rarefactions, both or nothing run.
struct Pair {
  exact::TubeState left, right;
};
const std::vector<Pair> pairs{
    {.left = {.rho = 1, .v = 0, .p = 1}, .right = {.rho = 0.125, .v = 0, .p = 0.1}},
    {.left = {.rho = 1, .v = 3, .p = 0.7}, .right = {.rho = 1, .v = -1.5, .p = 0.7}},
    {.left = {.rho = 2, .v = -1, .p = 0.4}, .right = {.rho = 1, .v = 2, .p = 0.8}},
    {.left = {.rho = 5, .v = 0, .p = 20}, .right = {.rho = 1, .v = 0, .p = 0.5}},
    {.left = {.rho = 1, .v = -0.1, .p = 0.3}, .right = {.rho = 3, .v = 1.4, .p = 6}}};

/// A solid of impedance z that at velocity v_0 bears what leads it to the state between two gases.
NormalSide solid_that_meets(const exact::Riemann& waves, double z, double v_0) {
  return {.z = z, .v_n = v_0, .w_n = p_e - waves.p_star() - z * (waves.v_star() - v_0)};
}

TEST(WaveCurve, LeadsToTheStateOfTheExactRiemannProblemForLightAndHeavySolids) {
  for (const Pair& pair : pairs) {
    const exact::Riemann waves(pair.left, pair.right, gamma_gas);
    for (const double z : {1e-6, 1e-2, 1.0, 1e2, 1e6}) {
      for (const double v_0 : {-2.0, 0.0, 1.0, 4.0}) {
        const NormalState state = between(solid_that_meets(waves, z, v_0), side_of(pair.right));
        EXPECT_NEAR(state.v_n, waves.v_star(), 1e-11) << "z = " << z << ", v_0 = " << v_0;
        // The solid's w_n is the difference of two numbers of size z: round-off of 1e6 at most.
        EXPECT_NEAR(state.w_n, p_e - waves.p_star(), 1e-11 * waves.p_star() * (1 + 0.1 * std::fabs(v_0)))
            << "z = " << z << ", v_0 = " << v_0;
      }
    }
  }
}

TEST(WaveCurve, AWallOfGivenVelocityFeelsThePressureOfTheExactRiemannProblem) {
  for (const Pair& pair : pairs) {
    const exact::Riemann waves(pair.left, pair.right, gamma_gas);
    EXPECT_NEAR(at_wall(waves.v_star(), side_of(pair.right)).w_n, p_e - waves.p_star(),
                1e-12 * waves.p_star());
  }
}

TEST(WaveCurve, DiffersFromEq28ByTheSquareOfTheJump) {
  const exact::TubeState gas{.rho = 1.2, .v = 0.3, .p = 0.9};
  const GasSide side = side_of(gas);
  for (const double sign : {-1.0, 1.0}) {
    for (const double jump : {1e-2, 1e-3, 1e-4}) {
      const NormalSide solid{.z = 0.7, .v_n = gas.v + sign * jump, .w_n = p_e - gas.p + 0.4 * sign * jump};
      const NormalState linear = between(solid, side.state);
      const double difference = between(solid, side).v_n - linear.v_n, u = linear.v_n - gas.v;
      // Half the second derivative of the pressure along an isentrope: (gamma + 1)/4 rho.
      const double expected = -0.25 * (gamma_gas + 1) * gas.rho * u * u / (solid.z + side.state.z);
      EXPECT_NEAR(difference / expected, 1, 2 * jump) << "jump " << sign * jump;
    }
  }
}

TEST(WaveCurve, EqualSidesStayEqualToTheLastBit) {
  const GasSide side = side_of({.rho = 1.1, .v = 0.37, .p = 0.83});
  const NormalSide solid{.z = 0.9, .v_n = side.state.v_n, .w_n = side.state.w_n};
  const NormalState state = between(solid, side);
  EXPECT_EQ(state.v_n, solid.v_n);
  EXPECT_EQ(state.w_n, solid.w_n);
}

TEST(WaveCurve, IsSmoothFromRarefactionToShockAndItsSlopeIsItsDerivative) {
  const WaveCurve curve = side_of({.rho = 1.3, .v = 0, .p = 0.8}).curve;
  EXPECT_EQ(curve.at(0).dp, 0.0);
  EXPECT_EQ(curve.at(0).slope, curve.z);
  for (const double u : {-3.0, -0.5, -1e-3, 1e-3, 0.5, 3.0}) {
    constexpr double d = 1e-6;
    EXPECT_NEAR((curve.at(u + d).dp - curve.at(u - d).dp) / (2 * d), curve.at(u).slope, 1e-8 * (1 + curve.z));
  }
  // Curvatures on both sides of u = 0.
  constexpr double d = 1e-4;
  EXPECT_NEAR((curve.at(d).slope - curve.z) / d, (curve.z - curve.at(-d).slope) / d, 1e-3);
}

TEST(WaveCurve, AWallFasterThanTheGasCanFollowLeavesAVacuumBesideIt) {
  const exact::TubeState gas{.rho = 1, .v = 0, .p = 0.5};
  const GasSide side = side_of(gas);
  const double escape = 2 * sound(gas) / (gamma_gas - 1);
  EXPECT_FALSE(side.curve.at(-0.89 * escape).vacuum);
  EXPECT_TRUE(side.curve.at(-0.91 * escape).vacuum);
  for (const double times : {0.95, 1.0, 3.0}) {
    const double p = p_e - at_wall(-times * escape, side).w_n;
    EXPECT_GT(p, 0.0);
    EXPECT_LT(p, 1e-6 * gas.p);
  }
  // A solid that is pulled away so fast is stopped by its own impedance alone.
  const NormalSide solid{.z = 2, .v_n = -5 * escape, .w_n = p_e};
  EXPECT_NEAR(between(solid, side).v_n, solid.v_n, 1e-6);
}

/// A plate without mass and with both faces in gas is where the contact of the two gases would be.
TEST(Balance, AMasslessPlateMovesLikeTheContactBetweenTwoGases) {
  for (const Pair& pair : pairs) {
    const exact::Riemann waves(pair.left, pair.right, gamma_gas);
    GasSide behind = side_of(pair.left);
    behind.state.v_n = -pair.left.v;
    Eigen::MatrixXd N(1, 2);
    N << 1, -1;  // normals of the two faces
    const std::vector<GasSide> gas{side_of(pair.right), behind};
    const std::vector<double> ds{0.3, 0.3};
    const auto massless = [](const ModalLoad& load) -> Eigen::VectorXd {
      return Eigen::MatrixXd(load.A).ldlt().solve(load.f);
    };
    EXPECT_NEAR(balance(N.sparseView(), gas, ds, massless)(0), waves.v_star(), 1e-11);
  }
}

TEST(Balance, IsTheLinearOneForAGasOfLinearAnswer) {
  Eigen::MatrixXd N(2, 3);
  N << 1, 0.5, -0.2, 0, 0.7, 1;
  std::vector<GasSide> gas;
  std::vector<NormalSide> states;
  for (const double z : {0.5, 1.0, 2.0}) {
    states.push_back({.z = z, .v_n = 0.3 * z, .w_n = -0.1 * z});
    gas.push_back({.state = states.back(), .curve = {.z = z}});
  }
  const std::vector<double> ds{0.5, 1.0, 0.5};
  const auto answer = [](const ModalLoad& load) -> Eigen::VectorXd {
    return Eigen::MatrixXd(load.A).ldlt().solve(load.f);
  };
  EXPECT_EQ(balance(N.sparseView(), gas, ds, answer), answer(modal_load(N.sparseView(), states, ds)));
}

TEST(Balance, DiffersFromTheLinearOneByTheSquareOfTheJump) {
  Eigen::MatrixXd N(2, 3);
  N << 1, 0.5, -0.2, 0, 0.7, 1;
  const std::vector<double> ds{0.5, 1.0, 0.5};
  const auto answer = [](const ModalLoad& load) -> Eigen::VectorXd {
    return (Eigen::MatrixXd::Identity(2, 2) + Eigen::MatrixXd(load.A)).ldlt().solve(load.f);
  };
  const auto difference = [&](double jump) {
    std::vector<GasSide> gas;
    std::vector<NormalSide> states;
    for (const double v : {-0.7, 1.0, 0.4}) {
      gas.push_back(side_of({.rho = 1, .v = v * jump, .p = p_e * (1 + 0.3 * v * jump)}));
      states.push_back(gas.back().state);
    }
    return (balance(N.sparseView(), gas, ds, answer) - answer(modal_load(N.sparseView(), states, ds))).norm();
  };
  EXPECT_GT(difference(1e-2), 1e-6);
  EXPECT_NEAR(std::log2(difference(1e-2) / difference(5e-3)), 2, 0.1);
  EXPECT_NEAR(std::log2(difference(1e-3) / difference(5e-4)), 2, 0.01);
}

// What resists a gas of linear answer may not resist any more where the curve is flat.
TEST(Balance, IsNoneWhereNothingResistsAModeAnyMore) {
  Eigen::MatrixXd N(1, 1);
  N << 1;
  const std::vector<GasSide> gas{side_of({.rho = 1, .v = 0.5, .p = p_e})};
  const std::vector<double> ds{1.0};
  for (int sound = 0; sound < 6; ++sound) {
    int calls = 0;
    const auto answer = [&](const ModalLoad& load) -> Eigen::VectorXd {
      if (calls++ > sound) return {};
      return load.f / load.A.coeff(0, 0);
    };
    const Eigen::VectorXd q_dot = balance(N.sparseView(), gas, ds, answer);
    EXPECT_EQ(q_dot.size(), calls > sound + 1 ? 0 : 1) << sound;
  }
}

}  // namespace
}  // namespace fsi::coupler
