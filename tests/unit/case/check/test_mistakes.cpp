#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::mistake_in;

/// A case that is right: one gas, one solid.
const char* const good = R"(parameters:
  gamma: 1.4
definitions:
  wave: sin(x)
time: {end: 1, cfl: 0.9}
fluid:
  gamma: gamma
  p_e: 1
  grid: {x: [0, 1], y: [0, 1], points: [11, 11]}
  boundary:
    left: {kind: interface, solid: solid}
    right: outflow
    bottom: symmetry
    top: symmetry
  initial: {rho: 1, v: [0, 0], p: 1}
solids:
  solid:
    law: neo_hookean
    rho: 1
    lambda: 1
    mu: 1
    grid: {x: [-1, 0], y: [0, 1], points: [11, 11]}
    boundary:
      left: clamped
      right: interface
      bottom: symmetry
      top: symmetry
output: {times: [0.5]}
expect: {status: completed}
)";

/// One change of the good case and the message it must give.
struct Mistake {
  const char* what;
  const char* from;
  const char* to;
  const char* message;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.what;
}

std::string with_change(const Mistake& mistake) {
  std::string text = good;
  const std::size_t place = text.find(mistake.from);
  if (place == std::string::npos) return "";
  return text.replace(place, std::string(mistake.from).size(), mistake.to);
}

std::string name_of_mistake(const testing::TestParamInfo<Mistake>& tested) {
  return tested.param.what;
}

class CaseMistake : public testing::TestWithParam<Mistake> {};

TEST_P(CaseMistake, IsOneLineWithPlaceAndRemedy) {
  const std::string text = with_change(GetParam());
  ASSERT_FALSE(text.empty()) << "the change does not apply";
  const std::string message = mistake_in(text);
  EXPECT_EQ(message, GetParam().message);
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

const Mistake keys[] = {
    {"UnknownSection", "output:", "outptu:", "case.yaml:28:1: unknown key `outptu`; did you mean `output`?"},
    {"UnknownKey", "cfl: 0.9", "clf: 0.9", "case.yaml:5:16: time: unknown key `clf`; did you mean `cfl`?"},
    {"UnknownKeyNearNothing", "cfl: 0.9", "zzz: 0.9",
     "case.yaml:5:16: time: unknown key `zzz`; one of end, cfl, growth, multirate, robin_order, dt, "
     "join_timeout, peer_timeout, step_timeout"},
    {"KeyOfAnotherKind", "y: [0, 1], points: [11, 11]}\n  boundary",
     "y: [0, 1], points: [11, 11], map: [r, s]}\n  boundary",
     "case.yaml:9:50: fluid.grid: key `map` belongs to kind `mapped`; write `kind: mapped` or leave it out"},
    {"MissingSection", "time: {end: 1, cfl: 0.9}\n", "",
     "case.yaml:1:1: `time` is missing (time and time steps)"},
    {"MissingKey", "    rho: 1\n", "",
     "case.yaml:18:5: solids.solid: `rho` is missing (density of the reference configuration, > 0 but for a "
     "beam that is held [mass/volume])"},
    {"MissingSide", "    right: outflow\n", "",
     "case.yaml:11:5: fluid.boundary: `right` is missing (a side of the gas; a bare word is its kind, with "
     "data from the reference solution)"},
    {"MissingSides", "    right: outflow\n    bottom: symmetry\n    top: symmetry\n", "",
     "case.yaml:11:5: fluid.boundary: `right` is missing (a side of the gas; a bare word is its kind, with "
     "data from the reference solution); `bottom`, `top` too"},
    {"NameThatLeavesTheFolder", "parameters:", "name: ../above\nparameters:",
     "case.yaml:1:7: name: `../above` cannot name files; use letters, digits, _, - and ., these two not "
     "first"},
    {"NameOfAHiddenFile", "parameters:", "name: .hidden\nparameters:",
     "case.yaml:1:7: name: `.hidden` cannot name files; use letters, digits, _, - and ., these two not "
     "first"},
    {"EmptyName", "parameters:", "name: ''\nparameters:",
     "case.yaml:1:7: name: `` cannot name files; use letters, digits, _, - and ., these two not first"},
    {"RepeatedKey", "cfl: 0.9", "end: 2", "case.yaml:5:16: key `end` is there twice, first at 5:8; keep one"},
    {"TwoSolidsOfOneName", "solids:\n", "solids:\n  solid: {law: neo_hookean}\n",
     "case.yaml:18:3: key `solid` is there twice, first at 17:3; keep one"},
};

const Mistake values[] = {
    {"PathOfAnInterfaceThatASolidMoves", "output:", "interface: {motion: [x + t, y]}\noutput:",
     "case.yaml:28:21: interface.motion: goes with `reference: {kind: manufactured, fluid: .., u: ..}` only; "
     "leave it "
     "out: the solid moves it"},
    {"ChosenSolutionsWithoutAPath", "output:", "reference: {kind: manufactured, u: [0, 0]}\noutput:",
     "case.yaml:28:12: reference: kind manufactured for gas and solid needs the path of the interface; write "
     "interface: {motion: [.., ..]}"},
    {"SubstepsOfTheTraditionalScheme", "time: {end: 1, cfl: 0.9}",
     "interface: {projection: traditional}\ntime: {end: 1, multirate: true}",
     "case.yaml:6:27: time.multirate: does not go with `interface.projection: traditional`, whose substeps "
     "would be "
     "closed with the solid's impedance; write false"},
    {"NegativeDensityOfTheSolid", "rho: 1\n", "rho: -1\n",
     "case.yaml:19:10: solids.solid.rho: must be >= 0 [mass/volume], is -1"},
    {"NegativeDensityOfTheGas", "{rho: 1,", "{rho: -1,",
     "case.yaml:15:18: fluid.initial.rho: density must be > 0 [mass/volume], is -1"},
    {"NegativeDensitySomewhere", "{rho: 1,", "{rho: 0.45 - x,",
     "case.yaml:15:18: fluid.initial.rho: is -0.04999999999999999 at (0.5, 0), t = 0; must be > 0"},
    {"NoPressure", "p: 1}", "p: 0}",
     "case.yaml:15:35: fluid.initial.p: pressure (or give T) must be > 0 [pressure], is 0"},
    {"PressureTwice", "p: 1}", "p: 1, T: 1}", "case.yaml:15:12: fluid.initial: give p or T, one of them"},
    {"GammaOfOne", "gamma: 1.4", "gamma: 1", "case.yaml:7:10: fluid.gamma: must be > 1 and <= 10 [-], is 1"},
    {"WordForANumber", "cfl: 0.9", "cfl: fast",
     "case.yaml:5:21: time.cfl: unknown name `fast` at position 1 of `fast`"},
    {"ListForANumber", "cfl: 0.9", "cfl: [1]", "case.yaml:5:21: time.cfl: must be a number, is a list of 1"},
    {"NumberThatVaries", "cfl: 0.9", "cfl: x",
     "case.yaml:5:21: time.cfl: must be a number, but `x` depends on x; use numbers and parameters"},
    {"NumberThatIsInfinite", "cfl: 0.9", "cfl: 1 / 0",
     "case.yaml:5:21: time.cfl: must be a finite number, but `1 / 0` is inf"},
    {"NothingForANumber", "cfl: 0.9", "cfl:", "case.yaml:5:20: time.cfl: must be a number, is nothing"},
    {"FractionOfAPoint", "points: [11, 11]}\n  boundary", "points: [11.5, 11]}\n  boundary",
     "case.yaml:9:41: fluid.grid.points[0]: must be a whole number, is 11.5; round() may help"},
    {"TooFewPoints", "points: [11, 11]}\n  boundary", "points: [3, 11]}\n  boundary",
     "case.yaml:9:41: fluid.grid.points[0]: must be >= 5 and <= 100000 [-], is 3"},
    {"OneNumberForTwo", "x: [0, 1]", "x: 1",
     "case.yaml:9:13: fluid.grid.x: must be a list of 2: [a, b] [length], is `1`"},
    {"CommaInAFormula", "v: [0, 0]", "v: [max(x, y), 0]",
     "case.yaml:15:24: fluid.initial.v: must be a list of 2: [a, b] [velocity], is a list of 3; put a "
     "formula with commas in quotes"},
    {"EndsTheWrongWayRound", "x: [0, 1]", "x: [1, 0]",
     "case.yaml:9:13: fluid.grid.x: the second end must be greater than the first"},
    {"UnknownWord", "bottom: symmetry\n    top", "bottom: symetry\n    top",
     "case.yaml:13:13: fluid.boundary.bottom: unknown word `symetry`; did you mean `symmetry`? (a section of "
     "keys, or one of slip_wall, symmetry, inflow, imposed, "
     "outflow, far_field, dirichlet, periodic)"},
    {"UnknownKind", "kind: interface", "kind: interfaec",
     "case.yaml:11:18: fluid.boundary.left.kind: unknown kind `interfaec`; did you mean `interface`? (one of "
     "interface, slip_wall, symmetry, inflow, imposed, outflow, "
     "far_field, dirichlet, periodic)"},
    {"UnknownLaw", "law: neo_hookean", "law: neohooke",
     "case.yaml:18:10: solids.solid.law: `neohooke` does not exist here; did you mean `neo_hookean`? (one of "
     "linear_elastic, saint_venant_kirchhoff, "
     "neo_hookean, mooney_rivlin, gent, rigid, beam, external)"},
    {"ExternalSolidWithoutAProgram", "law: neo_hookean", "law: external",
     "case.yaml:18:5: solids.solid: law `external` needs `program: NAME`, the program that is the solid"},
    {"ProgramOfALaw", "law: neo_hookean", "law: neo_hookean\n    program: mine",
     "case.yaml:19:14: solids.solid.program: belongs to `law: external`; leave it out"},
    {"DataOfALaw", "law: neo_hookean", "law: neo_hookean\n    data: {stiffness: 3}",
     "case.yaml:19:11: solids.solid.data: belongs to `law: external`; leave it out"},
    {"ModulusLeftOutWithALawOfDeformation", "    mu: 1\n", "",
     "case.yaml:18:5: solids.solid: `mu` is missing; the moduli are `lambda` and `mu`, or `E` and `nu`, or "
     "`c10`, `c01` "
     "and `bulk`"},
    {"NoModuli", "    lambda: 1\n    mu: 1\n", "",
     "case.yaml:18:5: solids.solid: the moduli are missing; write `lambda` and `mu`, or `E` and `nu`, or "
     "`c10`, `c01` "
     "and `bulk`"},
    {"ModuliInTwoForms", "    mu: 1\n", "    mu: 1\n    nu: 0.3\n",
     "case.yaml:22:9: solids.solid: says its moduli twice; write `lambda` and `mu`, or `E` and `nu`, or "
     "`c10`, `c01` "
     "and `bulk`, and leave the others out of the file"},
    {"IncompressibleSolid", "    lambda: 1\n    mu: 1\n", "    E: 1\n    nu: 0.5\n",
     "case.yaml:21:9: solids.solid.nu: must be >= 0 and < 0.5 [-], is 0.5"},
    {"GentWithoutItsLocking", "law: neo_hookean", "law: gent",
     "case.yaml:18:5: solids.solid: law `gent` needs `J_m`, the largest I1 - 3 [-]; on the command line: "
     "--set "
     "solids.solid.J_m=.."},
    {"GentThatLocksTooEarly", "law: neo_hookean", "law: gent\n    J_m: 1.5",
     "case.yaml:19:10: solids.solid.J_m: must be at least 2 mu / lambda = 2, or the energy has no lower "
     "bound"},
    {"MooneyRivlinWithTooMuchOfItsSecondConstant", "law: neo_hookean", "law: mooney_rivlin\n    c01: 0.6",
     "case.yaml:19:10: solids.solid.c01: must be at most mu / 2 = 0.5: mu / 2 is c10 + c01"},
    {"MooneyRivlinWithTooLittleBulk", "law: neo_hookean", "law: mooney_rivlin\n    c01: 0.3",
     "case.yaml:19:10: solids.solid.c01: must be at most lambda / 4 = 0.25, or the energy has no lower "
     "bound; lambda is "
     "bulk - 4/3 (c10 + c01)"},
    {"BulkModulusTooSmall", "    lambda: 1\n    mu: 1\n", "    c10: 1\n    c01: 0.5\n    bulk: 1\n",
     "case.yaml:22:11: solids.solid.bulk: must be at least 4/3 (c10 + c01) = 2, so that lambda is not "
     "negative"},
    {"ExpectedQuantityThatDoesNotExist", "status: completed", "eror.rho: {max: 1}",
     "case.yaml:29:20: expect: summary.json has no `eror.rho` (status, reason, case, t, t_end, steps, dt, "
     "wall_s, participants, errors, errors_missing, interface, counters, noise, disagreement, overlap, "
     "conservation); did "
     "you mean `errors`?"},
    {"ExpectedCounterThatDoesNotExist", "status: completed", "counters.flors: {max: 0}",
     "case.yaml:29:26: expect: summary.json has no `counters.flors` (floors, positive_fluxes, "
     "positive_values, bounded_side_points, vacuum_points, first_order_fallbacks, "
     "first_order_fallbacks_outside_shocks, settled_ghost_points, waveless_side_points, lost_outputs); did "
     "you "
     "mean `floors`?"},
    {"ExpectationThatCannotBeMet", "status: completed", "t: {min: 2, max: 1}",
     "case.yaml:29:10: expect.t: cannot be met: min, 2, is above max, 1"},
    {"ErrorsOfASolidThatTheReferenceLeavesOut", "expect: {status: completed}",
     "reference: {kind: expressions, fluid: {rho: 1, v: [0, 0], p: 1}}\nexpect: {errors.u_bar: {max: 1}}",
     "case.yaml:30:24: expect: `errors.u_bar` is measured for a solid that the `reference` "
     "describes, and the case has none; leave it out"},
    {"ErrorsWithoutAReference", "status: completed", "errors.rho: {max: 1}",
     "case.yaml:29:22: expect: `errors.rho` is measured against a reference solution, and the case has none; "
     "write a `reference`, or leave it out (`fsi converge` compares grids without one)"},
    {"TimeoutWithoutEnd", "cfl: 0.9", "peer_timeout: 1e12",
     "case.yaml:5:30: time.peer_timeout: must be > 0 and <= 1800 [s], is 1000000000000"},
    {"EmptyExpectation", "status: completed", "errors.rho: {}",
     "case.yaml:29:10: expect.errors.rho: expects nothing; write {max: ..}, {min: ..} or a word"},
};

const Mistake formulas[] = {
    {"UnknownNameInAFormula", "{rho: 1,", "{rho: 1 + gama,",
     "case.yaml:15:18: fluid.initial.rho: unknown name `gama` at position 5 of `1 + gama`; did you mean "
     "`gamma`?"},
    {"UnfinishedFormula", "{rho: 1,", "{rho: 1 +,",
     "case.yaml:15:18: fluid.initial.rho: `1 +` ends too early"},
    {"GridParameterInAField", "{rho: 1,", "{rho: 1 + s,",
     "case.yaml:15:18: fluid.initial.rho: `1 + s` uses s, which has no meaning here; it may use x, y, r and "
     "t"},
    {"PlaceInAMap", "{x: [0, 1], y: [0, 1], points: [11, 11]}\n  boundary",
     "{kind: mapped, map: [x, s], points: [11, 11]}\n  boundary",
     "case.yaml:9:30: fluid.grid.map[0]: `x` uses x, which has no meaning here; it may use r, s and t"},
    {"MapThatFolds", "{x: [0, 1], y: [0, 1], points: [11, 11]}\n  boundary",
     "{kind: mapped, map: [r * (1 - r), s], points: [11, 11]}\n  boundary",
     "case.yaml:9:9: fluid.grid: the grid folds at point (5, 0) at t = 0, near (0.25, 0); change `map`"},
    {"LeftHandedMap", "{x: [0, 1], y: [0, 1], points: [11, 11]}\n  boundary",
     "{kind: mapped, map: [-r, s], points: [11, 11]}\n  boundary",
     "case.yaml:9:9: fluid.grid: `map` is left-handed: where r grows to the right, s grows downwards; write "
     "1 - s in "
     "the place of s, so that bottom and top change places, or 1 - r in that of r, so that left and right "
     "do"},
    {"GridOfASolidThatMoves", "{x: [-1, 0], y: [0, 1], points: [11, 11]}",
     "{kind: mapped, map: [r - 1 + t, s], points: [11, 11]}",
     "case.yaml:22:31: solids.solid.grid.map: must not depend on t: the grid of a solid is its reference "
     "configuration"},
    {"GridOfASolidThatIsShaken", "x: [-1, 0], y: [0, 1],", "x: [-1, 0], y: [0, 1], shake: 0.1,",
     "case.yaml:22:42: solids.solid.grid.shake: the grid of a solid lies still; leave it out"},
    {"SeedForTheGridOfASolid", "x: [-1, 0], y: [0, 1],", "x: [-1, 0], y: [0, 1], shake_seed: 3,",
     "case.yaml:22:47: solids.solid.grid.shake_seed: the grid of a solid lies still; leave it out"},
    {"FormulaWithAColon", "wave: sin(x)", "wave: x < 0 ? 1 : 2",
     "case.yaml:4:19: not YAML: illegal map value; put a formula with a colon in quotes"},
    {"FormulaWithAColonInBraces", "x: [-1, 0], y: [0, 1],", "x: [x < 0 ? 1 : 2, 0], y: [0, 1],",
     "case.yaml:22:22: not YAML: end of sequence flow not found; put a formula with a colon in quotes, or "
     "close the bracket"},
    {"DefinitionsInACircle", "wave: sin(x)", "wave: 2 * wave",
     "case.yaml:4:9: definitions.wave: definitions go round in a circle: wave -> wave"},
    {"ParametersInACircle", "gamma: 1.4", "gamma: 1 + b\n  b: 2 * gamma",
     "case.yaml:2:10: parameters.gamma: parameters go round in a circle: gamma -> b -> gamma"},
    {"ParameterThatIsAVariable", "  gamma: 1.4", "  gamma: 1.4\n  x: 2",
     "case.yaml:3:3: parameters: `x` has a meaning of its own in expressions; choose another name"},
    {"ParameterThatIsAFunction", "  gamma: 1.4", "  gamma: 1.4\n  sin: 2",
     "case.yaml:3:3: parameters: `sin` has a meaning of its own in expressions; choose another name"},
    {"ParameterThatIsNoName", "  gamma: 1.4", "  gamma: 1.4\n  2a: 2",
     "case.yaml:3:3: parameters: `2a` is no name; use letters, digits and _, a letter first"},
    {"DefinitionThatIsAParameter", "wave: sin(x)", "gamma: sin(x)",
     "case.yaml:4:3: definitions: `gamma` is a parameter already; choose another name"},
};

const Mistake partners[] = {
    {"InterfaceToNoSolid", "solid: solid}", "solid: soild}",
     "case.yaml:11:36: fluid.boundary.left: there is no solid `soild`; did you mean `solid`?"},
    {"InterfaceWithoutAPartner", "left: {kind: interface, solid: solid}", "left: outflow",
     "case.yaml:25:14: solids.solid.boundary.right: the interface has no partner; write {kind: interface, "
     "solid: solid} on a side of fluid.boundary"},
    {"SolidWithoutAnInterface", "right: interface", "right: clamped",
     "case.yaml:24:7: solids.solid.boundary: no side is an interface, yet the case has a gas; write "
     "`interface` on the side that meets it"},
    {"TwoInterfacesOfASolid", "left: clamped", "left: interface",
     "case.yaml:25:14: solids.solid.boundary: two sides are interfaces; a solid meets the gas along one, or "
     "all "
     "around its `shape`"},
    {"SidesThatDoNotMeet", "x: [-1, 0]", "x: [-1, 0.01]",
     "case.yaml:11:11: fluid.boundary.left: its point at (0, 0) does not meet the right side of solid "
     "`solid`, "
     "nearest at (0.01, 0); let both grids have the same curve there"},
    {"OnePeriodicSide", "    right: outflow", "    right: periodic",
     "case.yaml:11:5: fluid.boundary: right is periodic and left is not; write both"},
    {"DataFromNoReference", "right: outflow", "right: dirichlet",
     "case.yaml:12:12: fluid.boundary.right: takes its data from `reference`, but the case has no reference "
     "solution; write {kind: dirichlet, state: {rho: 1, v: [0, 0], p: 1}} for the gas that is there at the "
     "start"},
    {"SolidThatStartsFromAReferenceWithoutIt", "      top: symmetry\noutput:",
     "      top: symmetry\n    initial: reference\nreference: {kind: expressions, fluid: {rho: 1, v: [0, 0], "
     "p: "
     "1}}\noutput:",
     "case.yaml:28:14: solids.solid.initial: takes its data from `reference`, which has no `u`; add it "
     "there, or "
     "give the state here"},
    {"GasThatStartsFromAReferenceWithoutIt", "initial: {rho: 1, v: [0, 0], p: 1}\n",
     "initial: reference\nreference: {kind: expressions, u: [0, 0]}\n",
     "case.yaml:15:12: fluid.initial: takes its data from `reference`, which has no `fluid`; add it there, "
     "or "
     "give the state here"},
    {"SolidInAShockTube", "output:",
     "reference: {kind: riemann, x_0: 0, rho_left: 1, v_left: 0, p_left: 1, rho_right: 1, v_right: 0, "
     "p_right: "
     "1}\noutput:",
     "case.yaml:28:19: reference: `riemann` is a solution for a gas alone; leave it out"},
    {"ProbeNowhere", "times: [0.5]", "probes: [{name: a, in: fluidd, x: 0, y: 0}]",
     "case.yaml:28:33: output.probes[0].in: `fluidd` is neither `fluid` nor a solid; did you mean `fluid`?"},
    {"TwoProbesOfOneName", "times: [0.5]",
     "probes: [{name: a, in: fluid, x: 0, y: 0}, {name: a, in: solid, x: 0, y: 0}]",
     "case.yaml:28:60: output.probes[1].name: there are two probes `a`; choose another name"},
    {"SolidNamedLikeAProgram", "\n  solid:\n", "\n  coupler:\n",
     "case.yaml:17:3: solids: `coupler` is the name of another program; choose another"},
};

INSTANTIATE_TEST_SUITE_P(Keys, CaseMistake, testing::ValuesIn(keys), name_of_mistake);
INSTANTIATE_TEST_SUITE_P(Values, CaseMistake, testing::ValuesIn(values), name_of_mistake);
INSTANTIATE_TEST_SUITE_P(Formulas, CaseMistake, testing::ValuesIn(formulas), name_of_mistake);
INSTANTIATE_TEST_SUITE_P(Partners, CaseMistake, testing::ValuesIn(partners), name_of_mistake);

TEST(CaseMistakeOfTwo, AProbeInAProgramOfSomebodyElses) {
  std::string text = with_change({"", "law: neo_hookean", "law: external\n    program: mine", ""});
  const std::string times = "times: [0.5]";
  text.replace(text.find(times), times.size(),
               "probes: [{name: a, in: fluid, x: 0.5, y: 0}, {name: b, in: solid, x: 0, y: 0}]");
  EXPECT_EQ(mistake_in(text),
            "case.yaml:29:69: output.probes[1].in: `solid` is a program of its own (`law: external`), and "
            "what is inside "
            "only it knows; put the probe into a gas, or leave it out");
}

TEST(GoodCase, HasNoMistake) {
  EXPECT_EQ(mistake_in(good), "");
}

TEST(DegenerateFile, IsAMistakeThatSaysWhereToBegin) {
  EXPECT_EQ(mistake_in(""), "case.yaml:1:1: the file is empty; begin with configs/template.yaml");
  EXPECT_EQ(
      mistake_in("- a\n- b\n"),
      "case.yaml:1:1: a case is a section of keys, this is a list of 2; begin with configs/template.yaml");
  EXPECT_EQ(mistake_in("hello"),
            "case.yaml:1:1: a case is a section of keys, this is `hello`; begin with configs/template.yaml");
  EXPECT_EQ(mistake_in("time: {end: 1}\n"),
            "case.yaml:1:1: the case has neither `fluid` nor `solids`; write at least one");
  EXPECT_EQ(mistake_in("time:\n\tend: 1\n"), "case.yaml:2:1: a tab in the indentation; write spaces");
  for (const char* text :
       {"&a [*a]", "{", "}", ":", "\xff\xfe\x01", "a: b: c", "%YAML 9", "--- !!map", "? ", "\"", "'"}) {
    EXPECT_NE(mistake_in(text), "") << text;
  }
}

}  // namespace
}  // namespace fsi
