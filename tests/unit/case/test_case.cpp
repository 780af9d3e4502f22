#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/case/report/summary.hpp"
#include "common/core/failure.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::config_paths;
using tests::load_text;
using tests::TemporaryFolder;

const BoundarySpec& side_of(const std::array<BoundarySpec, 4>& boundary, Side side) {
  return boundary[static_cast<std::size_t>(side)];
}

TEST(ConfigFolder, HoldsOnlyCasesThatLoad) {
  EXPECT_GE(config_paths().size(), 10U);
  for (const std::string& path : config_paths()) {
    EXPECT_NO_THROW({
      const Case problem = load_case(path);
      EXPECT_FALSE(problem.title.empty()) << path;
      EXPECT_FALSE(problem.expect.empty()) << path;
    }) << path;
  }
}

TEST(ResolvedCase, LoadsToTheSameCase) {
  const TemporaryFolder folder;
  for (const std::string& path : config_paths()) {
    const Case first = load_case(path, {"grid.factor=3", "time.cfl=0.1+0.2"});
    const Case second = load_case(folder.write("case.yaml", first.resolved));
    EXPECT_EQ(second.resolved, first.resolved) << path;
    EXPECT_EQ(second.digest, first.digest);
    EXPECT_EQ(second.name, first.name);
    EXPECT_EQ(second.parameters, first.parameters);
    EXPECT_EQ(second.grid_factor, 3);
    EXPECT_EQ(second.time.cfl, first.time.cfl);
    EXPECT_EQ(second.output.times, first.output.times);
    EXPECT_EQ(second.reference.numbers, first.reference.numbers);
    ASSERT_EQ(second.solids.size(), first.solids.size());
    for (std::size_t k = 0; k < first.solids.size(); ++k) {
      EXPECT_EQ(second.solids[k].mu, first.solids[k].mu);
      EXPECT_EQ(second.solids[k].grid.n1, first.solids[k].grid.n1);
    }
  }
}

TEST(Digest, ChangesWithEveryOverride) {
  const std::string path = FSI_ROOT "/configs/elastic_piston.yaml";
  const std::string plain = load_case(path).digest;
  EXPECT_EQ(plain.size(), 16U);
  EXPECT_EQ(load_case(path).digest, plain);
  EXPECT_NE(load_case(path, {"parameters.density_ratio=2"}).digest, plain);
  EXPECT_NE(load_case(path, {}, {"solid=neo_hookean"}).digest, plain);
}

TEST(ElasticPiston, HasTheDataOfItsParameters) {
  const Case problem = load_case(FSI_ROOT "/configs/elastic_piston.yaml",
                                 {"parameters.density_ratio=0.01", "parameters.c_p=8", "grid.factor=8"});
  EXPECT_EQ(problem.name, "elastic_piston");
  ASSERT_TRUE(problem.fluids.size() == 1);
  ASSERT_EQ(problem.solids.size(), 1U);
  const SolidSpec& solid = problem.solids.front();
  EXPECT_EQ(solid.name, "solid");
  EXPECT_EQ(solid.law, "linear_elastic");
  EXPECT_DOUBLE_EQ(solid.rho, 0.01);
  EXPECT_DOUBLE_EQ((solid.lambda + 2 * solid.mu) / solid.rho, 64);  // c_p^2
  EXPECT_DOUBLE_EQ(problem.fluids.front().p_e * problem.fluids.front().gamma, 1);
  EXPECT_EQ(problem.fluids.front().grid.n1, 121);
  EXPECT_EQ(problem.fluids.front().grid.n2, 81);
  EXPECT_EQ(solid.grid.n1, 81);
  EXPECT_TRUE(problem.fluids.front().initial_from_reference);
  EXPECT_EQ(side_of(problem.fluids.front().boundary, Side::left).kind, BoundaryKind::interface);
  EXPECT_EQ(side_of(problem.fluids.front().boundary, Side::left).solid, "solid");
  EXPECT_TRUE(side_of(problem.fluids.front().boundary, Side::right).from_reference);
  EXPECT_EQ(side_of(solid.boundary, Side::right).kind, BoundaryKind::interface);
  EXPECT_EQ(solid.scheme.limiter, SolidLimiter::none);
  EXPECT_DOUBLE_EQ(solid.scheme.relaxation.rate, 0.5);
  EXPECT_EQ(problem.reference.kind, ReferenceKind::elastic_piston);
  EXPECT_DOUBLE_EQ(problem.reference.numbers.at("density_ratio"), 0.01);
}

TEST(ElasticPiston, TurnsAsAWhole) {
  const Case problem = load_case(FSI_ROOT "/configs/elastic_piston.yaml", {"parameters.angle=30"});
  EXPECT_DOUBLE_EQ(problem.fluids.front().grid.rotation, std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(problem.solids.front().grid.rotation, std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(problem.reference.numbers.at("rotation"), std::numbers::pi / 6);
}

TEST(GasState, TakesTInPlaceOfP) {
  const std::string text = R"(
time: {end: 1}
fluid:
  grid: {x: [0, 1], y: [0, 1], points: [5, 5]}
  boundary: {left: outflow, right: outflow, bottom: symmetry, top: symmetry}
  initial: {rho: 1 + x, v: [y, t], T: 2 + y}
)";
  const Case problem = load_text(text);
  EXPECT_DOUBLE_EQ(problem.fluids.front().initial->p(1, 0.5, 0), 5);
  EXPECT_DOUBLE_EQ(problem.fluids.front().initial->v1(1, 0.5, 0), 0.5);
}

TEST(MappedGrid, MovesWhereItsMapDependsOnTime) {
  EXPECT_TRUE(load_case(FSI_ROOT "/configs/isentropic_vortex.yaml").fluids.front().grid.moving);
  EXPECT_FALSE(load_case(FSI_ROOT "/configs/solid_manufactured.yaml").solids.front().grid.moving);
}

TEST(PeriodicSides, MakeTheGridPeriodic) {
  const std::string text = R"(
time: {end: 1}
fluid:
  grid: {x: [0, 1], y: [0, 1], points: [5, 5]}
  boundary: {left: periodic, right: periodic, bottom: symmetry, top: symmetry}
  initial: {rho: 1, v: [0, 0], p: 1}
)";
  const Case problem = load_text(text);
  EXPECT_TRUE(problem.fluids.front().grid.periodic[0]);
  EXPECT_FALSE(problem.fluids.front().grid.periodic[1]);
}

TEST(SolidSides, MayBeFreeOrClampedInOneWord) {
  const Case problem =
      load_case(FSI_ROOT "/configs/spinning_block.yaml", {"solids.block.boundary.left=clamped"});
  const auto& boundary = problem.solids.front().boundary;
  EXPECT_EQ(side_of(boundary, Side::left).kind, BoundaryKind::displacement);
  EXPECT_EQ(side_of(boundary, Side::right).kind, BoundaryKind::traction);
  EXPECT_EQ(side_of(boundary, Side::right).vector->c1(1, 2, 3), 0);
}

TEST(OutputTimes, AreSortedAndHoldTheMultiples) {
  const Case problem =
      load_case(FSI_ROOT "/configs/sod_tube.yaml", {"output.times=[0.15, 0.05]", "output.every=0.1"});
  ASSERT_EQ(problem.output.times.size(), 5U);
  EXPECT_DOUBLE_EQ(problem.output.times[0], 0);
  EXPECT_DOUBLE_EQ(problem.output.times[1], 0.05);
  EXPECT_DOUBLE_EQ(problem.output.times[4], 0.2);
}

TEST(OutputTimes, AreTheEndWhereNothingIsSaid) {
  const Case problem = load_case(FSI_ROOT "/configs/sod_tube.yaml");
  EXPECT_EQ(problem.output.times, std::vector<double>{problem.time.end});
}

TEST(OutputTimes, AfterTheEndAreLeftOut) {
  const std::string path = FSI_ROOT "/configs/sod_tube.yaml";
  const Case shorter = load_case(path, {"time.end=0.1", "output={times: [0.05, 0.15]}"});
  EXPECT_EQ(shorter.output.times, std::vector<double>{0.05});
  EXPECT_NE(summary_line(shorter).find("output.times: no output at 0.15, after time.end = 0.1"),
            std::string::npos)
      << summary_line(shorter);
  EXPECT_EQ(summary_line(load_case(path, {"output={times: [0.05, 0.15]}"})).find("no output"),
            std::string::npos);
  const Case none_left = load_case(path, {"time.end=0.1", "output={times: [0.15]}"});
  EXPECT_EQ(none_left.output.times, std::vector<double>{0.1});
}

TEST(Reference, OfABodyThatHasNoErrorsIsSaidToBeLeftOut) {
  const std::string path = FSI_ROOT "/configs/moving_together_disk.yaml";
  EXPECT_EQ(summary_line(load_case(path)).find("reference.u"), std::string::npos);
  const std::string rigid = summary_line(load_case(path, {}, {"disk=rigid"}));
  EXPECT_NE(rigid.find("reference.u: no errors by it"), std::string::npos) << rigid;
}

TEST(Parameters, MayUseEachOtherInAnyOrderAndTheResolution) {
  const std::string text = R"(
parameters: {a: 2 * b, b: c + 1, c: 1 / h}
grid: {factor: 2}
time: {end: a}
fluid:
  grid: {x: [0, 1], y: [0, 1], points: [5, 5]}
  boundary: {left: outflow, right: outflow, bottom: symmetry, top: symmetry}
  initial: {rho: 1, v: [0, 0], p: 1}
)";
  EXPECT_DOUBLE_EQ(load_text(text).time.end, 42);
}

TEST(CaseLookup, TakesAPathOrAName) {
  EXPECT_EQ(find_case("sod_tube", {FSI_ROOT "/configs"}), FSI_ROOT "/configs/sod_tube.yaml");
  EXPECT_EQ(find_case(FSI_ROOT "/configs/sod_tube.yaml", {}), FSI_ROOT "/configs/sod_tube.yaml");
  EXPECT_EQ(load_case("sod_tube").name, "sod_tube");
}

TEST(CaseLookup, NamesTheNearestCaseWhenThereIsNone) {
  try {
    find_case("sod_tub", {FSI_ROOT "/configs"});
    FAIL();
  } catch (const UserMistake& mistake) {
    EXPECT_STREQ(mistake.what(), "`sod_tub`: no such case; did you mean `sod_tube`?");
  }
  EXPECT_THROW(find_case("there/is/nothing.yaml", {FSI_ROOT "/configs"}), UserMistake);
}

TEST(Summary, NamesParametersThatNothingNeeds) {
  const Case problem =
      load_case("sod_tube", {"parameters={gamma: 1.4, x_0: 0.01 * mine, mine: 50, other: 3 * mine, "
                             "lonely: lonely_2, lonely_2: 1}"});
  EXPECT_EQ(problem.unused, (std::vector<std::string>{"other", "lonely"}));
  EXPECT_EQ(nlohmann::json::parse(summary_as_json(problem))["unused"], nlohmann::json({"other", "lonely"}));
  EXPECT_TRUE(load_case("shock_ellipse").unused.empty());
}

// At Mach 1.3, p / p_0 - 1 = 7/6 (M^2 - 1), rho v^2 = rho_1 v_1^2 of Rankine and Hugoniot; lambda + 2 mu = 3 stiffness.
TEST(Summary, HasTheFormulasOfParametersThatOthersGive) {
  const Case problem =
      load_case("sod_tube", {"parameters={gamma: 1.4, x_0: 0.5 * other, other: 1 + 2, half: 'other / 2'}"});
  EXPECT_EQ(problem.parameters.at("x_0"), 1.5);
  EXPECT_EQ(nlohmann::json::parse(summary_as_json(problem))["formulas"],
            nlohmann::json({{"x_0", "0.5 * other"}, {"half", "other / 2"}}));
  EXPECT_TRUE(load_text(problem.resolved).formulas.empty());
}

TEST(Summary, TellsTheLauncherWhichProgramsRun) {
  const auto coupled =
      nlohmann::json::parse(summary_as_json(load_case("elastic_piston", {}, {"solid=neo_hookean"})));
  EXPECT_TRUE(coupled["coupled"].get<bool>());
  ASSERT_EQ(coupled["participants"].size(), 3U);
  EXPECT_EQ(coupled["participants"][0]["executable"], "fluid_solver");
  EXPECT_EQ(coupled["participants"][1]["name"], "solid");
  EXPECT_EQ(coupled["participants"][1]["executable"], "solid_solver_neo_hookean");
  EXPECT_EQ(coupled["participants"][2]["role"], "coupler");
  EXPECT_EQ(coupled["time"]["end"], 0.8);
  EXPECT_EQ(coupled["reference"]["kind"], "elastic_piston");
  const auto alone = nlohmann::json::parse(summary_as_json(load_case("spinning_block")));
  EXPECT_FALSE(alone["coupled"].get<bool>());
  EXPECT_EQ(alone["participants"].size(), 1U);
}

TEST(CaseList, GivesTheTitleOrTheMistakeOfEveryFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("good.yaml", "title: A good one\n");
  folder.write("bad.yaml", "title: [\n");
  const auto cases = list_cases(std::filesystem::path(path).parent_path().string());
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[1].second, "A good one");
  EXPECT_NE(cases[0].second.find("bad.yaml:"), std::string::npos);
}

TEST(CaseName, IsThatOfTheFileWithWhatFilesOfResultsMayBeCalled) {
  const tests::TemporaryFolder folder;
  const std::string text =
      "time: {end: 1}\nfluid:\n  grid: {x: [0, 1], y: [0, 1], points: [5, 5]}\n"
      "  boundary: {left: outflow, right: outflow, bottom: symmetry, top: symmetry}\n"
      "  initial: {rho: 1, v: [0, 0], p: 1}\n";
  EXPECT_EQ(load_case(folder.write("beam-2.5_a.yaml", text)).name, "beam-2.5_a");
  EXPECT_EQ(load_case(folder.write(".my beam.yaml", text)).name, "_my_beam");
}

}  // namespace
}  // namespace fsi
