/// Interfaces that do not meet are the user's mistake, found before anything moves.

#include <gtest/gtest.h>

#include <algorithm>

#include "common/core/failure.hpp"
#include "coupler/matching.hpp"
#include "messages.hpp"

namespace fsi::coupler {
namespace {

using namespace testing;

/// The message of the mistake, or "accepted".
std::string mistake(const std::vector<wire::Hello>& hellos) {
  try {
    match_interfaces(hellos);
  } catch (const UserMistake& found) {
    return found.what();
  }
  return "accepted";
}

TEST(Matching, FindsTheSolidOfEachSideOfTheGas) {
  const auto side = [](const std::string& name, double x) {
    return wire::InterfaceInfo{
        .name = name, .dimension = 2, .x = vertical_line(4, x), .n = everywhere(4, 1, 0)};
  };
  const std::vector<wire::Hello> hellos{solid_hello("b", side("b", 1)),
                                        fluid_hello({side("a", 0), side("b", 1)}),
                                        solid_hello("a", side("a", 0))};
  const std::vector<InterfacePair> pairs = match_interfaces(hellos);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].solid, "a");
  EXPECT_EQ(pairs[1].solid, "b");
  EXPECT_EQ(pairs[1].x, vertical_line(4, 1));
}

TEST(Matching, PointsThatLieApartAreNamedWithTheirDistance) {
  auto hellos = piston_hellos(5, "beam");
  hellos[1].interfaces[0].x[3] = -0.125;
  const std::string message = mistake(hellos);
  for (const char* part : {"\"beam\"", "point 3", "0.125 apart", "(0, 0.75)", "solids.beam"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  }
}

TEST(Matching, RoundingOfThePositionsIsNoMistake) {
  auto hellos = piston_hellos(5);
  for (double& x : hellos[1].interfaces[0].x) x += 1e-12;
  EXPECT_EQ(mistake(hellos), "accepted");
}

TEST(Matching, DifferentNumbersOfPointsAreNamed) {
  auto hellos = piston_hellos(5);
  hellos[1].interfaces[0].x = vertical_line(9, 0);
  EXPECT_NE(mistake(hellos).find("5 points and the solid 9"), std::string::npos);
}

TEST(Matching, OppositeDirectionsAreNamed) {
  auto hellos = piston_hellos(5);
  std::vector<double>& x = hellos[1].interfaces[0].x;
  std::reverse(x.begin() + 5, x.end());
  EXPECT_NE(mistake(hellos).find("opposite directions"), std::string::npos);
}

TEST(Matching, ASideWithoutAPartnerIsNamed) {
  auto hellos = piston_hellos(5);
  hellos[1].interfaces.clear();
  EXPECT_NE(mistake(hellos).find("exactly one side of one solid"), std::string::npos);
  hellos = piston_hellos(5);
  hellos[0].interfaces.clear();
  EXPECT_NE(mistake(hellos).find("no side of the gas"), std::string::npos);
}

TEST(Matching, TwoSolidsOnOneSideAreNamed) {
  auto hellos = piston_hellos(5);
  hellos.push_back(hellos[1]);
  hellos[2].name = "other";
  EXPECT_NE(mistake(hellos).find("exactly one side of one solid"), std::string::npos);
}

TEST(Matching, ARunWithoutGasOrWithTwoIsRefused) {
  const auto hellos = piston_hellos(5);
  EXPECT_THROW(match_interfaces(std::vector<wire::Hello>{hellos[1]}), PeerLost);
  EXPECT_THROW(match_interfaces(std::vector<wire::Hello>{hellos[0], hellos[0], hellos[1]}), PeerLost);
}

}  // namespace
}  // namespace fsi::coupler
