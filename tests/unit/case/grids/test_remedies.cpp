// Changes of a case that are tried before they are told.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::mistake_in;

constexpr const char* held = "law: rigid, rho: 1, motion: fixed";

/// A body in a gas at rest.
std::string case_with(const std::string& law, const std::string& shape, const std::string& spacing = "") {
  return "time: {end: 1}\ngrid: {factor: 2}\n"
         "fluid:\n"
         "  grid: {x: [-2, 2], y: [-2, 2]" +
         spacing +
         "}\n"
         "  boundary: {left: outflow, right: outflow, bottom: slip_wall, top: outflow}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n"
         "solids:\n"
         "  a: {" +
         law + ", shape: " + shape + "}\n";
}

std::string rigid_case(const std::string& shape, const std::string& spacing = "") {
  return case_with(held, shape, spacing);
}

/// A spline through the points of a foil whose tail is sharp.
std::string foil(const std::string& corners) {
  return "{kind: spline, " + corners +
         "through: [[1, 0], [0.5, 0.03], [0.2, 0.08], [0, 0.05], [-0.06, 0], [0, -0.05], [0.2, -0.06], [0.5, "
         "-0.03]]}";
}

TEST(RemediesForOutlines, ASplineWithASharpTailIsToldACornerThere) {
  const std::string message = mistake_in(rigid_case(foil("")));
  EXPECT_NE(message.find("write `corner_angle: 60` in solids.a.shape, for sharp corners (tried: valid)"),
            std::string::npos)
      << message;
  EXPECT_EQ(mistake_in(rigid_case(foil("corner_angle: 60, "))), "");
}

TEST(RemediesForOutlines, AnElasticOneIsToldARigidOneWithACornerThere) {
  const std::string elastic = "law: neo_hookean, rho: 1, lambda: 1, mu: 1";
  const std::string message = mistake_in(case_with(elastic, foil("")));
  EXPECT_NE(
      message.find("write `law: rigid` and `motion: fixed` for solids.a, with `corner_angle: 60` in its "
                   "shape (tried: valid)"),
      std::string::npos)
      << message;
}

TEST(RemediesForOutlines, GridsThatAreLeftOutAndAFinerOneAreTriedTogether) {
  // Ten teeth with hollows too narrow for a spacing of 0.1, and for a factor of 2 without it.
  const std::string gear =
      "{kind: polygon, radius: 0.02, corners: [[0.4919, -0.0895], [0.4996, 0.02], [0.3582, 0.0359], [0.3479, "
      "0.0925], "
      "[0.4506, 0.2167], [0.3924, 0.3098], [0.2687, 0.2396], [0.2271, 0.2794], [0.2371, 0.4402], [0.1354, "
      "0.4813], "
      "[0.0765, 0.3518], [0.0195, 0.3595], [-0.0669, 0.4955], [-0.1734, 0.469], [-0.1449, 0.3296], [-0.1955, "
      "0.3023], "
      "[-0.3454, 0.3616], [-0.4159, 0.2775], [-0.3109, 0.1815], [-0.3359, 0.1296], [-0.4919, 0.0895], "
      "[-0.4996, -0.02], "
      "[-0.3582, -0.0359], [-0.3479, -0.0925], [-0.4506, -0.2167], [-0.3924, -0.3098], [-0.2687, -0.2396], "
      "[-0.2271, -0.2794], [-0.2371, -0.4402], [-0.1354, -0.4813], [-0.0765, -0.3518], [-0.0195, -0.3595], "
      "[0.0669, -0.4955], [0.1734, -0.469], [0.1449, -0.3296], [0.1955, -0.3023], [0.3454, -0.3616], "
      "[0.4159, -0.2775], [0.3109, -0.1815], [0.3359, -0.1296]]}";
  const std::string message = mistake_in(rigid_case(gear, ", spacing: 0.1"));
  EXPECT_NE(message.find("which are then chosen, and write `grid: {factor: 4}` in place of 2 (tried: valid)"),
            std::string::npos)
      << message;
  EXPECT_EQ(mistake_in(rigid_case(gear), {"grid.factor=4"}), "");
}

// --- spacings that a rectangle cannot have

/// A gas alone, 3 L by L. @param spacing of its grid, or nothing for the chosen one
std::string box_case(double L, const std::string& spacing, const std::string& factor = "") {
  return fmt::format(
      "time: {{end: 1}}\n{}fluid:\n  grid: {{x: [0, {:g}], y: [0, {:g}]{}}}\n"
      "  boundary: {{left: outflow, right: outflow, bottom: slip_wall, top: outflow}}\n"
      "  initial: {{rho: 1, v: [0, 0], p: 1}}\n",
      factor, 3 * L, L, spacing);
}

TEST(RemediesForSpacings, SayTheFactorWhereTheFileHasH) {
  const std::string message = mistake_in(box_case(0.003, ", spacing: h"));
  EXPECT_NE(message.find("gives 1 x 1 points"), std::string::npos) << message;
  EXPECT_NE(message.find("write `grid: {factor: 2000}` for 181 x 61 of them"), std::string::npos) << message;
  EXPECT_EQ(mistake_in(box_case(0.003, ", spacing: h", "grid: {factor: 2000}\n")), "");
}

TEST(RemediesForSpacings, SayTheFactorWhereTheFileHasNone) {
  const std::string body =
      "solids:\n  a: {law: rigid, rho: 1, motion: fixed, shape: {kind: ellipse, centre: [0.004, 0.0015], "
      "semi_axes: [0.0006, 0.0005]}}\n";
  const std::string message = mistake_in(box_case(0.003, "") + body);
  EXPECT_NE(message.find("write `grid: {factor: 2000}` for 181 x 61 of them"), std::string::npos) << message;
  EXPECT_EQ(mistake_in(box_case(0.003, "", "grid: {factor: 2000}\n") + body), "");
}

/// Millimetres in a case of metres: not the resolution is to blame.
TEST(RemediesForOutlines, SayThatNoGasHasRoomForOne) {
  const auto with_radius = [](double radius) {
    return mistake_in(
        box_case(3, "", "grid: {factor: 2}\n") +
        fmt::format("solids:\n  a: {{law: neo_hookean, rho: 1, E: 1, nu: 0.3, shape: {{kind: circle, "
                    "centre: [4, 1.5], radius: {}}}}}\n",
                    radius));
  };
  EXPECT_EQ(with_radius(0.5), "");
  const std::string message = with_radius(500);
  EXPECT_NE(message.find("solids.a.shape: the outline is 1000 x 1000 and no gas has room for it"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("another unit of length"), std::string::npos) << message;
}

TEST(RemediesForSpacings, SayASpacingWhereTheFileHasANumber) {
  for (const char* given : {"1e-9", "0.05", "20"}) {  // in place of about 1e-4
    const std::string message = mistake_in(box_case(0.007, fmt::format(", spacing: {}", given)));
    EXPECT_NE(message.find("write `spacing: 0.0001` for 211 x 71 of them"), std::string::npos) << message;
  }
  EXPECT_EQ(mistake_in(box_case(0.007, ", spacing: 0.0001")), "");
}

TEST(RemediesForGrids, AnOutlineOfMillionsOfPointsIsRefusedBeforeAnyIsPlaced) {
  const std::string disk =
      case_with("law: neo_hookean, rho: 1, lambda: 1, mu: 1", "{kind: circle, radius: 0.5}");
  const std::string message = mistake_in(disk, {"grid.factor=1e6"});
  EXPECT_NE(message.find("this outline would take 3.1e+07 points; take grid.factor "), std::string::npos)
      << message;
  EXPECT_EQ(mistake_in(disk, {"grid.factor=40"}), "");
}

}  // namespace
}  // namespace fsi
