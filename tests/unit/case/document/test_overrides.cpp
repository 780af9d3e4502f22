#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/failure.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

const char* const piston = FSI_ROOT "/configs/elastic_piston.yaml";

std::string overriding_mistake(const std::vector<std::string>& overrides,
                               const std::vector<std::string>& laws = {}) {
  try {
    load_case(piston, overrides, laws);
    return "";
  } catch (const UserMistake& mistake) {
    return mistake.what();
  }
}

TEST(Override, ReplacesAnyKeyOfTheFile) {
  const Case problem =
      load_case(piston, {"time.end=.2", "parameters.density_ratio=0.1", "solids.solid.law=neo_hookean",
                         "grid.factor=2*2", "interface.projection=full", "time.multirate=true",
                         "fluid.gamma=5/3", "expect.errors.rho.max=1", "expect.interface.max_gap.max=2",
                         "output.times=[0.1, 0.2]", "output.probes=[{name: a, in: fluid, x: 1, y: 0.5}]"});
  EXPECT_DOUBLE_EQ(problem.time.end, 0.2);
  EXPECT_DOUBLE_EQ(problem.solids.front().rho, 0.1);
  EXPECT_EQ(problem.solids.front().law, "neo_hookean");
  EXPECT_DOUBLE_EQ(problem.grid_factor, 4);
  EXPECT_EQ(problem.interface.projection, Projection::full);
  EXPECT_TRUE(problem.time.multirate);
  EXPECT_DOUBLE_EQ(problem.fluids.front().gamma, 5.0 / 3);
  EXPECT_EQ(problem.output.times.size(), 2U);
  EXPECT_EQ(problem.output.probes.front().name, "a");
  for (const Expectation& entry : problem.expect) {
    if (entry.quantity == "errors.rho") {
      EXPECT_DOUBLE_EQ(*entry.max, 1);
    }
    if (entry.quantity == "interface.max_gap") {
      EXPECT_DOUBLE_EQ(*entry.max, 2);
    }
  }
}

TEST(Override, OfTheSameKeyWinsWhenItComesLater) {
  EXPECT_DOUBLE_EQ(load_case(piston, {"time.end=0.5", "output.times=[0.1]", "time.end=0.3"}).time.end, 0.3);
}

TEST(Override, OfALawByName) {
  EXPECT_EQ(load_case(piston, {}, {"solid=saint_venant_kirchhoff"}).solids.front().law,
            "saint_venant_kirchhoff");
}

TEST(OverrideMistake, NamesTheOptionAndWhatToWrite) {
  EXPECT_EQ(overriding_mistake({"time.ende=3"}), "--set time.ende: unknown key `ende`; did you mean `end`?");
  EXPECT_EQ(overriding_mistake({"tiem.end=3"}), "--set tiem.end: unknown key `tiem`; did you mean `time`?");
  EXPECT_EQ(overriding_mistake({"parameters.densty_ratio=3"}),
            "--set parameters.densty_ratio: the case has no `densty_ratio` in `parameters`; "
            "did you mean `density_ratio`?");
  EXPECT_EQ(overriding_mistake({"density_ratio=3"}),
            "--set density_ratio: `density_ratio` is a parameter; write `parameters.density_ratio`");
  EXPECT_EQ(overriding_mistake({"solids.solids.rho=3"}),
            "--set solids.solids.rho: the case has no `solids` in `solids`; did you mean `solid`?");
  EXPECT_EQ(overriding_mistake({"time.end=-1"}), "--set time.end: must be > 0 [time], is -1");
  EXPECT_EQ(overriding_mistake({"time.cfl=fast"}),
            "--set time.cfl: unknown name `fast` at position 1 of `fast`");
  EXPECT_EQ(overriding_mistake({"grid.factor=0"}),
            "--set grid.factor: must be > 0 and <= 1000000000 [1/length], is 0");
  EXPECT_EQ(overriding_mistake({"grid.factor=1000000001"}),
            "--set grid.factor: must be > 0 and <= 1000000000 [1/length], is 1000000001");
  EXPECT_EQ(overriding_mistake({"grid.factor=20h"}),
            "--set grid.factor: h = 1 / (10 j) and j come from this number; it cannot use them");
  EXPECT_EQ(overriding_mistake({"time.end.x=1"}),
            "--set time.end.x: `x` lies in `0.8`, which is not a section; set that as a whole");
  EXPECT_EQ(overriding_mistake({"time.end"}), "--set `time.end`: write --set KEY=VALUE");
  EXPECT_EQ(overriding_mistake({"=1"}), "--set `=1`: write --set KEY=VALUE");
  EXPECT_EQ(overriding_mistake({"time..end=1"}),
            "--set time..end: write KEY=VALUE with a key such as time.end");
  EXPECT_EQ(overriding_mistake({"time.end="}), "--set time.end: the value is missing; write KEY=VALUE");
  EXPECT_EQ(overriding_mistake({"time=[1, 2]"}), "--set time: must be a section of keys, is a list of 2");
}

TEST(OverrideMistake, OfTheGasOfACaseWithSeveralNamesThem) {
  try {
    load_case(FSI_ROOT "/configs/piston_between_gases.yaml", {"fluid.gamma=1.2"});
    FAIL() << "no mistake";
  } catch (const UserMistake& mistake) {
    EXPECT_STREQ(mistake.what(),
                 "--set fluid.gamma: the case has several gases, left, right; write `fluids.NAME.gamma`");
  }
}

TEST(OverrideMistake, OfALawNamesTheLawsThereAre) {
  EXPECT_EQ(overriding_mistake({}, {"solid=neohookean"}),
            "--solid solid=neohookean: `neohookean` does not exist here; did you mean `neo_hookean`? (one of "
            "linear_elastic, saint_venant_kirchhoff, "
            "neo_hookean, mooney_rivlin, gent, rigid, beam, external)");
  EXPECT_EQ(overriding_mistake({}, {"piston=neo_hookean"}),
            "--solid piston=neo_hookean: the case has no `piston` in `solids`; it has solid");
  EXPECT_EQ(overriding_mistake({}, {"solid"}), "--solid `solid`: write --solid NAME=LAW");
}

}  // namespace
}  // namespace fsi
