/// What is noted about a case, and what is chosen for the scheme of its gas.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/case/case.hpp"
#include "common/case/report/remarks.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

TEST(RemarksOnACase, WhatAStreamThatIsBroughtToRestPressesWith) {
  const Case problem = load_case(FSI_ROOT "/configs/shock_ellipse.yaml", {"parameters.stiffness=2"});
  const SolidSpec& solid = problem.solids.front();
  const GasExpressions& behind = *problem.fluids.front().boundary.front().state;
  const double p = behind.p(0, 0, 0) - problem.fluids.front().p_e, rho = behind.rho(0, 0, 0),
               v = behind.v1(0, 0, 0);
  EXPECT_NEAR(pressure_over_stiffness(problem, solid), p / 6, 1e-12);
  EXPECT_NEAR(stagnation_over_stiffness(problem, solid), (p + rho * v * v) / 6, 1e-12);
  const Case slanted = load_case(FSI_ROOT "/configs/shock_ellipse.yaml",
                                 {"parameters.stiffness=2", "fluid.boundary.left.state.v=[3, 4]"});
  EXPECT_NEAR(stagnation_over_stiffness(slanted, solid), (p + rho * 25) / 6, 1e-12);
  const Case rigid = load_case(FSI_ROOT "/configs/rigid_piston.yaml");
  EXPECT_EQ(stagnation_over_stiffness(rigid, rigid.solids.front()), 0);
}

TEST(RemarksOnACase, OfASolidThatTheGasSqueezesToNothing) {
  const auto remarks = [](const std::string& stiffness) {
    return remarks_on(
        load_case(FSI_ROOT "/configs/shock_ellipse.yaml", {"parameters.stiffness=" + stiffness}));
  };
  EXPECT_TRUE(remarks("4").empty());
  // p - p_e = 0.805 behind the shock of Mach 1.3; lambda + 2 mu = 3 stiffness
  EXPECT_TRUE(remarks("0.03").empty());
  ASSERT_EQ(remarks("0.004").size(), 1U);
  EXPECT_NE(remarks("0.004").front().find(
                "solids.ellipse: the pressure of the gas differs from p_e by up to 67.1 times"),
            std::string::npos)
      << remarks("0.004").front();
}

TEST(RemarksOnACase, OfAnInflowThatLeaves) {
  const auto remarks = [](const std::string& side, const std::string& v) {
    return remarks_on(
        load_case(FSI_ROOT "/configs/two_cylinders.yaml",
                  {"fluid.boundary." + side + "={kind: inflow, state: {rho: 1, v: " + v + ", p: 0.7}}"}));
  };
  for (const auto& [side, into] : {std::pair{"left", "[0.3, -0.1]"},
                                   {"right", "[-0.3, 0.1]"},
                                   {"bottom", "[0.1, 0.3]"},
                                   {"top", "[0.1, -0.3]"}})
    EXPECT_TRUE(remarks(side, into).empty()) << side;
  for (const auto& [side, out] : {std::pair{"left", "[-0.3, 0.1]"},
                                  {"right", "[0.3, -0.1]"},
                                  {"bottom", "[0.1, -0.3]"},
                                  {"top", "[0.1, 0.3]"}}) {
    ASSERT_EQ(remarks(side, out).size(), 1U) << side;
    EXPECT_EQ(
        remarks(side, out).front().find(fmt::format("fluid.boundary.{}: the state of this inflow", side)),
        0U);
  }
  EXPECT_TRUE(remarks("left", "[sin(9 * t), 0]").empty());
}

TEST(RemarksOnACase, OfATemperatureInKelvin) {
  const auto said = [](const std::string& units, const std::string& state) {
    const std::vector<std::string> remarks =
        remarks_on(load_case(FSI_ROOT "/configs/two_cylinders.yaml",
                             {"units=" + units, "fluid.initial=" + state,
                              "fluid.boundary.left={kind: imposed, state: {rho: 1.2, v: [0, 0], p: 1e5}}"}));
    return std::ranges::count_if(remarks, [](const std::string& one) {
      return one.starts_with("fluid: p / rho is 300 m2/s2 in one of its states");
    });
  };
  EXPECT_EQ(said("SI", "{rho: 1.2, v: [0, 0], T: 300}"), 1);
  EXPECT_EQ(said("SI", "{rho: 1.2, v: [0, 0], p: 360}"), 1);
  EXPECT_EQ(said("SI", "{rho: 1.2, v: [0, 0], T: 287 * 300}"), 0);
  EXPECT_EQ(said("none", "{rho: 1.2, v: [0, 0], T: 300}"), 0);
  EXPECT_EQ(said("SI", "{rho: 1.2, v: [0, 0], T: 'x < 0.5 ? 300 : 287 * 300'}"), 1);
}

TEST(RemarksOnACase, OfASpeedWhereAMachNumberWasMeant) {
  const auto said = [](double speed) {
    const std::vector<std::string> remarks =
        remarks_on(load_case(FSI_ROOT "/configs/two_cylinders.yaml",
                             {fmt::format("fluid.initial={{rho: 1.4, v: [0, {}], p: 1}}", speed)}));
    return std::ranges::count_if(
        remarks, [](const std::string& one) { return one.starts_with("fluid: the gas goes at Mach 170"); });
  };
  EXPECT_EQ(said(1.7), 0);
  EXPECT_EQ(said(12), 0);
  EXPECT_EQ(said(-170), 1);
}

TEST(RemarksOnACase, OfAPressureAtRestThatWasLeftOut) {
  const auto remarks = [](const std::string& p_e) {
    return remarks_on(load_case(FSI_ROOT "/configs/two_cylinders.yaml", {"fluid.p_e=" + p_e}));
  };
  EXPECT_TRUE(remarks("0.7").empty());
  ASSERT_EQ(remarks("0").size(), 1U);
  EXPECT_EQ(remarks("0").front().find("fluid.p_e is 0: elastic bodies"), 0U) << remarks("0").front();
  EXPECT_TRUE(remarks_on(load_case(FSI_ROOT "/configs/rigid_piston.yaml", {"fluid.p_e=0"})).empty());
}

/// What is chosen for the gas of `two_cylinders`, whose own scheme is left out, and what it says so.
std::string viscosity_with(const std::vector<std::string>& settings) {
  std::vector<std::string> all{"fluid.scheme={limiter: minmod}",
                               "fluid.boundary.left={kind: imposed, state: {rho: 1.4, v: [0, 0], p: 1}}",
                               "fluid.initial={rho: 1.4, v: [0, 0], p: 1}"};
  all.insert(all.end(), settings.begin(), settings.end());
  const Case problem = load_case(FSI_ROOT "/configs/two_cylinders.yaml", all);
  const auto said = std::ranges::find_if(problem.chosen, [](const std::string& line) {
    return line.starts_with("fluid.scheme: shock_viscosity 0.5");
  });
  const bool written = problem.resolved.find("shock_viscosity: 0.5") != std::string::npos;
  EXPECT_EQ(said != problem.chosen.end(), problem.fluids.front().scheme.shock_viscosity == 0.5);
  EXPECT_EQ(written, problem.fluids.front().scheme.shock_viscosity == 0.5);
  return fmt::format("{}", problem.fluids.front().scheme.shock_viscosity.value_or(0));
}

TEST(ChosenScheme, HasShockViscosityWhereShocksOfMachTwoMayComeUp) {
  const auto gas = [](const std::string& v, const std::string& p) {
    return "fluid.initial={rho: 1.4, v: [0, " + v + "], p: '" + p + "'}";
  };
  EXPECT_EQ(viscosity_with({}), "0");
  EXPECT_EQ(viscosity_with({gas("-1.99", "1")}), "0");
  EXPECT_EQ(viscosity_with({gas("-2", "1")}), "0.5");
  // a shock of Mach 2 has the pressure ratio 4.5, also one of a small hot place
  EXPECT_EQ(viscosity_with({gas("0", "x < 2 ? 1 : 4.49")}), "0");
  EXPECT_EQ(viscosity_with({gas("0", "x < 2 ? 1 : 4.5")}), "0.5");
  EXPECT_EQ(viscosity_with({gas("0", "(x - 2.03)^2 + (y - 2.03)^2 < 0.01 ? 0.2 : 1")}), "0.5");
  // a piston of 1.25 times the speed of sound drives one
  EXPECT_EQ(viscosity_with({"solids.cylinder_1.initial={v: [0, 1.24]}"}), "0");
  EXPECT_EQ(viscosity_with({"solids.cylinder_1.initial={v: [0, 1.25]}"}), "0.5");
}

TEST(ChosenScheme, LooksAtSidesUntilTheEndAndAtSmallParts) {
  const auto side = [](const std::string& v) {
    return "fluid.boundary.left={kind: imposed, state: {rho: 1.4, v: ['" + v + "', 0], p: 1}}";
  };
  EXPECT_EQ(viscosity_with({side("0")}), "0");
  EXPECT_EQ(viscosity_with({side("abs(y - 0.3) < 0.1 ? 2 : 0")}), "0.5");
  EXPECT_EQ(viscosity_with({side("min(2, 4 * t)")}), "0.5");
  EXPECT_EQ(viscosity_with({side("min(1.9, 4 * t)")}), "0");
}

TEST(ChosenScheme, TakesTheSpeedOfBodiesRelativeToTheGas) {
  const auto gas = [](const std::string& v) {
    const std::string state = "{rho: 1.4, v: [0, " + v + "], p: 1}";
    return std::vector<std::string>{"fluid.initial=" + state,
                                    "fluid.boundary.left={kind: imposed, state: " + state + "}"};
  };
  const auto with = [&](const std::string& of_gas, const std::string& of_bodies) {
    std::vector<std::string> settings = gas(of_gas);
    for (const char* body : {"1", "2"})
      settings.push_back(fmt::format("solids.cylinder_{}.initial={{v: [0, {}]}}", body, of_bodies));
    return viscosity_with(settings);
  };
  EXPECT_EQ(with("1.3", "1.3"), "0");
  EXPECT_EQ(with("0.7", "-0.5"), "0");
  EXPECT_EQ(with("0.7", "-0.6"), "0.5");
  EXPECT_EQ(with("-0.7", "0.6"), "0.5");
}

TEST(ChosenScheme, IsThatOfEachGasAndIsReadAgainAsItWasWritten) {
  const Case problem = tests::load_text(
      "time: {end: 1}\n"
      "fluids:\n"
      "  low: {grid: {x: [-1, 0], y: [0, 0.4], points: [11, 5]}, initial: {rho: 1, v: [0, 0], p: 1},\n"
      "    boundary: {left: outflow, right: {kind: interface, solid: s}, bottom: slip_wall, top: "
      "slip_wall}}\n"
      "  high: {grid: {x: [0.1, 1], y: [0, 0.4], points: [11, 5]}, initial: {rho: 1, v: [0, 0], p: 10},\n"
      "    boundary: {right: outflow, left: {kind: interface, solid: s}, bottom: slip_wall, top: "
      "slip_wall}}\n"
      "solids:\n"
      "  s: {law: rigid, rho: 1, grid: {x: [0, 0.1], y: [0, 0.4], points: [5, 5]},\n"
      "    boundary: {left: {kind: interface, fluid: low}, right: {kind: interface, fluid: high}, bottom: "
      "slip_wall, top: slip_wall}}\n");
  int said = 0;
  for (const std::string& line : problem.chosen)
    said += line.find("shock_viscosity 0.5") != std::string::npos;
  for (const FluidSpec& fluid : problem.fluids) {
    EXPECT_EQ(fluid.scheme.shock_viscosity > 0, fluid.name == "low") << fluid.name;
  }
  EXPECT_EQ(said, 1);
  const Case again = tests::load_text(problem.resolved);
  EXPECT_EQ(again.digest, problem.digest);
  EXPECT_TRUE(again.chosen.empty());
}

TEST(ChosenScheme, LeavesWhatIsWrittenAndSmoothFlowAlone) {
  const std::string fast = "fluid.initial={rho: 1.4, v: [4, 0], p: 1}";
  EXPECT_EQ(viscosity_with({fast, "fluid.scheme={shock_viscosity: 0}"}), "0");
  EXPECT_EQ(viscosity_with({fast, "fluid.scheme={shock_viscosity: 0.25}"}), "0.25");
  EXPECT_EQ(viscosity_with({fast, "fluid.scheme={limiter: none}"}), "0");
}

}  // namespace
}  // namespace fsi
