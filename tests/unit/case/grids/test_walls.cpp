// Bodies that stand on walls that are outlines themselves.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/case/grids/composite_from_case.hpp"
#include "common/core/failure.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::load_text;
using tests::mistake_in;

/// A floor that drops at x = 1 over a slope, and a fixed body on it; its walls by name.
std::string floor_case(const std::string& corners, const std::string& walls = "[floor, floor]",
                       const std::string& motion = "motion: fixed") {
  return "time: {end: 1}\n"
         "grid: {factor: 2}\n"
         "fluid:\n"
         "  grid: {x: [-2, 3], y: [-1, 2]}\n"
         "  boundary: {left: outflow, right: outflow, bottom: symmetry, top: outflow}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n"
         "  body_fitted:\n"
         "    - {name: floor, shape: {kind: polygon, corners: [[-2, 0], [1, 0], [2.5, -1]], radius: 0, "
         "walls: [left, bottom]}}\n"
         "    - {name: pole, shape: {kind: circle, centre: [-1, 1.2], radius: 0.2}}\n"
         "solids:\n"
         "  body: {law: rigid, rho: 1, " +
         motion + ", shape: {kind: polygon, radius: 0, corners: " + corners + ", walls: " + walls + "}}\n";
}

const std::string panel = "[[-0.5, 0], [-0.5, 0.6], [-0.3, 0.6], [-0.3, 0]]";

TEST(Walls, ABodyOnAnOutlineGetsTheWallsConditionAtItsEnds) {
  const Case problem = load_text(floor_case(panel));
  ASSERT_EQ(problem.fluids.front().body_fitted.size(), 3U);
  const BodyFittedSpec& ring = problem.fluids.front().body_fitted[2];
  EXPECT_EQ(ring.curve.on, "floor");
  EXPECT_EQ((*ring.curve.walls)[0], Side::bottom);
  for (const Side end : {Side::left, Side::right})
    EXPECT_EQ(ring.boundary[static_cast<std::size_t>(end)].kind, BoundaryKind::slip_wall);
  EXPECT_EQ(mistake_in(problem.resolved), "");
}

TEST(Walls, PointsOfTheWallUnderTheBodyAreUnusedAndThoseBesideItAreNot) {
  const Case problem = load_text(floor_case(panel));
  const std::vector<BodyFittedSpec>& specs = problem.fluids.front().body_fitted;
  std::vector<grid::MovingGrid> grids;
  std::vector<ConstFieldView> views;
  for (const BodyFittedSpec& spec : specs) grids.emplace_back(grid_of(spec), 0);
  for (const grid::MovingGrid& grid : grids) views.push_back(grid.x());
  grid::CompositeGrid composite(background_of(problem.fluids.front().grid), bodies_of(specs));
  composite.connect(views, 0);
  EXPECT_EQ(composite.body(3).wall, 1);
  const int j = specs[0].side == Side::top ? specs[0].lines - 1 : 0;
  int under = 0, beside = 0;
  for (int i = 0; i < specs[0].curve.points(); ++i) {
    const double x = views[0](0, i, j);
    const bool unused = composite.kind(1, i, j) == grid::PointKind::unused;
    if (x > -0.49 && x < -0.31) under += unused ? 1 : 100;
    if (x < -0.51 || x > -0.29) beside += unused ? 100 : 1;
  }
  EXPECT_TRUE(under > 0 && under < 100) << under;
  EXPECT_TRUE(beside > 40 && beside < 100) << beside;
  // The ends of the body's grid lie on the wall and are in use.
  for (const int i : {0, specs[2].curve.points() - 1})
    EXPECT_NE(composite.kind(3, i, specs[2].lines - 1), grid::PointKind::unused);
}

TEST(Walls, ABodyStandsOnASlope) {
  // Its feet on the line from (1, 0) to (2.5, -1), its sides at right angles to it.
  const Case problem = load_text(floor_case("[[1.6, -0.4], [1.8, -0.1], [1.95, -0.2], [1.75, -0.5]]"));
  const CurveSpec& curve = problem.fluids.front().body_fitted[2].curve;
  EXPECT_NEAR(curve.along[0][1] / curve.along[0][0], -2.0 / 3, 1e-9);
  EXPECT_EQ((*curve.walls)[0], Side::bottom);  // the side it faces most
}

TEST(Walls, EndsWithSixDigitsArePutOnTheWall) {
  // The slope is y = -2 (x - 1) / 3: six decimals miss it by a few 1e-7.
  const Case problem = load_text(floor_case(
      "[[1.313131, -0.208754], [1.479801, 0.041251], [1.646471, -0.069862], [1.479801, -0.319867]]"));
  const CurveSpec& curve = problem.solids.front().body_fitted.front().curve;
  const auto n = static_cast<std::size_t>(curve.points());
  for (const std::size_t k : {std::size_t{0}, n - 1})
    EXPECT_NEAR(curve.x[n + k] + 2.0 / 3 * (curve.x[k] - 1), 0, 1e-12) << k;
}

TEST(Walls, AnElasticBodyOnASlopeIsToldThatItNeedsALevelWall) {
  std::string text =
      floor_case("[[1.3, -0.2], [1.46641, 0.04962], [1.63282, -0.06132], [1.46641, -0.31094]]");
  text.replace(text.find("law: rigid, rho: 1, motion: fixed"), 33,
               "law: neo_hookean, rho: 1, lambda: 1, mu: 1");
  text.replace(text.rfind("radius: 0"), 9, "radius: 0.02");
  const std::string message = mistake_in(text);
  EXPECT_NE(message.find("an elastic body needs a wall that is level or upright"), std::string::npos)
      << message;
  EXPECT_EQ(message.find("round it more"), std::string::npos) << message;
}

TEST(Walls, MistakesNameThePlaceAndWhatToWrite) {
  struct Mistake {
    std::string text, says;
  };
  std::string rounded = floor_case("[[0.7, 0], [0.7, 0.6], [0.98, 0.6], [0.98, 0]]");
  rounded.replace(rounded.find("polygon, radius: 0,"), 19, "polygon, radius: 0.08,");
  for (
      const auto& [text, says] : std::vector<Mistake>{
          {floor_case(panel, "[flor, flor]"),
           "no grid with a `shape` in fluid.body_fitted `flor`; did you mean"},
          {floor_case(panel, "[floor, bottom]"), "both on the wall of one grid: write its name twice"},
          {floor_case("[[-0.5, 0.1], [-0.5, 0.6], [-0.3, 0.6], [-0.3, 0.1]]"),
           "0.1), is 0.1 from the wall of grid `floor`; let it end there, the nearest point is (-0.3, 0)"},
          {floor_case("[[0.9, 0], [0.9, 0.6], [1.3, 0.6], [1.3, -0.2]]"),
           "the wall of grid `floor` bends at (1, 0), between the ends"},
          {rounded, "along the wall of grid \"floor\", which bends"},
          {floor_case("[[0.7, 0], [0.7, 0.6], [0.97, 0.6], [0.97, 0]]"),
           "reaches (1.014, 0) along the wall of grid \"floor\", which bends before; write `grid: {factor: "
           "8}` in "
           "place of 2 (tried: valid)"},
          // Grids as near as this has with a factor of 8 connect by round-off only: points of two grids coincide.
          {floor_case("[[0.7, 0], [0.7, 0.6], [0.98, 0.6], [0.98, 0]]"),
           "let the body stand farther from the bend (tried in vain: write `grid: {factor: 4}` in place of "
           "2; write `grid: {factor: 8}`"},
          {floor_case("[[0.7, 0], [0.7, 0.6], [0.99, 0.6], [0.99, 0]]"),
           "(tried in vain: write `grid: {factor: 4}` in place of 2"},
          {floor_case(panel, "[floor, floor]", "motion: free"), "nothing holds it there"}}) {
    const std::string message = mistake_in(text);
    EXPECT_NE(message.find(says), std::string::npos) << message << "\nexpected: " << says;
  }
}

/// The number after some words of a message, as written.
std::string number_after(const std::string& message, const std::string& words) {
  const std::size_t at = message.find(words);
  if (at == std::string::npos) return "";
  const std::size_t from = at + words.size();
  return message.substr(from, message.find('`', from) - from);
}

/// Corners that the gas's grid cannot follow are the body's.
TEST(Walls, RoundCornersOfABodyAreAmongWhatIsTriedForTheGas) {
  const std::string text =
      "time: {end: 1}\ngrid: {factor: 4}\nfluid:\n  grid: {x: [-2, 2], y: [-0.5, 1]}\n"
      "  boundary: {left: outflow, right: outflow, bottom: slip_wall, top: outflow}\n"
      "  initial: {rho: 1, v: [0, 0], p: 1}\n"
      "solids:\n  flap:\n    law: neo_hookean\n    rho: 1\n    E: 300\n    nu: 0.3\n"
      "    shape: {kind: polygon, radius: 0, corners: [[-0.22, -0.5], [0.06, 0.18], [0.22, -0.5]], walls: "
      "[bottom, bottom]}\n"
      "    boundary: {left: free, right: free, bottom: clamped, top: free}\n";
  const std::string message = mistake_in(text);
  EXPECT_NE(
      message.find("leave out `radius` of solids.flap.shape, whose corners are then rounded (tried: valid)"),
      std::string::npos)
      << message;
}

TEST(Walls, AnElasticBodyWithMoreThanFourSidesHasNoSharpCornersAndWhatIsToldWorks) {
  const auto box = [](const std::string& radius) {
    return "time: {end: 1}\ngrid: {factor: 2}\nsolids:\n  box:\n    law: neo_hookean\n    rho: 1\n    "
           "lambda: 1\n"
           "    mu: 1\n    body_fitted: {boundary: free}\n"
           "    shape: {kind: polygon, corners: [[0, 0], [1, 0], [1, 0.7], [0.5, 0.9], [0, 0.7]]" +
           radius + "}\n";
  };
  const std::string message = mistake_in(box(", radius: 0"));
  EXPECT_NE(message.find("sharp corner at (1, 0)"), std::string::npos) << message;
  EXPECT_NE(
      message.find("leave out `radius` of solids.box.shape, whose corners are then rounded (tried: valid)"),
      std::string::npos)
      << message;
  EXPECT_EQ(mistake_in(box("")), "");
}

/// An elastic ramp between two sides of the gas's rectangle.
std::string ramp_case(const std::string& right) {
  return "time: {end: 1}\n"
         "grid: {factor: 4}\n"
         "fluid:\n"
         "  grid: {x: [-1, 1], y: [0, 2], spacing: h}\n"
         "  body_fitted: [{name: strip, solid: ramp, walls: [bottom, right]}]\n"
         "  boundary: {left: outflow, right: outflow, bottom: slip_wall, top: outflow}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n"
         "solids:\n"
         "  ramp:\n"
         "    law: neo_hookean\n"
         "    rho: 1\n"
         "    lambda: 1\n"
         "    mu: 1\n"
         "    grid: {kind: mapped, map: [r, 0.2 * r - 0.1 * (1 - s)], points: [41, 9]}\n"
         "    boundary: {left: clamped, right: " +
         right + ", bottom: free, top: interface}\n";
}

TEST(Walls, ASolidMayNotLeaveTheSideItsInterfaceEndsOn) {
  for (const char* held : {"clamped", "slip_wall"}) EXPECT_EQ(mistake_in(ramp_case(held)), "") << held;
  const std::string message = mistake_in(ramp_case("free"));
  EXPECT_NE(message.find("ends at (1, 0.2) on the right side of fluid.grid, but nothing holds it there"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("write `right: slip_wall`"), std::string::npos) << message;
}

/// Where the gas meets a body along a side of its own grid.
TEST(Walls, AnEndOfASideMayNotLeaveTheWallOfTheGasBesideIt) {
  const auto mistake = [](const char* name, const std::vector<std::string>& sets) {
    try {
      load_case(std::string(FSI_ROOT "/configs/") + name, sets);
    } catch (const UserMistake& message) {
      return std::string(message.what());
    }
    return std::string();
  };
  for (const char* held : {"slip_wall", "symmetry", "clamped"}) {
    const std::string top = fmt::format("solids.solid.boundary.top={}", held);
    EXPECT_EQ(mistake("elastic_piston.yaml",
                      {top, "solids.solid.initial={v: [0, 0]}", "solids.solid.boundary.left=free"}),
              "")
        << held;
  }
  const std::string elastic = mistake("elastic_piston.yaml", {"solids.solid.boundary.top=free"});
  EXPECT_NE(
      elastic.find("solids.solid.boundary.top: the interface ends at (0, 1) on the top side of fluid.grid, "
                   "a wall, but nothing holds it there"),
      std::string::npos)
      << elastic;
  EXPECT_NE(elastic.find("write `top: slip_wall` (it slides along the wall) or `top: clamped`"),
            std::string::npos)
      << elastic;
  EXPECT_EQ(mistake("elastic_piston.yaml", {"solids.solid.boundary.top=free", "fluid.boundary.top=outflow"}),
            "");
  const std::string rigid = mistake("rigid_piston.yaml", {"solids.solid.boundary.bottom=free"});
  EXPECT_NE(rigid.find("write `motion: fixed`, or `bottom: slip_wall`"), std::string::npos) << rigid;
  EXPECT_EQ(mistake("rigid_piston.yaml", {"solids.solid.boundary.bottom=free", "solids.solid.motion=fixed"}),
            "");
}

/// A body in a gas with the grid of the gas around it as given.
std::string body_case(const std::string& law, const std::string& shape, const std::string& ring) {
  return "time: {end: 1}\ngrid: {factor: 2}\n"
         "fluid:\n"
         "  grid: {x: [-1.5, 1.5], y: [0, 2]}\n"
         "  boundary: {left: outflow, right: outflow, bottom: slip_wall, top: outflow}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n" +
         ring + "solids:\n  body:\n    rho: 1\n    law: " + law + "\n    shape: " + shape + "\n";
}

TEST(LinesAtBends, AreChosenCloseAndGivenOnesThatAreTooWideAreRefusedWithOnesThatHold) {
  const std::string law = "rigid\n    motion: fixed";
  const std::string wedge =
      "{kind: polygon, corners: [[-0.5, 0], [0.5, 0.2], [0.5, 0]], walls: [bottom, bottom]";
  struct Body {
    std::string shape, lines, says;
  };
  for (const auto& [shape, wide, says] :
       {Body{"{kind: polygon, corners: [[-0.3, 0.6], [0.3, 0.6], [0.3, 1.2], [-0.3, 1.2]], radius: 0.03}",
             "lines: 8, spacing: 0.05", "turns too sharply at ("},
        Body{wedge + "}", "lines: 8, spacing: 0.05", "turns too sharply at ("},
        Body{wedge + ", radius: 0.1, points: 240}", "lines: 12, spacing: 0.02", "too flat on the wall"}}) {
    const auto with = [&, shape = shape](const std::string& lines) {
      return body_case(law, shape, fmt::format("  body_fitted: [{{name: ring, solid: body, {}}}]\n", lines));
    };
    EXPECT_EQ(mistake_in(body_case(law, shape, "")), "");
    const std::string message = mistake_in(with(wide));
    EXPECT_NE(message.find(says), std::string::npos) << message;
    const std::string spacing = number_after(message, "`spacing: "),
                      lines = number_after(message, "`lines: ");
    ASSERT_FALSE(spacing.empty() || lines.empty()) << message;
    EXPECT_EQ(mistake_in(with(fmt::format("lines: {}, spacing: {}", lines, spacing))), "");
  }
}

/// The gas does not come to the sides of its rectangle: nothing is chosen for them.
TEST(ChosenGrids, OfABodyNearTheWallOfARoundTankAreItsOwnAndTheTanks) {
  const Case tank = load_text(
      "grid: {factor: 20}\n"
      "time: {end: 1}\n"
      "fluid:\n"
      "  grid: {x: [-0.22, 0.22], y: [-0.22, 0.22]}\n"
      "  boundary: {left: slip_wall, right: slip_wall, bottom: slip_wall, top: slip_wall}\n"
      "  initial: {rho: 1, v: [0, 0], p: 1}\n"
      "  body_fitted:\n"
      "    - {name: around, solid: ball}\n"
      "    - {name: tank, shape: {kind: circle, radius: 0.2}, inside: true}\n"
      "solids:\n"
      "  ball: {law: rigid, rho: 100, shape: {kind: circle, centre: [0.14, 0], radius: 0.04}}\n");
  EXPECT_EQ(tank.fluids.front().body_fitted.size(), 2);
}

/// A wall along the left side that bulges to x = -0.9.
TEST(Walls, ProbesNextToTheRimAreBeforeThemOrBehind) {
  const auto probe = [](const std::string& place) {
    return mistake_in(
        "grid: {factor: 2}\n"
        "time: {end: 1}\n"
        "fluid:\n"
        "  grid: {x: [-1, 1], y: [-1, 1]}\n"
        "  boundary: {left: slip_wall, right: outflow, bottom: slip_wall, top: slip_wall}\n"
        "  initial: {rho: 1, v: [0, 0], p: 1}\n"
        "  body_fitted: [{name: wall, shape: {kind: polygon, radius: 0, walls: [top, bottom], corners: "
        "[[-1, 1], [-1, -0.2], [-0.9, -0.5], [-1, -0.8], [-1, -1]]}}]\n"
        "output: {probes: [{name: a, in: fluid, " +
        place + "}]}\n");
  };
  for (const char* place : {"x: -0.93, y: 0.5", "x: -1, y: 0.5", "x: -0.93, y: -0.2", "x: 1, y: 1"})
    EXPECT_EQ(probe(place), "") << place;
  for (const char* place : {"x: -0.95, y: -0.5", "x: -1, y: -0.5"}) {
    EXPECT_NE(probe(place).find("lies behind the wall of grid `wall`"), std::string::npos) << place;
  }
}

/// Names of the grids in a closed square with a disk of radius 0.35, and with those that are written down before it.
std::vector<std::string> grids_about_a_disk_at(const std::string& centre, const std::string& others = "") {
  const Case problem = load_text(
      "grid: {factor: 2}\n"
      "time: {end: 1}\n"
      "fluid:\n"
      "  grid: {x: [-1, 1], y: [-1, 1]}\n"
      "  boundary: {left: slip_wall, right: slip_wall, bottom: slip_wall, top: slip_wall}\n"
      "  initial: {rho: 1, v: [0, 0], p: 1}\n"
      "  body_fitted:\n" +
      others + "    - {name: disk, shape: {kind: circle, radius: 0.35, centre: " + centre + "}}\n");
  std::vector<std::string> names;
  for (const BodyFittedSpec& ring : problem.fluids.front().body_fitted) names.push_back(ring.name);
  return names;
}

/// The disk above a floor between the left and the right side, with the square's bottom below it.
std::vector<std::string> grids_above(const std::string& floor, const std::string& centre = "[0, -0.35]") {
  return grids_about_a_disk_at(
      centre, "    - {name: floor, shape: {kind: polygon, radius: 0, walls: [left, right], corners: " +
                  floor + "}}\n");
}

/// Behind a wall that the file draws, and under one that lies along the side, the gas needs no grid.
TEST(ChosenGrids, OfABodyNearAWallThatIsDrawnAreNotLaidBehindIt) {
  const std::vector<std::string> own = {"floor", "disk"};
  EXPECT_EQ(grids_above("[[-1, -0.9], [1, -0.9]]"), own);
  EXPECT_EQ(grids_above("[[-1, -0.98], [1, -0.98]]"), own);
  EXPECT_EQ(grids_above("[[-1, -1], [0.2, -1], [0.5, -0.9], [0.8, -1], [1, -1]]", "[-0.5, -0.55]"), own);
  // Before a wall drawn at the opposite side there is gas down to the bottom.
  // The other way up, where the floor is a roof.
  EXPECT_EQ(grids_above("[[-1, 0.9], [1, 0.9]]", "[0, 0.35]"), own);
  const std::vector<std::string> strip = {"floor", "disk", "along_bottom"};
  EXPECT_EQ(grids_above("[[-1, 0.9], [1, 0.9]]", "[0, -0.55]"), strip);
}

/// Strips do not meet in corners; which wall gets one does not depend on how the case lies.
TEST(ChosenGrids, OfABodyNearTwoWallsAreLaidAlongTheNearerOne) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(grids_about_a_disk_at("[-0.5, -0.4]"), Names({"disk", "along_left"}));
  EXPECT_EQ(grids_about_a_disk_at("[-0.4, -0.5]"), Names({"disk", "along_bottom"}));
  EXPECT_EQ(grids_about_a_disk_at("[0.5, 0.4]"), Names({"disk", "along_right"}));
  EXPECT_EQ(grids_about_a_disk_at("[0.4, 0.5]"), Names({"disk", "along_top"}));
}

}  // namespace
}  // namespace fsi
