// The one-dimensional reference is itself held against the exact elastic piston and against limits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/failure.hpp"
#include "common/exact/elastic_piston.hpp"
#include "reference/piston_chain.hpp"

namespace fsi::reference {
namespace {

PistonProblem exact_problem(const exact::ElasticPiston& piston, double t_end) {
  PistonProblem problem;
  problem.material.rho_bar = piston.rho_bar();
  problem.material.lambda = problem.material.mu = piston.lambda();
  problem.p_e = piston.p_e();
  problem.wall = false;
  problem.drive = [&](double t) { return piston.solid(-1, 0, t).u[0]; };
  problem.u_0 = [&](double x) { return piston.solid(x, 0, 0).u[0]; };
  problem.v_0 = [&](double x) { return piston.solid(x, 0, 0).v[0]; };
  problem.gas_0 = [&](double x) {
    const auto gas = piston.gas(x, 0, 0);
    return exact::TubeState{.rho = gas.rho, .v = gas.v1, .p = gas.p};
  };
  problem.times = {t_end};
  return problem;
}

double error_against_exact(const exact::ElasticPiston& piston, int points, double t_end) {
  const auto outputs = solve_piston(exact_problem(piston, t_end), points);
  const PistonOutput& out = outputs.back();
  const double stiffness = 3 * piston.lambda();
  double error = 0;
  for (std::size_t k = 0; k < out.x_bar.size(); ++k) {
    const auto solid = piston.solid(out.x_bar[k], 0, t_end);
    error = std::max({error, std::abs(out.u[k] - solid.u[0]), std::abs(out.v_bar[k] - solid.v[0]),
                      std::abs(out.P11[k] - solid.P(0, 0)) / stiffness,
                      std::abs(out.P22[k] - solid.P(1, 1)) / stiffness});
  }
  for (std::size_t k = 0; k < out.x.size(); ++k) {
    const auto gas = piston.gas(out.x[k], 0, t_end);
    error = std::max(
        {error, std::abs(out.rho[k] - gas.rho), std::abs(out.v[k] - gas.v1), std::abs(out.p[k] - gas.p)});
  }
  return error;
}

class PistonChainOfRatio : public testing::TestWithParam<double> {};

TEST_P(PistonChainOfRatio, ConvergesToTheExactElasticPistonAtSecondOrder) {
  const exact::ElasticPiston piston{{.density_ratio = GetParam()}};
  const double coarse = error_against_exact(piston, 200, 0.8);
  const double fine = error_against_exact(piston, 400, 0.8);
  EXPECT_GT(std::log2(coarse / fine), 1.9);
  // Strains and displacements of order one (1 / ratio for a light solid): errors of some h^2.
  EXPECT_LT(fine, 20.0 / (400 * 400) * std::max(1.0, 0.1 / GetParam()));
}

INSTANTIATE_TEST_SUITE_P(DensityRatios, PistonChainOfRatio, testing::Values(0.01, 0.1, 1.0, 100.0));

TEST(PistonChain, OpenEndSendsNothingBack) {
  // The wave has left [0, 1.5] at t = 2; what came back from
  // the end would be seen against the exact solution.
  const exact::ElasticPiston piston{{.density_ratio = 1, .amplitude = 0.02}};
  EXPECT_LT(error_against_exact(piston, 300, 2.0), 1e-5);
}

/// A solid at rest whose left end is pushed smoothly by `amplitude`.
PistonProblem pushed(const std::string& law, double amplitude) {
  PistonProblem problem;
  problem.material.law = law;
  problem.material.rho_bar = 1;
  problem.material.lambda = problem.material.mu = 0.5;
  problem.gamma = 1.4;
  problem.p_e = 1 / 1.4;
  problem.drive = [=](double t) { return amplitude * std::pow(std::sin(2 * t), 4); };
  problem.u_0 = problem.v_0 = [](double) { return 0.0; };
  problem.gas_0 = [](double) { return exact::TubeState{.rho = 1, .v = 0, .p = 1 / 1.4}; };
  problem.times = {1.4};
  return problem;
}

TEST(PistonChain, AtRestNothingMoves) {
  PistonProblem problem = pushed("neo_hookean", 0);
  const auto out = solve_piston(problem, 50).back();
  for (const double u : out.u) EXPECT_NEAR(u, 0, 1e-13);  // round-off of the positions
  for (const double p : out.p) EXPECT_NEAR(p, 1 / 1.4, 1e-12);
}

TEST(PistonChain, LawsMeetLikeTheSquareOfTheAmplitude) {
  for (const char* law : {"saint_venant_kirchhoff", "neo_hookean"}) {
    const auto difference = [&](double amplitude) {
      return compare(solve_piston(pushed(law, amplitude), 100),
                     solve_piston(pushed("linear_elastic", amplitude), 100))
          .u_bar;
    };
    EXPECT_NEAR(difference(0.02) / difference(0.01), 4, 0.2) << law;
  }
}

TEST(PistonChain, DifferenceOfTwoRunsFallsFourfoldWhenBothAreRefined) {
  const auto problem = pushed("saint_venant_kirchhoff", 0.03);
  const auto a = solve_piston(problem, 100), b = solve_piston(problem, 200), c = solve_piston(problem, 400);
  const Difference coarse = compare(b, a), fine = compare(c, b);
  EXPECT_NEAR(coarse.u_bar / fine.u_bar, 4, 0.3);
  EXPECT_NEAR(coarse.P_bar / fine.P_bar, 4, 0.6);
  EXPECT_NEAR(coarse.p / fine.p, 4, 0.6);
}

TEST(PistonChain, RefusesALawItDoesNotKnow) {
  EXPECT_THROW(solve_piston(pushed("rubber", 0.1), 50), UserMistake);
}

TEST(PistonChain, SaysWhereTheSolidFolds) {
  PistonProblem problem = pushed("linear_elastic", 0.1);
  problem.drive = [](double t) { return 5 * t * t; };  // faster than its waves
  try {
    solve_piston(problem, 50);
    FAIL() << "a folded solid must be noticed";
  } catch (const Diverged& broke) {
    EXPECT_NE(std::string(broke.what()).find("x_bar"), std::string::npos);
  }
}

/// A piston that is driven into the gas ever faster: waves steepen until a spring folds.
TEST(PistonChain, KeepsWhatItHasFoundWhenASpringFolds) {
  const exact::ElasticPiston piston{{.density_ratio = 1}};
  PistonProblem problem = exact_problem(piston, 0.8);
  const auto gentle = problem.drive;
  problem.drive = [=](double t) { return gentle(t) + 20 * t * t * t; };
  problem.times = {0, 0.05, 3};
  const PistonRun run = solve_piston_while_sound(problem, 100);
  ASSERT_EQ(run.outputs.size(), 2U);
  EXPECT_EQ(run.outputs.back().t, 0.05);
  EXPECT_EQ(run.broke.find("one-dimensional reference: t = "), 0U) << run.broke;
  EXPECT_THROW(solve_piston(problem, 100), Diverged);
}

}  // namespace
}  // namespace fsi::reference
