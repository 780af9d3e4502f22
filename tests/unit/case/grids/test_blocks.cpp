// Elastic bodies with four straight sides and sharp corners: one grid from corner to corner.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "common/case/grids/block.hpp"
#include "common/case/grids/grid_points.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::load_text;
using tests::mistake_in;

/// `more`: keys of the solid besides its law and its shape.
std::string block_case(const std::string& shape, const std::string& more = "", const std::string& gas = "") {
  return "time: {end: 1}\ngrid: {factor: 2}\n"
         "fluid:\n"
         "  grid: {x: [-2, 2], y: [-2, 2]}\n"
         "  boundary: {left: slip_wall, right: slip_wall, bottom: slip_wall, top: slip_wall}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n" +
         gas +
         "solids:\n"
         "  block:\n    law: neo_hookean\n    rho: 1\n    lambda: 1\n    mu: 1\n    shape: {kind: polygon, "
         "radius: 0, " +
         shape + "}\n" + more;
}

const std::string square = "corners: [[0.5, 0.5], [-0.5, 0.4], [-0.5, -0.5], [0.5, -0.5]]";

TEST(Blocks, ARectangleGetsOneGridAndTheGasThePointsOfItsRim) {
  const Case problem = load_text(block_case(square));
  const SolidSpec& solid = problem.solids.front();
  ASSERT_TRUE(is_block(solid));
  EXPECT_TRUE(fitted_grids(solid).empty());
  EXPECT_EQ(solid.grid.n1, 21);
  EXPECT_EQ(solid.grid.n2, 20);  // its sides are 1 and 0.9 long
  const CurveSpec &own = solid.body_fitted.front().curve,
                  &gas = problem.fluids.front().body_fitted.front().curve;
  EXPECT_EQ(own.x, gas.x);
  EXPECT_EQ(gas.corners, (std::vector<int>{0, 20, 39, 59}));
  // Counter-clockwise from the lower left corner.
  EXPECT_NEAR((Vec2(own.x[0], own.x[static_cast<std::size_t>(own.points())]) - Vec2(-0.5, -0.5)).norm(), 0,
              1e-12);
  EXPECT_EQ(place(solid.grid, 1, 0, 0), Vec2(0.5, -0.5));
  for (const BoundarySpec& side : solid.boundary) EXPECT_EQ(side.kind, BoundaryKind::interface);
  EXPECT_EQ(mistake_in(problem.resolved), "");
  EXPECT_EQ(load_text(problem.resolved).chosen.size(), 0U);
}

TEST(Blocks, OnAWallTheSideOfThatNameStandsThere) {
  struct Wall {
    const char *name, *corners;
    Vec2 inwards;
  };
  for (const auto& [name, corners, inwards] :
       {Wall{"bottom", "[[-0.2, -2], [-0.2, -1], [0.2, -1], [0.2, -2]]", {0, 1}},
        Wall{"top", "[[-0.2, 2], [-0.2, 1], [0.2, 1], [0.2, 2]]", {0, -1}},
        Wall{"left", "[[-2, -0.2], [-1, -0.2], [-1, 0.2], [-2, 0.2]]", {1, 0}},
        Wall{"right", "[[2, -0.2], [1, -0.2], [1, 0.2], [2, 0.2]]", {-1, 0}}}) {
    std::string boundary = "    boundary: {left: free, right: free, bottom: free, top: free}\n";
    const std::string word = fmt::format("{}: free", name);
    boundary.replace(boundary.find(word), word.size(), fmt::format("{}: clamped", name));
    const Case problem =
        load_text(block_case(fmt::format("corners: {}, walls: [{}, {}]", corners, name, name), boundary));
    const SolidSpec& solid = problem.solids.front();
    ASSERT_TRUE(is_block(solid)) << name;
    int held = 0;
    for (const Side side : all_sides) {
      const bool stands = name_of(side) == std::string(name);
      const BoundaryKind kind = solid.boundary[static_cast<std::size_t>(side)].kind;
      EXPECT_EQ(kind, stands ? BoundaryKind::displacement : BoundaryKind::interface) << name << name_of(side);
      if (!stands) continue;
      ++held;
      for (int k = 0; k < points_along(solid.grid, side); ++k)
        EXPECT_NEAR(side_point(solid.grid, side, k).dot(inwards), -2, 1e-12);
    }
    EXPECT_EQ(held, 1);
    // The body is to the left of its outline, whose ends stand on the wall.
    const CurveSpec& curve = solid.body_fitted.front().curve;
    EXPECT_EQ(sides_along(curve).size(), 3U);
    EXPECT_EQ(curve.corners.size(), 2U);
    for (const int end : {0, curve.points() - 1}) {
      const auto k = static_cast<std::size_t>(end);
      EXPECT_NEAR(Vec2(curve.x[k], curve.x[curve.x.size() / 2 + k]).dot(inwards), -2, 1e-12);
    }
  }
}

TEST(Blocks, ThinOnesHaveFourCellsAcrossAndGivenPointsStay) {
  const std::string thin = "corners: [[-0.5, 0], [0.5, 0], [0.5, 0.1], [-0.5, 0.1]]";
  const GridSpec chosen = load_text(block_case(thin)).solids.front().grid;
  EXPECT_EQ(chosen.n1, 28);  // cells at most half as long again as wide
  EXPECT_EQ(chosen.n2, 5);
  const GridSpec given =
      load_text(block_case(thin, "    grid: {kind: block, points: [31, 9]}\n")).solids.front().grid;
  EXPECT_EQ(given.n1, 31);
  EXPECT_EQ(given.n2, 9);
  const GridSpec spaced =
      load_text(block_case(thin, "    grid: {kind: block, spacing: 0.02}\n")).solids.front().grid;
  EXPECT_EQ(spaced.n1, 51);
  EXPECT_EQ(spaced.n2, 6);
}

TEST(Blocks, PointsOnlyFarApartAlongThemAreRefused) {
  const std::string thin = "corners: [[-0.5, 0], [0.5, 0], [0.5, 0.04], [-0.5, 0.04]]";
  EXPECT_EQ(mistake_in(block_case(thin)), "");
  const std::string message = mistake_in(block_case(thin, "    grid: {kind: block, points: [19, 5]}\n"));
  EXPECT_NE(message.find("solids.block.grid: cells 0.0556 x 0.01: "), std::string::npos) << message;
}

TEST(Blocks, PointsThatDoNotSayWhereAreTakenFromCornerToCornerByTheRemedy) {
  const std::string message = mistake_in(block_case(square, "    grid: {points: [15, 13]}\n"));
  for (const char* said : {"solids.block.grid: `points: [15, 13]` says not where",
                           "write `grid: {kind: block, points: [15, 13]}`, from corner to corner of `shape` "
                           "(tried: valid), or give"})
    EXPECT_NE(message.find(said), std::string::npos) << message;
  const std::string turned = mistake_in(
      block_case("corners: [[-0.5, 0], [0.5, 0], [0.5, 0.1], [-0.5, 0.1]]", "    grid: {points: [7, 51]}\n"));
  EXPECT_NE(turned.find("kind: block, points: [51, 7]}`, from corner to corner of `shape` (tried: valid)"),
            std::string::npos)
      << turned;
  std::string round = block_case("corners: [[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]]",
                                 "    grid: {spacing: 0.1}\n");
  round.replace(round.find("radius: 0"), 9, "sharpness: 30");
  const std::string sharp = mistake_in(round);
  EXPECT_NE(
      sharp.find("kind: block, spacing: 0.1}`, from corner to corner of `shape`, and its corners sharp, "
                 "`radius: 0` (tried: valid)"),
      std::string::npos)
      << sharp;
  const std::string five =
      mistake_in(block_case("corners: [[0.7, 0], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]]",
                            "    grid: {points: [15, 13]}\n"));
  EXPECT_EQ(five.find("kind: block, points: [15, 13]}`, from corner to corner of `shape` (tried: valid)"),
            std::string::npos)
      << five;
}

TEST(Blocks, TooManyPointsAreRefusedAtOnce) {
  for (const char* grid : {"spacing: 1e-6", "spacing: 1e-300", "points: [12000, 5]"}) {
    const std::string message =
        mistake_in(block_case(square, fmt::format("    grid: {{kind: block, {}}}\n", grid)));
    EXPECT_NE(message.find("around the body"), std::string::npos) << grid << ": " << message;
  }
}

TEST(Blocks, LinesOfTheGasAreCloseAtElasticCorners) {
  const auto lines = [](const std::string& spacing) {
    return block_case("corners: [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]", "",
                      "  body_fitted: [{name: ring, solid: block, lines: 10, spacing: " + spacing + "}]\n");
  };
  const std::string message = mistake_in(lines("0.9 * h"));
  for (const char* said : {"turns too sharply at (", "fluid.body_fitted"})
    EXPECT_NE(message.find(said), std::string::npos) << message << "\nexpected: " << said;
  EXPECT_EQ(mistake_in(lines("0.55 * h")), "");
  const Case chosen = load_text(block_case("corners: [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]"));
  EXPECT_LE(chosen.fluids.front().body_fitted.front().spacing, 0.6 * 0.05);
  const Case rigid = load_text(block_case("corners: [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]"),
                               {}, {"block=rigid"});
  // With lines as far apart as the points the first ghost line at a right angle has no length.
  EXPECT_LE(rigid.fluids.front().body_fitted.front().spacing, 0.9 * 0.05);
  EXPECT_GT(rigid.fluids.front().body_fitted.front().spacing, 0.8 * 0.05);
}

TEST(Blocks, NearlyIncompressibleOnesNeedRoundCorners) {
  const auto with_lambda = [](const std::string& lambda, const std::string& radius) {
    std::string text = block_case(square);
    text.replace(text.find("lambda: 1"), 9, "lambda: " + lambda);
    return text.replace(text.find("radius: 0"), 9, "radius: " + radius);
  };
  EXPECT_EQ(mistake_in(with_lambda("199", "0")), "");
  const std::string message = mistake_in(with_lambda("499", "0"));
  for (const char* said : {"solids.block.shape", "lambda / mu = 499", "write `radius: 0.2"})
    EXPECT_NE(message.find(said), std::string::npos) << message << "\nexpected: " << said;
  EXPECT_EQ(mistake_in(with_lambda("499", "0.2")), "");
}

TEST(Blocks, AFootIsHeld) {
  const std::string corners =
      "corners: [[-0.2, -2], [-0.2, -1], [0.2, -1], [0.2, -2]], walls: [bottom, bottom]";
  // What is told is tried as it stands, in the place that is named.
  const std::string message = mistake_in(block_case(corners));
  ASSERT_NE(message.find("solids.block.boundary: the outline ends at"), std::string::npos) << message;
  EXPECT_NE(message.find("nothing holds it there"), std::string::npos) << message;
  for (const char* how : {"slip_wall", "clamped"}) {
    const std::string told = fmt::format("boundary: {{left: free, right: free, bottom: {}, top: free}}", how);
    EXPECT_NE(message.find("`" + told + "`"), std::string::npos) << message;
    EXPECT_EQ(mistake_in(block_case(corners, "    " + told + "\n")), "") << how;
  }
  const std::string with_interface = mistake_in(
      block_case(corners, "    boundary: {left: free, right: free, bottom: interface, top: free}\n"));
  EXPECT_NE(with_interface.find("write `bottom: clamped` or `bottom: slip_wall`"), std::string::npos)
      << with_interface;
  for (const char* held : {"clamped", "slip_wall"})
    EXPECT_EQ(mistake_in(block_case(
                  corners,
                  fmt::format("    boundary: {{left: free, right: free, bottom: {}, top: free}}\n", held))),
              "")
        << held;
}

TEST(Blocks, AnotherLawTakesTheOutline) {
  const Case problem = load_text(block_case(square), {}, {"block=rigid"});
  EXPECT_FALSE(is_block(problem.solids.front()));
}

TEST(Blocks, WhatHasNotFourStraightSidesIsRefusedWithARadiusThatHolds) {
  const std::string house = "corners: [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.4], [0, 0.7], [-0.5, 0.4]]";
  const std::string message = mistake_in(block_case(house));
  for (const char* said : {"sharp corner at (0.5, -0.5)", "it has 5 corners; ",
                           "leave out `radius` of solids.block.shape", "(tried: valid)"})
    EXPECT_NE(message.find(said), std::string::npos) << message << "\nexpected: " << said;
}

TEST(Blocks, ACornerThatIsCutOffIsSaidToCountTwice) {
  const std::string rhomb = "corners: [[-0.8, 0], [0, -0.2], [0.8, 0], [0, 0.2]]";
  const std::string message = mistake_in(block_case(rhomb));
  for (const char* said :
       {"it has 6 corners, 2 more than are listed: ", "by more than 110 degrees", "counts twice"})
    EXPECT_NE(message.find(said), std::string::npos) << message << "\nexpected: " << said;
}

TEST(Blocks, TwoBodiesWithOneFaultAreMendedAtOnce) {
  const auto half_moon = [](const std::string& name, double x) {
    return fmt::format(
        "  {}:\n    law: neo_hookean\n    rho: 1\n    lambda: 1\n    mu: 1\n"
        "    shape: {{kind: spline, corner_angle: 60, through: [[{}, 0.6], [{}, 0.45], [{}, 0], [{}, -0.45], "
        "[{}, -0.6]]}}\n",
        name, x, x - 0.35, x - 0.6, x - 0.35, x);
  };
  std::string gas = block_case(square);
  gas.erase(gas.find("  block:\n"));
  EXPECT_NE(mistake_in(gas + half_moon("left", -0.7)).find("(tried: valid)"), std::string::npos);
  const std::string both = mistake_in(gas + half_moon("left", -0.7) + half_moon("right", 1.4));
  EXPECT_NE(both.find(", and the same for solids.right (tried: valid)"), std::string::npos) << both;
}

TEST(Blocks, KeysThatABlockHasNotAreRefused) {
  for (const auto& [text, said] :
       {std::pair{
            block_case(square, "    grid: {kind: block, points: [11, 11]}\n    body_fitted: {lines: 7}\n"),
            "solids.block.body_fitted.lines: belongs to a grid along the outline"},
        std::pair{block_case(square, "    grid: {kind: block, points: [11, 11], rotation: 10}\n"),
                  "solids.block.grid.rotation: a block lies as its `shape` does"},
        std::pair{block_case(square, "", "  body_fitted: [{name: ring, solid: block, points: 61}]\n"),
                  "have the same points, from corner to corner"},
        std::pair{block_case("corners: [[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]]",
                             "    grid: {kind: block, points: [11, 11]}\n"),
                  "`kind: block` is for an outline of four straight sides"}}) {
    const std::string message = mistake_in(text);
    EXPECT_NE(message.find(said), std::string::npos) << message << "\nexpected: " << said;
  }
}

}  // namespace
}  // namespace fsi
