// What a case gives as functions of place and time: there, and where the bodies are, or refused with its place.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::mistake_in;

/// A solid alone.
struct Solid {
  std::string law = "neo_hookean", left = "clamped", right = "{kind: traction, value: [0, 0]}",
              initial = "{v: [0, 0]}", more = {}, bottom = "symmetry";

  std::string text() const {
    return fmt::format(R"(time: {{end: 2}}
solids:
  s:
    law: {}
    rho: 1
    lambda: 2
    mu: 1
    grid: {{x: [-1, 0], y: [0, 1], points: [11, 11]}}
    boundary: {{left: {}, right: {}, bottom: {}, top: {}}}
    initial: {}
{})",
                       law, left, right, bottom, bottom, initial, more);
  }
};

void expect_refused(const std::string& text, const std::string& words,
                    const std::vector<std::string>& overrides = {}) {
  const std::string message = mistake_in(text, overrides);
  EXPECT_NE(message.find(words), std::string::npos) << message;
  EXPECT_EQ(message.find("case.yaml:"), 0U) << message;
}

TEST(GivenStart, MayStrainTheBodyAsFarAsItsLawGoes) {
  EXPECT_EQ(mistake_in(Solid{.initial = "{u: [0.5 * (x + 1), 0]}"}.text()), "");
  expect_refused(Solid{.initial = "{u: [-1.2 * (x + 1), 0]}"}.text(),
                 "solids.s.initial.u: turns the material inside out (det F = -0.2)");
  // I1 - 3 = 4 - 2 + 1 is more than 2.
  const std::string gent = "gent\n    J_m: 2";
  EXPECT_EQ(mistake_in(Solid{.law = gent, .initial = "{u: [0.5 * (x + 1), 0]}"}.text()), "");
  expect_refused(Solid{.law = gent, .initial = "{u: [x + 1, 0]}"}.text(),
                 "solids.s.initial.u: strains the material more than the law `gent` bears");
}

/// A jump is as steep as the grid has it.
TEST(GivenStart, IsSeenAsTheGridSeesIt) {
  EXPECT_EQ(mistake_in(Solid{.initial = "{u: [\"x > -0.5 ? 0 : 0.05\", 0]}"}.text()), "");
  expect_refused(Solid{.initial = "{u: [\"x > -0.5 ? 0 : 0.15\", 0]}"}.text(), "solids.s.initial.u: ");
}

TEST(GivenSide, LeavesTheFirstCellOfTheBodyWhole) {
  EXPECT_EQ(mistake_in(Solid{.left = "{kind: displacement, value: [0.3 * t, 0]}"}.text()), "");
  const std::string jump = "{kind: displacement, value: [0.3, 0]}";
  expect_refused(
      Solid{.left = jump}.text(),
      "solids.s.boundary.left.value: turns the material inside out (det F = -2) at once in the cell at "
      "(-1, 0): it begins with (0.3, 0), and the solid with (0, 0)");
  EXPECT_EQ(mistake_in(Solid{.left = jump, .initial = "{u: [0.3, 0]}"}.text()), "");
  EXPECT_EQ(mistake_in(Solid{.left = "{kind: displacement, value: [0.08, 0]}"}.text()), "");
  EXPECT_EQ(mistake_in(Solid{.left = "{kind: displacement, value: [-0.3, 0.3]}"}.text()), "");
  expect_refused(Solid{.initial = "{u: [-0.3, 0]}"}.text(),
                 "solids.s.boundary.left: turns the material inside out");
}

/// A wall holds what is across it alone.
TEST(GivenSide, ThatIsAWallLeavesTheFirstCellOfTheBodyWholeToo) {
  for (const char* wall : {"slip_wall", "symmetry"}) {
    const auto begins = [&](const char* initial) {
      return Solid{.left = wall, .initial = fmt::format("{{u: [{}, 0.3]}}", initial), .bottom = "free"}
          .text();
    };
    EXPECT_EQ(mistake_in(begins("0")), "");
    EXPECT_EQ(mistake_in(begins("0.05")), "");
    EXPECT_EQ(mistake_in(begins("-0.5 * (x + 1)")), "");
    expect_refused(
        begins("-0.3"),
        "solids.s.boundary.left: turns the material inside out (det F = -2) at once in the cell at "
        "(-1, 0): the wall holds the body across it, which begins with (-0.3, 0.3); let `initial.u` "
        "lead along the wall there, or be zero");
  }
}

TEST(GivenSide, MovesAsFastAsItsVelocitySays) {
  const auto moved = [](const char* value, const char* velocity) {
    return Solid{
        .right = fmt::format("{{kind: displacement, value: [{}, 0], velocity: [{}, 0]}}", value, velocity)}
        .text();
  };
  EXPECT_EQ(mistake_in(moved("0.01 * sin(9 * t)", "0.09 * cos(9 * t)")), "");
  EXPECT_EQ(mistake_in(moved("0", "0")), "");
  EXPECT_EQ(mistake_in(moved("\"t < 1 ? 0.01 * t : 0.01\"", "\"t < 1 ? 0.01 : 0\"")), "");
  expect_refused(moved("0.01 * t", "5"),
                 "solids.s.boundary.right.velocity: is (5, 0), but `value` moves there with (0.01, 0) (at "
                 "(0, 0), t = 0.125); "
                 "leave it out, and it is the rate of `value`");
  expect_refused(moved("0.01 * t", "-0.01"), "solids.s.boundary.right.velocity: is (-0.01, 0)");
  expect_refused(moved("0", "0.1"), "moves there with (0, 0)");
}

TEST(GivenSide, IsFiniteForTheWholeRun) {
  expect_refused(Solid{.right = "{kind: traction, value: [1 / t, 0]}"}.text(),
                 "solids.s.boundary.right.value: is (inf, 0) at (0, 0), t = 0; must be finite");
  expect_refused(Solid{.right = "{kind: traction, value: [0, sqrt(1.9 - t)]}"}.text(),
                 "nan) at (0, 0), t = 2; must be finite");
  EXPECT_EQ(mistake_in(Solid{.right = "{kind: traction, value: [sin(t - 1) / (t - 1), 0]}"}.text()), "");
}

TEST(GivenReference, OfASolidDoesNotFoldItBeforeTheEnd) {
  const auto chosen = [](const char* u) {
    return Solid{.right = "{kind: displacement, value: reference}",
                 .more = fmt::format("reference: {{kind: manufactured, u: [{}, 0]}}\n", u)}
        .text();
  };
  EXPECT_EQ(mistake_in(chosen("-0.4 * t * (x + 1)")), "");
  expect_refused(
      chosen("-0.6 * t * (x + 1)"),
      "reference.u: turns the material inside out (det F = -0.05) in the cell at (-1, 0) of solid `s`, t = "
      "1.75; let time.end be smaller");
}

/// The origin is between the points of this grid.
TEST(GivenReference, IsLookedAtWhereTheGridHasPoints) {
  const auto around_the_origin = [](int points) {
    return fmt::format(R"(time: {{end: 0.2}}
solids:
  s:
    law: neo_hookean
    rho: 1
    lambda: 1
    mu: 1
    grid: {{x: [-1, 1], y: [-1, 1], points: [{0}, {0}]}}
    boundary: {{left: displacement, right: displacement, bottom: displacement, top: displacement}}
    initial: reference
reference: {{kind: manufactured, u: ["0.05*sin(t)^2*x/r*r^2", "0.05*sin(t)^2*y/r*r^2"]}}
)",
                       points);
  };
  EXPECT_EQ(mistake_in(around_the_origin(22)), "");
  expect_refused(around_the_origin(33), "at (0, 0), t = 0; take other numbers there");
}

TEST(GivenReference, IsASolution) {
  const auto tube = [](const char* v) {
    return fmt::format(R"(time: {{end: 0.1}}
fluid:
  gamma: 1.4
  grid: {{x: [0, 1], y: [0, 0.2], points: [41, 9]}}
  boundary: {{left: dirichlet, right: dirichlet, bottom: symmetry, top: symmetry}}
  initial: reference
reference: {{kind: riemann, x_0: 0.5, rho_left: 1, v_left: -{0}, p_left: 1, rho_right: 1, v_right: {0}, p_right: 1}}
)",
                       v);
  };
  EXPECT_EQ(mistake_in(tube("1")), "");
  expect_refused(tube("8"), "the two states of the Riemann problem leave a vacuum between them");
}

TEST(GivenReference, EndsNoSoonerThanTheRun) {
  const std::string piston = FSI_ROOT "/configs/elastic_piston.yaml";
  EXPECT_NO_THROW(load_case(piston, {"time.end=1.5"}));
  try {
    load_case(piston, {"time.end=2.5"});  // the wall runs away from the gas faster than this follows
    FAIL() << "must be refused";
  } catch (const UserMistake& mistake) {
    EXPECT_NE(std::string(mistake.what()).find("let time.end be smaller"), std::string::npos)
        << mistake.what();
  }
}

/// A disk of radius 0.5 in a gas, or a gas in that disk.
std::string disk_case(const std::string& rho, const std::string& more, const std::string& fitted = "") {
  return fmt::format(R"(time: {{end: 1}}
grid: {{factor: 1}}
fluid:
  grid: {{x: [-2, 2], y: [-2, 2], spacing: h}}
  body_fitted: [{{name: disk, shape: {{kind: circle, radius: 0.5}}{}}}]
  boundary: {{left: slip_wall, right: slip_wall, bottom: slip_wall, top: slip_wall}}
{}
)",
                     fitted,
                     fmt::format(fmt::runtime(more), fmt::format("{{rho: \"{}\", v: [0, 0], p: 1}}", rho)));
}

/// Flows around a body are often singular in it, where the solver takes no value.
TEST(GivenGas, IsLookedAtWhereTheGasIs) {
  const std::string initial = "  initial: {}";
  const std::string reference =
      "  initial: {{rho: 1, v: [0, 0], p: 1}}\nreference: {{kind: expressions, fluid: {}}}";
  const std::string both = "  initial: reference\nreference: {{kind: expressions, fluid: {}}}";
  for (const std::string& given : {initial, reference, both}) {
    EXPECT_EQ(mistake_in(disk_case("1 + 1 / r", given)), "");
    EXPECT_EQ(mistake_in(disk_case("1 - r", given, ", inside: true")), "");
    expect_refused(disk_case("1 - r", given), ".rho: is ");
    expect_refused(disk_case("1 / r", given, ", inside: true"), ".rho: is inf at (0, 0), t = 0");
  }
  // Coarser levels are filled everywhere.
  EXPECT_EQ(mistake_in(disk_case("r - 0.4", initial)), "");
  expect_refused(disk_case("r - 0.4", initial), "fluid.initial.rho: is -0.", {"fluid.grid.levels=3"});
  // The source of a chosen solution is taken everywhere.
  const std::string chosen = "  initial: reference\nreference: {{kind: manufactured, fluid: {}}}";
  expect_refused(disk_case("1 + 1 / r", chosen), "reference.fluid.rho: is inf at (0, 0)");
}

TEST(GivenGas, IsNotLookedAtBehindAWall) {
  const auto above = [](const std::string& walls, const std::string& corners, const std::string& rho) {
    return fmt::format(R"(time: {{end: 1}}
grid: {{factor: 1}}
fluid:
  grid: {{x: [-2, 2], y: [-2, 2]}}
  body_fitted: [{{name: wall, shape: {{kind: polygon, radius: 0, walls: {}, corners: {}}}}}]
  boundary: {{left: slip_wall, right: slip_wall, bottom: slip_wall, top: slip_wall}}
  initial: {{rho: {}, v: [0, 0], p: 1}}
)",
                       walls, corners, rho);
  };
  const std::string floor = "[[-2, -1.6], [2, -1.6]]", roof = "[[-2, 1.6], [2, 1.6]]",
                    left = "[[-1.6, -2], [-1.6, 2]]";
  EXPECT_EQ(mistake_in(above("[left, right]", floor, "y + 1.7")), "");
  expect_refused(above("[left, right]", floor, "1.7 - y"), "fluid.initial.rho: ");
  EXPECT_EQ(mistake_in(above("[left, right]", roof, "1.7 - y")), "");
  expect_refused(above("[left, right]", roof, "y + 1.7"), "fluid.initial.rho: ");
  EXPECT_EQ(mistake_in(above("[bottom, top]", left, "x + 1.7")), "");
  expect_refused(above("[bottom, top]", left, "1.7 - x"), "fluid.initial.rho: ");
}

TEST(GivenOnACurve, IsLookedAtForTheWholeRun) {
  const auto on_disk = [](const std::string& rho, const std::string& p) {
    return disk_case(
        "1", "  initial: {}",
        fmt::format(", boundary: {{kind: imposed, state: {{rho: \"{}\", v: [0, 0], p: \"{}\"}}}}", rho, p));
  };
  EXPECT_EQ(mistake_in(on_disk("1 + t + 0.1 * x", "1.1 - t + x^2")), "");
  EXPECT_EQ(mistake_in(on_disk("1 - 3 * (x^2 + y^2 - 0.25)", "1 / r")), "");
  expect_refused(on_disk("1 - 100 * t", "1"), "fluid.body_fitted[0].boundary.state.rho: is -5.2499");
  expect_refused(on_disk("1", "0.4 + x"), "fluid.body_fitted[0].boundary.state.p: is ");
}

TEST(GivenOnACurve, ComesFromAReferenceThatHasIt) {
  const auto disk = [](const std::string& reference) {
    return disk_case("1", "  initial: {}\nreference: " + reference, ", boundary: dirichlet");
  };
  const auto formulas = [&](const std::string& rho) {
    return disk("{{kind: expressions, fluid: {{rho: \"" + rho + "\", v: [0, 0], p: 1}}}}");
  };
  EXPECT_EQ(mistake_in(formulas("1 + 0.5 * t + 1 / r")), "");
  expect_refused(formulas("1 - 1.1 * t"), "fluid.body_fitted[0].boundary: takes its data from `reference`, ");
  expect_refused(disk("{{kind: expressions, u: [0, 0]}}"),
                 "fluid.body_fitted[0].boundary: takes its data from `reference`, which has no `fluid`");
}

std::string moving_gas(const std::string& x, const std::string& left, const std::string& more = "") {
  return fmt::format(R"(time: {{end: 1}}
fluid:
  gamma: 1.4
  grid: {{kind: mapped, map: ["{}", s], points: [21, 21]}}
  boundary: {{left: {}, right: slip_wall, bottom: slip_wall, top: slip_wall}}
  initial: {{rho: 1, v: [0, 0], p: 1}}
{})",
                     x, left, more);
}

TEST(GivenMap, OfAGridThatMovesDoesNotFoldBeforeTheEnd) {
  EXPECT_EQ(mistake_in(moving_gas("r * (1 - 0.9 * t)", "slip_wall")), "");
  expect_refused(moving_gas("r * (1 - 1.1 * t)", "slip_wall"),
                 "fluid.grid: the grid folds at point (0, 0) at t = 0.9375");
}

/// Their formulas need no value where they have been before.
TEST(GivenMap, TakesItsSidesAlong) {
  const std::string behind = "{kind: dirichlet, state: {rho: 1 + 0.9 * (x - 2 * t), v: [2, 0], p: 1}}";
  EXPECT_EQ(mistake_in(moving_gas("r + 2 * t", behind)), "");
  expect_refused(moving_gas("r", behind), "fluid.boundary.left.state.rho: ");
  const std::string reference =
      "reference: {kind: expressions, fluid: {rho: 1 + 0.9 * (x - 2 * t), v: [2, 0], p: 1}}\n";
  EXPECT_EQ(mistake_in(moving_gas("r + 2 * t", "dirichlet", reference)), "");
  expect_refused(moving_gas("r", "dirichlet", reference),
                 "fluid.boundary.left: takes its data from `reference`");
}

/// The message of a case in configs/ with some values set.
std::string mistake(const std::string& name, const std::vector<std::string>& sets) {
  return mistake_in(tests::text_of_file(FSI_ROOT "/configs/" + name), sets);
}

// What the reference has no data for cannot be taken from it.
TEST(GivenReference, HasATractionWhereItHasADisplacement) {
  const std::string message = mistake("elastic_piston.yaml", {"solids.solid.boundary.left=traction"});
  EXPECT_NE(
      message.find(
          "solids.solid.boundary.left: takes its traction from `reference`, and `elastic_piston` has none"),
      std::string::npos)
      << message;
}

TEST(GivenReference, BringsTheVelocityWithTheDisplacement) {
  const auto led = [](const char* velocity) {
    return Solid{.right = fmt::format("{{kind: displacement, value: reference{}}}", velocity),
                 .more = "reference: {kind: manufactured, u: [0.1 * t * (x + 1), 0]}\n"}
        .text();
  };
  EXPECT_EQ(mistake_in(led("")), "");
  expect_refused(led(", velocity: [0.1, 0]"),
                 "solids.s.boundary.right.velocity: has no effect: `reference` brings the velocity with the "
                 "displacement; leave it out");
}

TEST(GivenReference, ThatIsChosenBringsTheForcesThatMakeItTheSolution) {
  EXPECT_EQ(mistake("solid_manufactured.yaml", {}), "");
  const std::string message = mistake("solid_manufactured.yaml", {"solids.solid.body_force=[1, 0]"});
  EXPECT_NE(message.find("solids.solid.body_force: has no effect"), std::string::npos) << message;
}

TEST(GivenReference, WithAPathOfTheInterfaceIsForElasticBodies) {
  const std::string message =
      mistake("manufactured_piston.yaml",
              {"solids.solid={law: rigid, rho: 1, grid: {x: [-1, 0], y: [0, 1], spacing: h}, boundary: "
               "{left: free, right: interface, bottom: slip_wall, top: slip_wall}}"});
  EXPECT_NE(message.find("interface.motion: is the path of elastic bodies"), std::string::npos) << message;
}

/// A disk alone whose outline follows a reference.
std::string led_disk(const std::string& boundary, const std::string& reference) {
  return fmt::format(R"(time: {{end: 0.1}}
grid: {{factor: 2}}
solids:
  disk:
    law: neo_hookean
    rho: 1
    lambda: 1
    mu: 1
    shape: {{kind: circle, radius: 1}}
    body_fitted: {{boundary: {}}}
reference: {}
)",
                     boundary, reference);
}

TEST(GivenOutline, ComesFromAReferenceThatHasIt) {
  EXPECT_EQ(mistake_in(led_disk("displacement", "{kind: manufactured, u: [0.1 * t * x, 0]}")), "");
  expect_refused(led_disk("displacement", "{kind: expressions, fluid: {rho: 1, v: [0, 0], p: 1}}"),
                 "solids.disk.body_fitted.boundary: takes its data from `reference`, which has no `u`");
  expect_refused(
      led_disk("{kind: traction, value: reference}", "{kind: elastic_piston, density_ratio: 1, c_p: 1}"),
      "solids.disk.body_fitted.boundary: takes its traction from `reference`, and `elastic_piston` "
      "has none");
  expect_refused(
      led_disk("displacement", "{kind: expressions, u: [sqrt(x + 0.99), 0]}"),
      "solids.disk.body_fitted.boundary: takes its data from `reference`, whose displacement is not "
      "finite at (-");
}

}  // namespace
}  // namespace fsi
