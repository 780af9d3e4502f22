/// Interfaces that do not meet are the user's mistake, found before anything moves.

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "common/core/failure.hpp"
#include "coupler/exchange/matching.hpp"
#include "tests/unit/coupler/messages.hpp"

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

TEST(Matching, SidesThatAreNotOneCurveAreNamedWithTheirDistance) {
  auto hellos = piston_hellos(5, "beam");
  for (double& x : std::span(hellos[1].interfaces[0].x).first(5)) x = -0.125;
  const std::string message = mistake(hellos);
  for (const char* part : {"\"beam\"", "point 0", "0.125 from", "(0, 0)", "solids.beam"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  }
}

TEST(Matching, ASideThatIsShorterThanTheOtherIsNamed) {
  auto hellos = piston_hellos(5);
  for (double& y : std::span(hellos[1].interfaces[0].x).last(5)) y *= 0.5;
  EXPECT_NE(mistake(hellos).find("do not meet"), std::string::npos);
}

TEST(Matching, RoundingOfThePositionsIsNoMistake) {
  auto hellos = piston_hellos(5);
  for (double& x : hellos[1].interfaces[0].x) x += 1e-12;
  EXPECT_EQ(mistake(hellos), "accepted");
}

TEST(Matching, TheExchangeHappensAtThePointsOfTheFinerSide) {
  auto hellos = piston_hellos(5);
  EXPECT_FALSE(match_interfaces(hellos)[0].coarser);
  const wire::InterfaceInfo fine{
      .name = "solid", .dimension = 2, .x = vertical_line(9, 0), .n = everywhere(9, 1, 0)};
  hellos[1].interfaces[0] = fine;
  InterfacePair pair = match_interfaces(hellos)[0];
  EXPECT_EQ(pair.x, fine.x);
  EXPECT_TRUE(pair.coarser->is_gas);
  EXPECT_EQ(pair.coarser->n0, everywhere(5, 1, 0));
  hellos = piston_hellos(5);
  hellos[0].interfaces[0].x = fine.x;
  pair = match_interfaces(hellos)[0];
  EXPECT_EQ(pair.x, fine.x);
  EXPECT_FALSE(pair.coarser->is_gas);
  EXPECT_EQ(pair.n0, everywhere(9, 1, 0));
}

TEST(Matching, PointsMayRunInOppositeDirections) {
  auto hellos = piston_hellos(5);
  std::vector<double>& x = hellos[1].interfaces[0].x;
  std::reverse(x.begin() + 5, x.end());
  const InterfacePair pair = match_interfaces(hellos)[0];
  EXPECT_EQ(pair.x, vertical_line(5, 0));
  EXPECT_EQ(pair.coarser->x, x);
}

TEST(Matching, ASideWithoutAPartnerIsNamed) {
  auto hellos = piston_hellos(5);
  hellos[1].interfaces.clear();
  EXPECT_NE(mistake(hellos).find("exactly one side of one solid"), std::string::npos);
  hellos = piston_hellos(5);
  hellos[0].interfaces.clear();
  EXPECT_NE(mistake(hellos).find("no side of the gas"), std::string::npos);
}

TEST(Matching, NormalsThatAreNoUnitVectorsAreNamed) {
  std::vector<wire::Hello> hellos = piston_hellos(5);
  EXPECT_NO_THROW(match_interfaces(hellos));
  hellos[1].interfaces[0].n[3] = 2;
  try {
    match_interfaces(hellos);
    FAIL() << "a normal of length 2";
  } catch (const PeerLost& lost) {
    EXPECT_NE(
        std::string(lost.what()).find("normal 3 of interface \"solid\" the length 2; send unit normals"),
        std::string::npos)
        << lost.what();
  }
}

TEST(Matching, TwoSolidsOnOneSideAreNamed) {
  auto hellos = piston_hellos(5);
  hellos.push_back(hellos[1]);
  hellos[2].name = "other";
  EXPECT_NE(mistake(hellos).find("exactly one side of one solid"), std::string::npos);
}

TEST(Matching, ARunWithoutGasOrWithTwoAtOneInterfaceIsRefused) {
  const auto hellos = piston_hellos(5);
  EXPECT_THROW(match_interfaces(std::vector<wire::Hello>{hellos[1]}), PeerLost);
  EXPECT_THROW(match_interfaces(std::vector<wire::Hello>{hellos[0], hellos[0], hellos[1]}), PeerLost);
}

}  // namespace
}  // namespace fsi::coupler
