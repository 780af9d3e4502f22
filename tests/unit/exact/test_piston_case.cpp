// A case file as a one-dimensional piston.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/case/check/given/misfit.hpp"
#include "common/core/failure.hpp"
#include "common/exact/elastic_piston.hpp"
#include "reference/piston_case.hpp"

namespace fsi::reference {
namespace {

class PistonCase : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path = testing::TempDir() + "fsi_piston_case_" + info->name() + ".yaml";
  }
  void TearDown() override { std::filesystem::remove(path); }

  /// The pieces a test varies; the rest is a small nonlinear piston.
  Case read(const std::string& gas_right, const std::string& solid_left, const std::string& more = "") {
    std::ofstream(path) << R"(
title: piston
grid: {factor: 2}
time: {end: 0.5}
fluid:
  gamma: 1.4
  p_e: 1 / 1.4
  grid: {x: [0, 1.5], y: [0, 0.2], spacing: h}
  boundary: {left: {kind: interface, solid: solid}, right: )"
                        << gas_right << R"(, bottom: symmetry, top: symmetry}
  initial: {rho: 1, v: [0, 0], p: 1 / 1.4}
solids:
  solid:
    law: neo_hookean
    rho: 2
    lambda: 3
    mu: 1
    grid: {x: [-1, 0], y: [0, 0.2], spacing: h}
    boundary: {left: )" << solid_left
                        << R"(, right: interface, bottom: symmetry, top: symmetry}
)" << more << R"(
reference: {kind: piston_1d, points: 400}
output: {times: [0.25, 0.5]}
)";
    return load_case(path);
  }

  void expect_mistake(const std::string& gas_right, const std::string& solid_left, const std::string& word,
                      const std::string& more = "") {
    try {
      read(gas_right, solid_left, more);
      FAIL() << "must be refused";
    } catch (const UserMistake& mistake) {
      const std::string words = mistake.what();
      EXPECT_NE(words.find(word), std::string::npos) << words;
      EXPECT_EQ(words.find(path), 0U) << words;
    }
  }

  std::string path;
  const std::string driven = "{kind: displacement, value: [0, 0]}";
};

TEST_F(PistonCase, TakesMaterialGasAndTimesFromTheFile) {
  const Case problem = read("slip_wall", "{kind: displacement, value: [\"0.1 * t^4\", 0]}");
  const PistonProblem piston = piston_from_case(problem);
  EXPECT_EQ(piston.material.law, "neo_hookean");
  EXPECT_EQ(piston.material.rho_bar, 2);
  EXPECT_EQ(piston.material.lambda, 3);
  EXPECT_EQ(piston.x_end, 1.5);
  EXPECT_DOUBLE_EQ(piston.p_e, 1 / 1.4);
  EXPECT_TRUE(piston.wall);
  EXPECT_DOUBLE_EQ(piston.drive(2), 1.6);
  EXPECT_EQ(piston.times, (std::vector<double>{0, 0.25, 0.5}));
  EXPECT_EQ(points_from_case(problem), 400);
}

TEST_F(PistonCase, AnOutflowAtTheEndIsNoWall) {
  const Case problem = read("outflow", "{kind: displacement, value: [0, 0]}");
  EXPECT_FALSE(piston_from_case(problem).wall);
}

TEST_F(PistonCase, ASolidThatIsNotDrivenIsRefused) {
  expect_mistake("slip_wall", "free", "solids.solid.boundary.left: ");
}

TEST_F(PistonCase, ABodyForceIsRefused) {
  expect_mistake("slip_wall", driven, "solids.solid.body_force: ", "    body_force: [0.2, 0]");
}

TEST_F(PistonCase, WhatVariesAcrossThePistonIsRefused) {
  read("slip_wall", driven, "    initial: {v: [\"1e-3 * sin(x)\", 0]}");
  expect_mistake("slip_wall", driven, "solids.solid.initial.v: ", "    initial: {v: [1e-3 * y, 0]}");
  expect_mistake("slip_wall", driven, "solids.solid.initial.v: ", "    initial: {v: [0, 1e-3 * x]}");
  const auto moved = [](const std::string& by) { return "{kind: displacement, value: [" + by + "]}"; };
  expect_mistake("slip_wall", moved("0.1 * t^4 * (1 + y), 0"),
                 "solids.solid.boundary.left.value: must depend on x alone");
  expect_mistake("slip_wall", moved("0.1 * t^4, 0.1 * t^4"),
                 "solids.solid.boundary.left.value: must depend on x alone");
}

TEST_F(PistonCase, LongSidesThatAreFeltAreRefused) {
  const auto with = [](const std::string& sides) { return "outflow, bottom: " + sides + "}\n  #"; };
  read(with("outflow, top: slip_wall"), driven);
  expect_mistake(with("{kind: far_field, state: {rho: 1, v: [0, 0], p: 1 / 1.4}}, top: symmetry"), driven,
                 "fluid.boundary.bottom: is felt in the one-dimensional");
}

TEST_F(PistonCase, AGasDrivenFromItsRightSideIsRefused) {
  const auto state = [](const std::string& rho, const std::string& v) {
    return "{kind: dirichlet, state: {rho: " + rho + ", v: [" + v + ", 0], p: 1 / 1.4}}";
  };
  EXPECT_FALSE(piston_from_case(read(state("1", "0"), driven)).wall);
  expect_mistake(state("1.1", "0"), driven, "fluid.boundary.right.state: ");
  expect_mistake(state("1", "\"-0.1 * t\""), driven, "fluid.boundary.right.state: ");
  expect_mistake(state("1 + 0.1 * y", "0"), driven, "fluid.boundary.right.state: ");
  expect_mistake("{kind: dirichlet, state: {rho: 1, v: [0, 0.3], p: 1 / 1.4}}", driven,
                 "fluid.boundary.right.state: ");
}

TEST_F(PistonCase, ATurnedPistonIsNone) {
  const auto found = misfit_of_piston(load_case(FSI_CONFIGS "/elastic_piston.yaml", {"parameters.angle=30"}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->path, "reference.kind");
}

TEST(PistonOfTheRepository, ElasticPistonCaseGivesItsExactSolution) {
  const Case problem = load_case(FSI_CONFIGS "/elastic_piston.yaml", {"parameters.density_ratio=0.1"});
  const auto out = solve_piston(piston_from_case(problem), 200).back();
  const exact::ElasticPiston exact{{.density_ratio = 0.1}};
  ASSERT_EQ(out.t, problem.time.end);
  // Second order: some h^2 = 2.5e-5 of a displacement of order one.
  for (std::size_t k = 0; k < out.u.size(); ++k) {
    EXPECT_NEAR(out.u[k], exact.solid(out.x_bar[k], 0, out.t).u[0], 2.5e-5);
  }
}

}  // namespace
}  // namespace fsi::reference
