// Mirrors that are none, and periodic sides that are no copies of each other, are refused; the others are not.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

std::string gas_in(const std::string& map, const std::string& boundary) {
  return fmt::format(
      "time: {{end: 0.5}}\n"
      "fluid:\n"
      "  grid: {{kind: mapped, points: [21, 11], map: [{}]}}\n"
      "  boundary: {{{}}}\n"
      "  initial: {{rho: 1, v: [0, 0], p: 1}}\n",
      map, boundary);
}

const std::string mirrors = "left: symmetry, right: symmetry, bottom: slip_wall, top: slip_wall";
const std::string walls = "left: slip_wall, right: slip_wall, bottom: slip_wall, top: slip_wall";
const std::string repeats = "left: periodic, right: periodic, bottom: slip_wall, top: slip_wall";

void expect_mistake(const std::string& mistake, const std::string& what) {
  EXPECT_TRUE(mistake.starts_with("case.yaml:4:")) << mistake;
  EXPECT_NE(mistake.find(what), std::string::npos) << mistake;
}

TEST(Mirrors, AreStraight) {
  expect_mistake(tests::mistake_in(gas_in("r + 0.1 * s * (1 - s), s", mirrors)),
                 "lies 0.009 off the line through its ends at t = 0; write slip_wall");
  EXPECT_EQ(tests::mistake_in(gas_in("r + 0.1 * s * (1 - s), s", walls)), "");
  EXPECT_EQ(tests::mistake_in(gas_in("r + 0.1 * r * (1 - r), s + 0.5 * r", mirrors)),
            "");  // inside, it may bend
}

TEST(Mirrors, AreNoClosedCurves) {
  const std::string text =
      "time: {end: 0.1}\n"
      "fluid:\n"
      "  grid: {x: [-1, 1], y: [-1, 1], points: [41, 41]}\n"
      "  body_fitted: [{name: hole, shape: {kind: circle, radius: 0.3, centre: [0, 0]}, boundary: "
      "symmetry}]\n"
      "  boundary: {left: outflow, right: outflow, bottom: outflow, top: outflow}\n"
      "  initial: {rho: 1, v: [0, 0], p: 1}\n";
  expect_mistake(tests::mistake_in(text), "a straight line with two ends; write slip_wall");
}

TEST(Mirrors, MoveAlongThemselvesOnly) {
  expect_mistake(tests::mistake_in(gas_in("r + 0.3 * t, s", mirrors)),
                 "t = 0.03125, lies 0.00937 off the line");
  expect_mistake(tests::mistake_in(gas_in("r + 0.1 * t * s, s", mirrors)), "write slip_wall");
  EXPECT_EQ(tests::mistake_in(gas_in("r + 0.3 * t, s", walls)), "");
  EXPECT_EQ(tests::mistake_in(gas_in("r, s + 0.3 * t", mirrors)), "");
}

TEST(PeriodicSides, AreCopiesOfEachOtherAllTheTime) {
  expect_mistake(tests::mistake_in(gas_in("r, s * (1 + 0.1 * r)", repeats)),
                 "but (1, 0.01) at (0, 0.1), t = 0;");
  expect_mistake(tests::mistake_in(gas_in("r * (1 + 0.3 * t), s", repeats)),
                 "(1, 0) at their first points, but (1.00937, 0)");
  expect_mistake(tests::mistake_in(gas_in("cos(r) * (1 + s), -sin(r) * (1 + s)", repeats)),
                 "in one direction");
  EXPECT_EQ(tests::mistake_in(gas_in("r + 0.1 * s * (1 - s) + 0.3 * t, s + 0.1 * r", repeats)), "");
  EXPECT_EQ(tests::mistake_in(gas_in("cos(2 * pi * r) * (1 + s), -sin(2 * pi * r) * (1 + s)", repeats)),
            "");  // a ring
}

}  // namespace
}  // namespace fsi
