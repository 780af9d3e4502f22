/// Cases with several gases.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/case/report/cost.hpp"
#include "common/case/report/summary.hpp"
#include "common/core/failure.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::load_text;
using tests::mistake_in;

/// A piston between two gases.
const std::string good_pair = R"(time: {end: 1, cfl: 0.9}
fluids:
  left:
    p_e: 1
    grid: {x: [-1, 0], y: [0, 1], points: [11, 11]}
    boundary:
      left: outflow
      right: {kind: interface, solid: piston}
      bottom: symmetry
      top: symmetry
    initial: {rho: 1, v: [0, 0], p: 1}
  right:
    gamma: 1.6
    p_e: 1
    grid: {x: [1, 2], y: [0, 1], points: [11, 11]}
    boundary:
      left: {kind: interface, solid: piston}
      right: outflow
      bottom: symmetry
      top: symmetry
    initial: {rho: 3, v: [0, 0], p: 1}
solids:
  piston:
    law: neo_hookean
    rho: 1
    lambda: 1
    mu: 1
    grid: {x: [0, 1], y: [0, 1], points: [11, 11]}
    boundary:
      left: {kind: interface, fluid: left}
      right: {kind: interface, fluid: right}
      bottom: symmetry
      top: symmetry
output: {probes: [{name: a, in: right, x: 1.5, y: 0.5}]}
expect: {conservation.left.mass: {max: 1}}
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = good_pair;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

TEST(Fluids, EachHasItsOwnStateAndAProgramOfItsOwn) {
  const Case problem = load_text(good_pair);
  ASSERT_EQ(problem.fluids.size(), 2U);
  EXPECT_EQ(problem.fluids[0].name, "left");
  EXPECT_EQ(problem.fluids[1].name, "right");
  EXPECT_EQ(problem.fluids[1].gamma, 1.6);
  EXPECT_EQ(problem.fluids[1].grid.x_b, 2);
  EXPECT_EQ(fields_name(problem.fluids[1]), "fluid_right");
  const std::vector<ParticipantSummary> programs = participants_of(problem);
  ASSERT_EQ(programs.size(), 4U);
  EXPECT_EQ(programs[0].name, "left");
  EXPECT_EQ(programs[0].role, "fluid");
  EXPECT_EQ(programs[0].executable, "fluid_solver");
  EXPECT_EQ(programs[1].name, "right");
  EXPECT_EQ(programs[3].name, "coupler");
}

TEST(Fluids, ASolidBetweenTwoOfThemHasAnInterfaceWithEach) {
  const SolidSpec piston = load_text(good_pair).solids.front();
  EXPECT_EQ(gases_at(piston), (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(interface_name(piston, "left"), "piston.left");
  EXPECT_EQ(side_to(piston, "left"), Side::left);
  EXPECT_EQ(side_to(piston, "right"), Side::right);
}

TEST(Fluids, TheOneGasOfACaseHasTheNamesItAlwaysHad) {
  for (const std::string& path : tests::config_paths()) {
    const Case problem = load_case(path);
    if (problem.fluids.size() != 1) continue;
    EXPECT_EQ(problem.fluids.front().name, "fluid");
    EXPECT_EQ(fields_name(problem.fluids.front()), "fluid");
    for (const SolidSpec& solid : problem.solids) {
      EXPECT_EQ(gases_at(solid), std::vector<std::string>{"fluid"}) << path;
      EXPECT_EQ(interface_name(solid, "fluid"), solid.name) << path;
    }
  }
}

TEST(Fluids, WithSubstepsTheFasterGasSetsTheStep) {
  const RunCost cost = cost_of(load_text(good_pair, {"time.multirate=true"}));
  ASSERT_EQ(cost.programs.size(), 3U);
  EXPECT_LT(cost.programs[0].dt, cost.programs[1].dt);  // a = 1.18 and 0.73
  EXPECT_EQ(cost.dt, cost.programs[0].dt);
}

TEST(Fluids, MistakesSayWhereAndWhatToWrite) {
  EXPECT_EQ(mistake_in(good_pair), "");
  EXPECT_EQ(mistake_in(with("left: {kind: interface, fluid: left}", "left: interface")),
            "case.yaml:24:5: solids.piston: the gases left and right meet it; write {kind: interface, fluid: "
            "NAME} at "
            "each of its interfaces");
  EXPECT_EQ(mistake_in(with("fluid: right}", "fluid: rigth}")),
            "case.yaml:31:39: solids.piston.boundary.right: there is no gas `rigth`; did you mean `right`?");
  EXPECT_EQ(
      mistake_in(with("right: {kind: interface, fluid: right}", "right: free")),
      "case.yaml:30:7: solids.piston.boundary: no side is the interface to `right`, which meets this solid; "
      "write {kind: interface, fluid: right} on one");
  EXPECT_EQ(mistake_in(with("fluid: right}", "fluid: left}")),
            "case.yaml:31:14: solids.piston.boundary: two sides are interfaces to `left`; a solid meets each "
            "gas along one");
  EXPECT_EQ(mistake_in(with("gamma: 1.6\n    p_e: 1", "gamma: 1.6\n    p_e: 2")),
            "case.yaml:30:7: solids.piston.boundary: p_e, at which the solid is free of stress, is 1 in "
            "fluids.left and "
            "2 in fluids.right; write the same in both (either may begin at another pressure)");
  EXPECT_EQ(mistake_in(with("  right:\n    gamma", "  piston:\n    gamma")),
            "case.yaml:23:3: solids: `piston` is the name of another program; choose another");
  EXPECT_EQ(mistake_in(with("  left:\n    p_e", "  coupler:\n    p_e")),
            "case.yaml:3:3: fluids: `coupler` is the name of another program; choose another");
  EXPECT_EQ(mistake_in(with("in: right", "in: fluid")),
            "case.yaml:34:33: output.probes[0].in: `fluid` is neither one of `fluids` nor a solid");
  EXPECT_EQ(mistake_in(with("x: [1, 2], y", "x: [1.1, 2], y")),
            "case.yaml:17:13: fluids.right.boundary.left: its point at (1.1, 0) does not meet the right side "
            "of solid "
            "`piston`, nearest at (1, 0); let both grids have the same curve there");
}

/// A round body in the gas to the right of the piston.
std::string with_body(const std::string& more_at_left = "") {
  std::string text = with("  right:\n    gamma: 1.6\n    p_e: 1\n    grid: {x: [1, 2]", R"(  right:
    gamma: 1.6
    p_e: 1
    body_fitted:
      - {name: at_piston, solid: piston, walls: [bottom, top], lines: 5}
      - {name: around, solid: body, lines: 5}
    grid: {x: [0.8, 3])");
  const auto put = [&](const std::string& from, const std::string& to) {
    text.replace(text.rfind(from), from.size(), to);
  };
  put("left: {kind: interface, solid: piston}", "left: slip_wall");
  put("points: [11, 11]}\n    boundary:\n      left: slip_wall",
      "points: [45, 21]}\n    boundary:\n      left: slip_wall");
  text.replace(text.find("    initial"), 0, more_at_left);
  return text.insert(text.find("output:"),
                     "  body:\n    law: rigid\n    rho: 2\n    shape: {kind: ellipse, centre: [2.2, 0.5], "
                     "semi_axes: [0.25, 0.2], points: 32}\n");
}

TEST(Fluids, ABodyWithAnOutlineLiesInOneOfThem) {
  EXPECT_EQ(mistake_in(with_body()), "");
  const Case problem = load_text(with_body());
  EXPECT_EQ(gases_at(problem.solids[1]), std::vector<std::string>{"right"});
  EXPECT_EQ(interface_name(problem.solids[1], "right"), "body");
}

TEST(Fluids, AnOutlineBetweenTwoOfThemIsRefused) {
  EXPECT_EQ(
      mistake_in(with_body("    body_fitted: [{name: there_too, solid: body}]\n")),
      "case.yaml:41:12: solids.body.shape: the gases left and right have a grid along it; an outline meets "
      "one gas: leave it to the one in which it lies, or, for a solid between gases, write in the place of "
      "`shape` a `grid` with an interface side for each of them");
}

TEST(Fluids, ABackgroundWithGridsOnItDoesNotFollowASolid) {
  std::string text = with_body();
  text.replace(
      text.find("      - {name: at_piston"),
      std::string("      - {name: at_piston, solid: piston, walls: [bottom, top], lines: 5}\n").size(), "");
  text.replace(text.find("left: slip_wall"), std::string("left: slip_wall").size(),
               "left: {kind: interface, solid: piston}");
  text.replace(text.find("x: [0.8, 3]"), std::string("x: [0.8, 3]").size(), "x: [1, 3]");
  EXPECT_EQ(
      mistake_in(text),
      "case.yaml:19:13: fluids.right.boundary.left: moves with `piston` and the whole grid with it, but the "
      "background of the grids in `body_fitted` stays; write slip_wall here, {name: at_piston, solid: "
      "piston, walls: [bottom, top]} into `body_fitted`, and let `grid` begin behind the interface");
}

TEST(Fluids, ARunInOneDimensionKnowsOneGas) {
  EXPECT_EQ(
      mistake_in(with("expect:", "reference: {kind: piston_1d}\nexpect:")),
      "case.yaml:35:19: reference.kind: `piston_1d` is computed with one gas and one solid; leave it out");
}

TEST(Fluids, AGasThatMeetsNoSolidIsRefused) {
  const std::string alone = R"(  far:
    grid: {x: [5, 6], y: [0, 1], points: [11, 11]}
    boundary: {left: outflow, right: outflow, bottom: symmetry, top: symmetry}
    initial: {rho: 3, v: [0, 0], p: 1}
solids:
)";
  EXPECT_EQ(
      mistake_in(with("solids:\n", alone)),
      "case.yaml:23:5: fluids.far: meets no solid, so that nothing connects it with the other gases; write a "
      "case of its own");
}

TEST(Fluids, TheOldSectionDoesNotGoWithTheNewOne) {
  const std::string one =
      "fluid:\n  grid: {x: [5, 6], y: [0, 1], points: [11, 11]}\n  boundary: {left: outflow, right: "
      "outflow, bottom: symmetry, top: symmetry}\n  initial: {rho: 3, v: [0, 0], p: 1}\nfluids:\n";
  EXPECT_EQ(mistake_in(with("fluids:\n", one)),
            "case.yaml:7:3: fluids: goes in the place of `fluid`; write all gases here");
}

TEST(BeamsOfNoMass, AreThereWhereAnEndIsHeld) {
  const std::string path = configs_folder() + "/taylor_plate.yaml";
  EXPECT_EQ(load_case(path, {"parameters.mass=0"}).solids.front().rho, 0);
  EXPECT_NO_THROW(load_case(path, {"parameters.mass=0", "solids.plate.beam.ends=[free, guided]"}));
  EXPECT_THROW(load_case(path, {"parameters.mass=0", "solids.plate.beam.ends=[free, free]"}), UserMistake);
  EXPECT_THROW(load_case(path, {"parameters.mass=-1"}), UserMistake);
  EXPECT_THROW(load_case(configs_folder() + "/elastic_piston.yaml", {"solids.solid.rho=0"}), UserMistake);
}

}  // namespace
}  // namespace fsi
