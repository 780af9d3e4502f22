/// The moduli of a solid, in every form in which a case may write them.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/failure.hpp"

namespace fsi {
namespace {

/// The solid of a case with these words in the place of its moduli.
SolidSpec solid_with(const std::string& law, const std::string& words) {
  const std::string solid =
      "solids={block: {law: " + law + ", rho: 2, " + words +
      ", grid: {x: [0, 1], y: [0, 1], spacing: h}, boundary: {left: clamped, right: free, "
      "bottom: free, top: free}}}";
  return load_case(configs_folder() + "/spinning_block.yaml", {solid, "expect={}"}).solids.front();
}

TEST(Moduli, OfATensionTestStretchAndNarrowABarAsTheySay) {
  const double E = 210, nu = 0.3;
  const SolidSpec solid = solid_with("neo_hookean", "E: 210, nu: 0.3");
  // Uniaxial stress in space: strains e and -nu e, stress E e along and none across.
  const double e = 1, across = -nu * e, change = e + 2 * across;
  EXPECT_NEAR(solid.lambda * change + 2 * solid.mu * e, E * e, 1e-10);
  EXPECT_NEAR(solid.lambda * change + 2 * solid.mu * across, 0, 1e-10);
}

TEST(Moduli, OfInvariantsResistPressureAndShearAsTheySay) {
  const SolidSpec solid = solid_with("mooney_rivlin", "c10: 1, c01: 0.5, bulk: 30");
  // Equal strains e in space need a pressure of 3 bulk e; a shear strain has the stress 2 (c10 + c01) gamma.
  EXPECT_NEAR(3 * solid.lambda + 2 * solid.mu, 3 * 30, 1e-12);
  EXPECT_NEAR(solid.mu, 3, 1e-15);
  EXPECT_EQ(solid.data.at("c01"), 0.5);
}

TEST(Moduli, AreTakenByEveryLawInEveryForm) {
  for (const char* law :
       {"linear_elastic", "saint_venant_kirchhoff", "neo_hookean", "mooney_rivlin", "gent"}) {
    for (const char* moduli : {"lambda: 6, mu: 1", "E: 1, nu: 0.4", "c10: 1, bulk: 30"}) {
      EXPECT_GT(solid_with(law, std::string(moduli) + ", c01: 0.1, J_m: 20").mu, 0) << law << ": " << moduli;
    }
  }
}

TEST(Moduli, MayMakeASolidNearlyIncompressible) {
  EXPECT_DOUBLE_EQ(solid_with("neo_hookean", "lambda: 100, mu: 1").lambda, 100);
  const SolidSpec rubber = solid_with("gent", "E: 3, nu: 0.499, J_m: 30");
  EXPECT_NEAR(rubber.lambda / rubber.mu, 2 * 0.499 / (1 - 2 * 0.499), 1e-9);
}

TEST(Moduli, OfOneLawAreNotAskedOfAnother) {
  EXPECT_TRUE(solid_with("neo_hookean", "lambda: 1, mu: 1").data.empty());
  EXPECT_EQ(solid_with("gent", "lambda: 1, mu: 1, J_m: 8, c01: 9").data.size(), 1u);
}

TEST(Moduli, OfAProgramAreItsOwn) {
  const auto refused = [](const std::string& law, const std::string& words) -> std::string {
    try {
      solid_with(law, words);
      return "";
    } catch (const UserMistake& mistake) {
      return mistake.what();
    }
  };
  EXPECT_EQ(refused("gent", "lambda: 1, mu: 1, J_m: 8"), "");
  for (const char* data : {"stiffness: 3", "J_m: 3"}) {
    const std::string words = std::string("lambda: 1, mu: 1, J_m: 8, data: {") + data + "}";
    EXPECT_NE(refused("gent", words).find("belongs to `law: external`; leave it out"), std::string::npos)
        << refused("gent", words);
  }
}

}  // namespace
}  // namespace fsi
