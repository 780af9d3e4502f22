// What a run will cost, by its grids.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/case/grids/composite_from_case.hpp"
#include "common/case/report/cost.hpp"
#include "common/core/failure.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/geometry/quality.hpp"
#include "common/grid/moving_grid.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::load_text;

constexpr auto gas_at_rest =
    "time: {end: 1}\ngrid: {factor: 2}\n"
    "fluid:\n"
    "  grid: {x: [-2, 2], y: [-2, 2]}\n"
    "  boundary: {left: outflow, right: outflow, bottom: slip_wall, top: outflow}\n"
    "  initial: {rho: 1, v: [0, 0], p: 1}\n";

/// Bodies in a gas, with nothing but their outlines; `more`: lines of each of them.
std::string costly_case(const std::vector<std::string>& shapes, const std::string& more = "") {
  std::string text = std::string(gas_at_rest) + "solids:\n";
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    text += "  body_" + std::to_string(k) +
            ":\n    law: neo_hookean\n    rho: 1\n    lambda: 1\n    mu: 1\n    shape: " + shapes[k] + "\n" +
            more;
  }
  return text;
}

const std::string disk_alone = "{kind: circle, radius: 0.5}";

/// An elastic square alone, its waves of speed 2, without stabilisation.
std::string square_case(const std::string& spacing) {
  return "time: {end: 1, cfl: 0.5}\nsolids:\n  square:\n    law: linear_elastic\n    rho: 1\n    lambda: 2\n "
         "   mu: 1\n"
         "    grid: {x: [0, 1], y: [0, 1], spacing: " +
         spacing +
         "}\n"
         "    boundary: {left: free, right: free, bottom: free, top: free}\n"
         "    scheme: {tangential_stress: {scaled: 0}, displacement: {scaled: 0}, relaxation: {scaled: 0}}\n";
}

TEST(CostOfARun, IsThatOfTheWavesThroughTheSmallestCell) {
  // 1 / dt = c (1 / dx + 1 / dy) / cfl, c^2 = (lambda + 2 mu) / rho = 4
  const RunCost cost = cost_of(load_text(square_case("0.1")));
  ASSERT_EQ(cost.programs.size(), 1U);
  EXPECT_NEAR(cost.dt, 0.5 / (2 * (10 + 10)), 1e-12);
  EXPECT_NEAR(cost.steps, 80, 1);
  EXPECT_NEAR(cost_of(load_text(square_case("0.05"))).steps, 160, 1);
  EXPECT_EQ(cost.programs[0].points, 121);
}

/// The stream around a cylinder, whose formulas are infinite in its middle.
TEST(CostOfARun, IsOfTheGasWhereThereIsGas) {
  std::string text = costly_case({disk_alone});
  const std::string rest = "v: [0, 0]";
  ASSERT_NE(text.find(rest), std::string::npos);
  const double at_rest = cost_of(load_text(text)).programs[0].dt;
  const auto with = [&](const char* v) { return std::string(text).replace(text.find(rest), rest.size(), v); };
  EXPECT_EQ(cost_of(load_text(with("v: [\"r < 0.4 ? 1 / r : 0\", 0]"))).programs[0].dt, at_rest);
  EXPECT_LT(cost_of(load_text(with("v: [\"r > 0.6 ? 1 / r : 0\", 0]"))).programs[0].dt, 0.8 * at_rest);
}

TEST(CostOfARun, CountsNoPointsWhereTheGasOrTheSolidIsNot) {
  const Case problem = load_text(costly_case({disk_alone}));
  const auto all = [](const auto& owner) {
    const BodyFittedSpec& ring = owner.body_fitted.front();
    return static_cast<double>(owner.grid.n1) * owner.grid.n2 + 1.0 * ring.curve.points() * ring.lines;
  };
  const auto cell = [](const GridSpec& grid) {
    return (grid.x_b - grid.x_a) / (grid.n1 - 1) * (grid.y_b - grid.y_a) / (grid.n2 - 1);
  };
  const FluidSpec& gas = problem.fluids.front();
  const SolidSpec& solid = problem.solids.front();
  const double disk = 3.14159 * 0.5 * 0.5;
  const double around_disk = (solid.grid.x_b - solid.grid.x_a) * (solid.grid.y_b - solid.grid.y_a) - disk;
  const RunCost cost = cost_of(problem);
  EXPECT_NEAR(cost.programs[0].points, all(gas) - disk / cell(gas.grid), 0.01 * all(gas));
  EXPECT_NEAR(cost.programs[1].points, all(solid) - around_disk / cell(solid.grid), 0.05 * all(solid));
  EXPECT_LT(cost.programs[1].points, 0.95 * all(solid));
}

TEST(CostOfARun, CountsTheSubstepsOfAStiffSolid) {
  const std::string stiff = costly_case({disk_alone});
  const RunCost alike = cost_of(load_text(stiff, {"time.multirate=false"}));
  const RunCost own =
      cost_of(load_text(stiff, {"time.multirate=true", "solids.body_0.lambda=98", "solids.body_0.mu=1"}));
  EXPECT_EQ(alike.substeps(alike.programs[1]), 1);
  EXPECT_GT(own.substeps(own.programs[1]), 3);
  EXPECT_LE(own.dt, own.substeps(own.programs[1]) * own.programs[1].dt * (1 + 1e-9));
  EXPECT_EQ(own.dt, own.programs[0].dt);
  EXPECT_NE(cost_text(own).find("substeps"), std::string::npos);
}

TEST(CostOfARun, OfMoreSubstepsThanAStepMayHaveIsRefused) {
  const auto with_density = [](const char* rho) {
    refuse_endless(cost_of(load_text(costly_case({disk_alone}),
                                     {"time.multirate=true", std::string("solids.body_0.rho=") + rho})));
  };
  EXPECT_NO_THROW(with_density("1e-4"));
  for (const char* rho : {"1e-9", "1e-40"}) {
    try {
      with_density(rho);
      FAIL() << rho;
    } catch (const UserMistake& mistake) {
      EXPECT_NE(std::string(mistake.what()).find("solids.body_0: takes about"), std::string::npos)
          << mistake.what();
    }
  }
}

TEST(CostOfARun, OffersSubstepsWhereASolidMakesTheGasTakeSmallSteps) {
  const std::string text = costly_case({disk_alone});
  const std::vector<std::string> stiff = {"solids.body_0.lambda=98", "solids.body_0.mu=1",
                                          "time.multirate=false"};
  const auto with = [&](const std::string& setting) {
    std::vector<std::string> settings = stiff;
    settings.push_back(setting);
    return cost_of(load_text(text, settings));
  };
  const auto offers = [](const RunCost& cost) {
    return cost_text(cost).find("`time.multirate: true`") != std::string::npos;
  };
  const RunCost alike = cost_of(load_text(text, stiff)), own = with("time.multirate=true");
  EXPECT_TRUE(offers(alike)) << cost_text(alike);
  EXPECT_EQ(alike.multirate_steps, own.steps);
  EXPECT_EQ(alike.multirate_seconds, own.seconds);
  EXPECT_FALSE(offers(own));
  EXPECT_FALSE(offers(with("interface.projection=traditional")));  // which goes without substeps
  EXPECT_FALSE(offers(with("solids.body_0.rho=1000")));            // the gas needs the smaller ones
}

TEST(CostOfARun, NamesAllSolidsWhoseStepsAreSmall) {
  const std::string text = costly_case(
      {"{kind: circle, centre: [-1, 0], radius: 0.5}", "{kind: circle, centre: [1, 0], radius: 0.5}"});
  std::vector<std::string> settings = {"time.multirate=false"};
  for (const char* body : {"solids.body_0", "solids.body_1"}) {
    settings.push_back(std::string(body) + ".lambda=98");
    settings.push_back(std::string(body) + ".mu=1");
  }
  const std::string said = cost_text(cost_of(load_text(text, settings)));
  EXPECT_NE(said.find("body_0, body_1: all programs take steps as small"), std::string::npos) << said;
}

TEST(CostOfARun, GridsThatMoveCostMoreThanThoseThatStay) {
  const std::string thin = costly_case({"{kind: ellipse, semi_axes: [0.5, 0.06]}"});
  const RunCost moves = cost_of(load_text(thin, {}, {"body_0=rigid"})),
                stays = cost_of(load_text(thin, {"solids.body_0.motion=fixed"}, {"body_0=rigid"}));
  EXPECT_EQ(stays.programs[0].grids, 0);
  EXPECT_EQ(moves.programs[0].points, stays.programs[0].points);
  EXPECT_GT(moves.programs[0].grids, 0.1e-6 * moves.programs[0].moving);
  EXPECT_GT(moves.seconds, stays.seconds);
  EXPECT_EQ(cost_text(moves).find("more than an hour"), std::string::npos);
  EXPECT_NE(
      cost_text(cost_of(load_text(thin, {"time.end=1000000"}, {"body_0=rigid"}))).find("more than an hour: "),
      std::string::npos);
}

TEST(CostOfARun, OfAnEndFarAwayIsToldInFewDigits) {
  const std::string text = cost_text(cost_of(load_text(costly_case({disk_alone}), {"time.end=1e300"})));
  EXPECT_EQ(text.find("00000"), std::string::npos) << text;
  EXPECT_NE(text.find("e+30"), std::string::npos) << text;
}

TEST(CostOfARun, SaysWhereAFewSmallCellsSetTheStep) {
  // Points clustered at one place of the outline.
  const std::string drawn =
      "{kind: circle, radius: 0.5, points: 120, weights: [{strength: 0.1, sharpness: 100, place: 0.5}]}";
  EXPECT_NE(cost_text(cost_of(load_text(costly_case({drawn})))).find("times smaller"), std::string::npos);
  EXPECT_EQ(cost_text(cost_of(load_text(costly_case({disk_alone})))).find("times smaller"),
            std::string::npos);
}

}  // namespace
}  // namespace fsi
