// What a solid that has broken proposes to change.

#include <gtest/gtest.h>

#include <string>

#include "common/case/case.hpp"
#include "solid_solver/program/remedy.hpp"

namespace fsi::solid {
namespace {

SolidScheme relaxed(const fsi::Beta& relaxation) {
  return {.limiter = SolidLimiter::minmod,
          .tangential_stress = {.scaled = 0.5},
          .displacement = {.scaled = 0.5},
          .relaxation = relaxation};
}

std::string remedy_of(const fsi::Beta& relaxation, double stiffness) {
  return remedy_for("bar", relaxed(relaxation), stiffness, false);
}

TEST(Remedy, TakesRelaxationOutOfANearlyIncompressibleSolidAndNeverPutsItIn) {
  constexpr double stiffness = 49;  // nu = 0.49
  const std::string out = "solids.bar.scheme.relaxation: {scaled: 0}, for lambda is 49 mu";
  EXPECT_EQ(remedy_of({.scaled = 0.2}, stiffness), out);
  EXPECT_EQ(remedy_of({.rate = 3}, stiffness), out);
  EXPECT_EQ(remedy_of({}, stiffness), "a smaller time.cfl");
}

TEST(Remedy, PutsRelaxationIntoACompressibleSolid) {
  EXPECT_EQ(remedy_of({.scaled = 0.2}, 1), "solids.bar.scheme.relaxation: {scaled: 0.5}");
  EXPECT_NE(remedy_of({}, 1).find("without `relaxation`"), std::string::npos);
  EXPECT_EQ(remedy_of({.scaled = 0.5}, 1), "a smaller time.cfl");
}

TEST(Remedy, NamesTheStrongestLimiterBeforeASmallerStep) {
  SolidScheme scheme = relaxed({.scaled = 0.5});
  scheme.limiter = SolidLimiter::mc;
  EXPECT_EQ(remedy_for("bar", scheme, 1, false), "solids.bar.scheme.limiter: minmod");
  EXPECT_EQ(remedy_of({.scaled = 0.5}, 1), "a smaller time.cfl");
}

TEST(Remedy, NamesWhatIsMissingFirst) {
  SolidScheme scheme = relaxed({.scaled = 0.2});
  EXPECT_EQ(remedy_for("bar", scheme, 49, true), "--solid bar=neo_hookean, unless the strains are small");
  scheme.displacement = {};
  EXPECT_NE(remedy_for("bar", scheme, 49, true).find("without `displacement`"), std::string::npos);
  scheme.limiter = SolidLimiter::none;
  EXPECT_EQ(remedy_for("bar", scheme, 49, true), "solids.bar.scheme.limiter: minmod, for jumps");
}

TEST(Remedy, ASolidThatItsLoadSqueezesIsNotToldToRelax) {
  Squeeze by_load, by_noise;
  for (int step = 0; step < 100; ++step) by_load.add(0.5 - 0.0045 * step);
  EXPECT_NEAR(by_load.by_load(), 0.5 - 0.0045 * 99, 1e-12);
  for (const double det_F : {1.0, 0.9, 0.3, 0.1}) by_noise.add(det_F);
  EXPECT_EQ(by_noise.by_load(), 1);
  Archive saved;
  by_load.archive(saved);
  Squeeze restarted;
  Archive loading(saved.entries());
  restarted.archive(loading);
  EXPECT_EQ(restarted.by_load(), by_load.by_load());
  by_load.add(0.9);  // it came back
  EXPECT_EQ(by_load.by_load(), 1);
  EXPECT_NE(remedy_for("bar", relaxed({.scaled = 0.2}), 1, false, 0.05).find("a stiffer solids.bar"),
            std::string::npos);
  EXPECT_EQ(remedy_for("bar", relaxed({.scaled = 0.2}), 1, false, 1), remedy_of({.scaled = 0.2}, 1));
}

TEST(Remedy, NamesTheLoadOfASolidThatIsMuchTooSoftBeforeAllElse) {
  const SolidScheme scheme = relaxed({.scaled = 0.2});
  EXPECT_EQ(remedy_for("bar", scheme, 1, false, 0.05, 75).find("a stiffer solids.bar or a weaker load"), 0U);
  EXPECT_NE(remedy_for("bar", scheme, 1, false, 1, 75).find("up to 75 times its lambda + 2 mu"),
            std::string::npos);
  EXPECT_EQ(remedy_for("bar", scheme, 1, false, 1, 0.5), remedy_of({.scaled = 0.2}, 1));
}

// A scheme bears no load that the material does not; but a missing limiter, or a law that softens, is said first.
TEST(Remedy, NamesTheLoadOfAStreamThatIsAsStrongAsTheSolidBeforeRelaxationAndLimiters) {
  SolidScheme scheme = relaxed({.scaled = 0.2});
  for (const double stiffness : {1.0, 49.0}) {
    EXPECT_NE(remedy_for("bar", scheme, stiffness, false, 1, 0.4, 3.31)
                  .find("a weaker load: where it brings the gas "
                        "to rest, that presses it with about 3.3"),
              std::string::npos);
    EXPECT_EQ(remedy_for("bar", scheme, stiffness, false, 1, 0.1, 0.4),
              remedy_of({.scaled = 0.2}, stiffness));
  }
  EXPECT_EQ(remedy_for("bar", scheme, 1, true, 1, 0.4, 3.3),
            "--solid bar=neo_hookean, unless the strains are small");
  scheme.limiter = SolidLimiter::none;
  EXPECT_EQ(remedy_for("bar", scheme, 1, false, 1, 0.4, 3.3), "solids.bar.scheme.limiter: minmod, for jumps");
}

}  // namespace
}  // namespace fsi::solid
