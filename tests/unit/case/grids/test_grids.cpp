// Grids that a case leaves open, and what a run with them costs.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/case/grids/composite_from_case.hpp"
#include "common/case/report/cost.hpp"
#include "common/core/failure.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/geometry/quality.hpp"
#include "common/grid/moving_grid.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::load_text;
using tests::mistake_in;

constexpr auto head =
    "time: {end: 1}\ngrid: {factor: 2}\n"
    "fluid:\n"
    "  grid: {x: [-2, 2], y: [-2, 2]}\n"
    "  boundary: {left: outflow, right: outflow, bottom: slip_wall, top: outflow}\n"
    "  initial: {rho: 1, v: [0, 0], p: 1}\n";

/// Bodies in a gas, with nothing but their outlines; `more`: lines of each of them.
std::string bodies_case(const std::vector<std::string>& shapes, const std::string& more = "") {
  std::string text = std::string(head) + "solids:\n";
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    text += "  body_" + std::to_string(k) +
            ":\n    law: neo_hookean\n    rho: 1\n    lambda: 1\n    mu: 1\n    shape: " + shapes[k] + "\n" +
            more;
  }
  return text;
}

/// A rigid wall in a gas.
std::string wall_case(const std::string& corners, const std::string& walls) {
  return std::string(head) +
         "  body_fitted: [{name: wall, lines: 8, shape: {kind: polygon, corners: " + corners +
         ", walls: " + walls + "}}]\n";
}

const std::string circle = "{kind: circle, radius: 0.5}";

TEST(ChosenGrids, AnOutlineIsEnough) {
  for (const std::string shape :
       {"{kind: circle, radius: 0.5}", "{kind: circle, radius: 0.08}",
        "{kind: ellipse, semi_axes: [0.8, 0.2], angle: 30}",
        "{kind: polygon, corners: [[-0.6, -0.4], [0.7, -0.3], [0, 0.5]]}",
        "{kind: polygon, corners: [[-0.6, -0.4], [0.7, -0.4], [0.7, 0.2], [-0.6, 0.2]], radius: 0.05}",
        "{kind: spline, through: [[0.8, 0], [0.3, 0.3], [0, 0.8], [-0.3, 0.3], [-0.8, 0], [0, -0.4]]}"}) {
    const Case problem = load_text(bodies_case({shape}));
    ASSERT_EQ(problem.solids.size(), 1U);
    EXPECT_NO_THROW(connect_once(problem.solids[0].grid, problem.solids[0].body_fitted)) << shape;
    EXPECT_NO_THROW(connect_once(problem.fluids.front().grid, problem.fluids.front().body_fitted)) << shape;
    EXPECT_EQ(problem.chosen.size(), 3U) << shape;
    // What was chosen is in the resolved case, whose programs choose nothing any more.
    const Case again = load_text(problem.resolved);
    EXPECT_TRUE(again.chosen.empty()) << shape;
    EXPECT_EQ(again.digest, problem.digest) << shape;
    EXPECT_EQ(again.fluids.front().body_fitted[0].curve.x, problem.fluids.front().body_fitted[0].curve.x)
        << shape;
    EXPECT_EQ(again.solids[0].grid.x_b, problem.solids[0].grid.x_b) << shape;
  }
}

TEST(ChosenGrids, GentleOutlinesGetEightLinesAndACoreOneSpacingApart) {
  const Case problem = load_text(bodies_case({"{kind: circle, radius: 0.9}"}));
  const SolidSpec& solid = problem.solids[0];
  EXPECT_EQ(solid.body_fitted[0].lines, 8);
  EXPECT_NEAR(solid.body_fitted[0].spacing, 0.05, 1e-12);
  EXPECT_NEAR((solid.grid.x_b - solid.grid.x_a) / (solid.grid.n1 - 1), 0.05, 1e-4);
  EXPECT_EQ(problem.fluids.front().body_fitted[0].lines, 8);
  EXPECT_NEAR(problem.fluids.front().body_fitted[0].spacing, 0.05, 1e-12);
}

TEST(ChosenGrids, KeysThatAreGivenStay) {
  const Case own_lines = load_text(bodies_case({circle}, "    body_fitted: {lines: 6}\n"));
  EXPECT_EQ(own_lines.solids[0].body_fitted[0].lines, 6);
  const Case own_box = load_text(bodies_case({circle}, "    grid: {x: [-0.75, 0.75], y: [-0.6, 0.6]}\n"));
  EXPECT_EQ(own_box.solids[0].grid.x_a, -0.75);
  EXPECT_EQ(own_box.solids[0].grid.y_b, 0.6);
  const Case own_points = load_text(bodies_case({"{kind: circle, radius: 0.5, points: 91}"}));
  EXPECT_EQ(own_points.solids[0].body_fitted[0].curve.points(), 91);
  // With points in `grid` nothing of the solid is open: the defaults of its keys hold.
  const Case own_grid =
      load_text(bodies_case({circle}, "    grid: {x: [-0.5, 0.5], y: [-0.5, 0.5], spacing: 0.4 * h}\n"));
  EXPECT_EQ(own_grid.solids[0].body_fitted[0].lines, 8);
  EXPECT_EQ(own_grid.solids[0].body_fitted[0].spacing, 0.05);
}

TEST(ChosenGrids, BodiesNearEachOtherGetGridsThatConnect) {
  for (const double gap : {0.5, 0.25, 0.15, 0.1}) {
    const std::string left = "{kind: circle, centre: [-0.6, 0], radius: 0.5}";
    const std::string right = "{kind: circle, centre: [" + std::to_string(0.4 + gap) + ", 0], radius: 0.5}";
    EXPECT_EQ(mistake_in(bodies_case({left, right})), "") << gap;
  }
}

TEST(ChosenGrids, ABodyAtTheRimIsToldSoAndNotOfAnotherOne) {
  const std::string message = mistake_in(
      bodies_case({"{kind: circle, radius: 0.5}", "{kind: circle, centre: [1.48, 0], radius: 0.5}"}));
  EXPECT_NE(message.find("solid `body_1` is 0.02 from the rim of fluid.grid at (1.98, 0)"), std::string::npos)
      << message;
}

TEST(ChosenGrids, ABendThatTakesTooManyPointsIsNamedWithItsPlace) {
  const std::string message = mistake_in(bodies_case({"{kind: ellipse, semi_axes: [1.5, 0.01]}"}));
  EXPECT_NE(message.find("solids.body_0.shape: grids inside this outline would take"), std::string::npos)
      << message;
  EXPECT_NE(message.find("law: rigid"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(ChosenGrids, ASideDoesNotMeetABodyThatHasItsGrid) {
  std::string text = bodies_case({circle});
  const std::string side = "left: outflow";
  text.replace(text.find(side), side.size(), "left: {kind: interface, solid: body_0}");
  EXPECT_NE(
      mistake_in(text).find(
          "fluid.boundary.left: `body_0` meets the gas by its grid in `body_fitted`; write slip_wall or "
          "outflow here"),
      std::string::npos)
      << mistake_in(text);
}

/// Its outline takes 3727 points and a hundred lines, and none of fifty choices before connects: the watchdog of
/// this program ends it where each of them is looked at to its last line.
TEST(ChosenGrids, AVeryThinBodyIsDecidedSoon) {
  const Case problem = load_text(std::string(head) +
                                 "solids: {body: {law: rigid, rho: 10, shape: {kind: ellipse, semi_axes: "
                                 "[0.5722, 0.0178], angle: 159.3}}}\n");
  EXPECT_NEAR((problem.fluids.front().grid.x_b - problem.fluids.front().grid.x_a) /
                  (problem.fluids.front().grid.n1 - 1),
              0.015, 1e-4);
  EXPECT_EQ(problem.fluids.front().body_fitted[0].lines, 100);
  EXPECT_EQ(problem.fluids.front().body_fitted[0].spacing, 0.00049);
}

const std::string on_wall = "    boundary: {left: free, right: free, bottom: clamped, top: free}\n";

TEST(ChosenGrids, ABodyThatComesDownFlatOnItsWallTakesNoFinerGridsThanItsBends) {
  const Case problem = load_text(bodies_case(
      {"{kind: polygon, corners: [[0, -2], [1, -1.8], [1, -2]], walls: [bottom, bottom]}"}, on_wall));
  const GridSpec& core = problem.solids[0].grid;
  EXPECT_LT(core.n1 * core.n2, 100000);  // a sharp tip between its wall and a ring would take millions
}

TEST(ChosenGrids, ALowFootGetsTheFinerBackgroundThatItNeeds) {
  const std::string shape =
      "{kind: polygon, corners: [[-1, -2], [-1, -1.92], [1, -1.6], [1, -2]], walls: [bottom, bottom]}";
  EXPECT_EQ(mistake_in(bodies_case({shape}, on_wall)), "");
}

TEST(OpenOutlines, AWallIsTheSmallerPartOfTheGasWhicheverWayItIsListed) {
  // A ramp up from the lower left: gas above it.
  const Case up = load_text(wall_case("[[-2, -2], [0, -2], [2, -1.6]]", "[left, right]"));
  const Case back = load_text(wall_case("[[2, -1.6], [0, -2], [-2, -2]]", "[right, left]"));
  for (const Case* problem : {&up, &back}) {
    const BodyFittedSpec& wall = problem->fluids.front().body_fitted[0];
    EXPECT_EQ(wall.side, Side::top);
    EXPECT_GT(wall.curve.x.front(),
              wall.curve.x[static_cast<std::size_t>(wall.curve.points()) - 1]);  // right to left
    EXPECT_NO_THROW(connect_once(problem->fluids.front().grid, problem->fluids.front().body_fitted));
  }
  // The same ramp hanging from the top.
  const std::string under = wall_case("[[-2, 2], [0, 2], [2, 1.6]]", "[left, right]");
  EXPECT_NE(mistake_in(under).find("write `top: slip_wall`"), std::string::npos) << mistake_in(under);
  const Case hanging = load_text(under, {"fluid.boundary.top=slip_wall"});
  const BodyFittedSpec& wall = hanging.fluids.front().body_fitted[0];
  EXPECT_LT(wall.curve.x.front(), wall.curve.x[static_cast<std::size_t>(wall.curve.points()) - 1]);
}

TEST(OpenOutlines, EndsThatAreNotOnTheirWallAreNamedWithTheirDistance) {
  const std::string message = mistake_in(wall_case("[[-2, -1.9], [0, -2], [1.75, -1.5]]", "[left, right]"));
  EXPECT_NE(message.find("(1.75, -1.5), is 0.25 from the right side of fluid.grid, x = 2"), std::string::npos)
      << message;
}

std::string circle_above_the_floor(double gap) {
  return "{kind: circle, centre: [0, " + std::to_string(-2 + 0.5 + gap) + "], radius: 0.5}";
}

TEST(ChosenGrids, AWallThatABodyIsNearToGetsAGridAlongIt) {
  const Case near = load_text(bodies_case({circle_above_the_floor(0.1)}));  // two spacings
  ASSERT_EQ(near.fluids.front().body_fitted.size(), 2U);
  const BodyFittedSpec& strip = near.fluids.front().body_fitted[1];
  EXPECT_EQ(strip.name, "along_bottom");
  EXPECT_TRUE(strip.solid.empty());
  for (int k = 0; k < strip.curve.points(); ++k)
    EXPECT_NEAR(strip.curve.x[static_cast<std::size_t>(strip.curve.points() + k)], -2, 1e-12);
  EXPECT_NEAR(
      (near.fluids.front().grid.x_b - near.fluids.front().grid.x_a) / (near.fluids.front().grid.n1 - 1), 0.05,
      1e-9);
  EXPECT_NO_THROW(connect_once(near.fluids.front().grid, near.fluids.front().body_fitted));
  EXPECT_TRUE(load_text(near.resolved).chosen.empty());
  // No body near, no wall, or a grid that the file describes: none.
  EXPECT_EQ(load_text(bodies_case({circle_above_the_floor(0.6)})).fluids.front().body_fitted.size(), 1U);
  EXPECT_EQ(load_text(bodies_case({circle_above_the_floor(0.4)}), {"fluid.boundary.bottom=outflow"})
                .fluids.front()
                .body_fitted.size(),
            1U);
  EXPECT_EQ(load_text(bodies_case({circle_above_the_floor(0.4)}),
                      {"fluid.body_fitted=[{name: ring, solid: body_0, lines: 6}]"})
                .fluids.front()
                .body_fitted.size(),
            1U);
}

TEST(ChosenGrids, BodiesTwoSpacingsApartNeedNoFinerBackground) {
  const Case problem = load_text(bodies_case(
      {"{kind: circle, centre: [-0.55, 0], radius: 0.5}", "{kind: circle, centre: [0.55, 0], radius: 0.5}"}));
  EXPECT_NEAR((problem.fluids.front().grid.x_b - problem.fluids.front().grid.x_a) /
                  (problem.fluids.front().grid.n1 - 1),
              0.05, 1e-9);
  for (const BodyFittedSpec& ring : problem.fluids.front().body_fitted) EXPECT_NEAR(ring.spacing, 0.05, 1e-9);
}

TEST(ChosenGrids, GridsThatAmplifyErrorsAreRefusedWithARemedyThatConnects) {
  // Six lines 0.55 spacings apart: what they and the background take from each other is narrow.
  const std::string thin = bodies_case({"{kind: circle, centre: [0.013, 0.007], radius: 1}"});
  int refused = 0;
  for (const double spacing : {0.02, 0.0225, 0.025, 0.0275, 0.03}) {
    const std::string given =
        "fluid.body_fitted=[{name: ring, solid: body_0, lines: 6, spacing: " + std::to_string(spacing) + "}]";
    try {
      const Case fine = load_text(thin, {given});
      EXPECT_NO_THROW(connect_once(fine.fluids.front().grid, fine.fluids.front().body_fitted));
    } catch (const UserMistake& mistake) {
      ++refused;
      EXPECT_NE(std::string(mistake.what()).find("write `spacing: "), std::string::npos) << mistake.what();
    }
  }
  EXPECT_GT(refused, 0);
}

/// What a message says between two of its words.
std::string between(const std::string& message, const std::string& before, const std::string& after) {
  const std::size_t at = message.find(before);
  if (at == std::string::npos) return "";
  const std::size_t from = at + before.size(), to = message.find(after, from);
  return to == std::string::npos ? "" : message.substr(from, to - from);
}

TEST(ChosenGrids, OfABodyThatIsTooLargeForItsSpacingAreNotBlamedOnItsBends) {
  const std::string message = mistake_in(bodies_case({circle}), {"grid.factor=500"});
  const std::string times = between(message, "take grid.factor smaller, ", " times what it is");
  ASSERT_FALSE(times.empty()) << message;
  const double points_along_diameter = 10 * 500 * std::stod(times);
  EXPECT_LT(points_along_diameter * points_along_diameter, 4e6);
  EXPECT_GT(points_along_diameter * points_along_diameter, 2e6);
}

TEST(ChosenGrids, ABodyThatLiesOnAWallIsAskedWhetherItStandsThere) {
  for (const std::string& lying :
       {circle_above_the_floor(0), circle_above_the_floor(0.01),
        std::string("{kind: polygon, corners: [[-1, -2], [-1, -1], [0, -1], [0, -2]], radius: 0.1}")}) {
    const std::string message = mistake_in(bodies_case({lying}));
    EXPECT_NE(message.find("of the bottom side of the gas, less than half a cell"), std::string::npos)
        << message;
    EXPECT_NE(message.find("write `walls: [bottom, bottom]` into the shape"), std::string::npos) << message;
  }
}

/// The grids of a gas connect wherever the points of its background are: its bodies will be there.
void expect_connected_anywhere(const Case& problem, const std::vector<double>& ups) {
  const FluidSpec& gas = problem.fluids.front();
  const double dx = (gas.grid.x_b - gas.grid.x_a) / (gas.grid.n1 - 1),
               dy = (gas.grid.y_b - gas.grid.y_a) / (gas.grid.n2 - 1);
  for (const double right : {0.0, 0.25, 0.5, 0.75}) {
    for (const double up : ups) {
      GridSpec shifted = gas.grid;
      shifted.x_a += right * dx, shifted.x_b += right * dx;
      shifted.y_a += up * dy, shifted.y_b += up * dy;
      EXPECT_NO_THROW(connect_once(shifted, gas.body_fitted)) << right << ", " << up;
    }
  }
}

TEST(ChosenGrids, OfBodiesWithHollowCornersHoldWhereverTheyGo) {
  const std::string c =
      "{kind: polygon, corners: [[-.5, -.6], [.5, -.6], [.5, -.3], [-.2, -.3], [-.2, .3], [.5, .3], [.5, "
      ".6], [-.5, "
      ".6]], radius: 0.08}";
  for (const std::string law : {"neo_hookean", "rigid"})
    expect_connected_anywhere(load_text(bodies_case({c}), {"grid.factor=4"}, {"body_0=" + law}),
                              {0, 0.25, 0.5, 0.75});
}

TEST(ChosenGrids, AtAFootThatLeansHoldWhereverItGoesAlongItsWall) {
  const std::string chevron =
      "{kind: polygon, corners: [[0, -2], [.5, -1.5], [0, -1], [.4, -1], [.9, -1.5], [.4, -2]], radius: 0.1, "
      "walls: "
      "[bottom, bottom]}";
  const Case problem = load_text(bodies_case({chevron}, on_wall));
  expect_connected_anywhere(problem, {0});
  // Two rows up its side is two points nearer: a point of the wall beside the foot has a donor two by two from there.
  const FluidSpec& gas = problem.fluids.front();
  const BodyFittedSpec& ring = gas.body_fitted[0];
  const grid::MovingGrid grid(grid_of(ring), 0);
  const double h = (gas.grid.x_b - gas.grid.x_a) / (gas.grid.n1 - 1);
  const int line = ring.side == Side::top ? 2 : ring.lines - 3;
  for (const int end : {0, grid.layout().n1 - 1})
    EXPECT_GE(grid::distance_to(ring.curve.x, Vec2(grid.x()(0, end, line), grid.x()(1, end, line))),
              std::sqrt(8.0) * h);
}

TEST(ChosenGrids, OfBodiesThatDeformHaveSoundCells) {
  const Case problem = load_text(
      bodies_case({"{kind: polygon, corners: [[1, -2], [1, -1.6], [.4, -1.6], [.4, -1], [0, -1], [0, -2]], "
                   "radius: 0.1, walls: [bottom, bottom]}"},
                  on_wall));
  const grid::MovingGrid ring(grid_of(problem.fluids.front().body_fitted[0]), 0);
  EXPECT_GT(grid::cell_quality(ring.x()), 0.25);
}

/// What a valid case with a circle takes [s], of processor time.
double time_of_a_circle() {
  const double before = tests::processor_time();
  load_text(bodies_case({circle}));
  return tests::processor_time() - before;
}

TEST(RemediesForGrids, NumbersThatAreLeftOutAreToldOnlyWhereTheCaseIsThenValid) {
  const std::string deep = bodies_case({circle}, "    body_fitted: {lines: 20, spacing: 0.05}\n");
  const double usual = time_of_a_circle(), before = tests::processor_time();
  const std::string message = mistake_in(deep);
  EXPECT_LT(tests::processor_time() - before, 300 * usual);  // no core is tried between lines that meet
  EXPECT_NE(message.find(
                "leave out `grid` and `body_fitted` of solids.body_0, which are then chosen (tried: valid)"),
            std::string::npos)
      << message;
  EXPECT_EQ(mistake_in(bodies_case({circle})), "");
  const std::string rings = mistake_in(
      bodies_case({circle}), {"fluid.body_fitted=[{name: ring, solid: body_0, lines: 5, spacing: 0.001}]"});
  EXPECT_NE(rings.find("(tried: valid)"), std::string::npos) << rings;
  EXPECT_NE(rings.find("leave out `lines` and `spacing` in fluid.body_fitted"), std::string::npos) << rings;
}

TEST(RemediesForGrids, ARigidOutlineWithAHollowSideIsToldSharpCornersBeforeAFinerGrid) {
  const std::string foil =
      bodies_case({"{kind: polygon, corners: [[-0.5, 0.02], [-0.45, -0.02], [-0.3, -0.03], [0, 0], "
                   "[0.5, -0.02], [0, 0.09], [-0.3, 0.09], [-0.45, 0.06]]}"});
  const std::string message = mistake_in(foil, {}, {"body_0=rigid"});
  EXPECT_NE(message.find("write `radius: 0` in solids.body_0.shape, for sharp corners (tried: valid)"),
            std::string::npos)
      << message;
}

TEST(RemediesForGrids, ALowFootOfWhichNoNumberIsGivenIsToldTheFactorWithWhichItIsValid) {
  const std::string foot = bodies_case(
      {"{kind: polygon, corners: [[-1, -2], [-1, -1.98], [0, -1.8], [0, -2]], walls: [bottom, bottom]}"},
      "    boundary: {left: free, right: free, bottom: clamped, top: free}\n");
  const std::string message = mistake_in(foot);
  EXPECT_EQ(message.find("leave"), std::string::npos) << message;  // nothing was given
  const std::string factor = between(message, "write `grid: {factor: ", "}` in place of 2 (tried: valid)");
  ASSERT_FALSE(factor.empty()) << message;
  EXPECT_EQ(mistake_in(foot, {"grid.factor=" + factor}), "");
}

TEST(RemediesForGrids, ASpikeOfAWallIsToldTheLinesThatHoldItsTip) {
  std::string spike =
      wall_case("[[-2, -2], [0, -2], [0.05, -1.5], [0.1, -2], [2, -1.6]], radius: 0", "[left, right]");
  const std::string message = mistake_in(spike);
  const std::string spacing = between(message, "write `spacing: ", "` for grid `wall`"),
                    lines = between(message, "with `lines: ", "`");
  ASSERT_FALSE(spacing.empty() || lines.empty()) << message;
  spike.replace(spike.find("lines: 8"), 8, "lines: " + lines + ", spacing: " + spacing);
  EXPECT_EQ(mistake_in(spike), "");
}

TEST(RemediesForGrids, ATipThatIsTooFlatIsNotToldToBeStiffer) {
  const std::string message = mistake_in(
      bodies_case({"{kind: polygon, corners: [[0, -2], [1, -1.95], [1, -2]], walls: [bottom, bottom]}"},
                  "    boundary: {left: free, right: free, bottom: clamped, top: free}\n"));
  EXPECT_NE(message.find("degrees above its wall"), std::string::npos) << message;
  EXPECT_EQ(message.find("stiffer"), std::string::npos) << message;
}

TEST(RemediesForGrids, CornersThatAreRoundedThroughTheirWallAreNamedAndNotTheBoxThatWasChosen) {
  const double usual = time_of_a_circle(), before = tests::processor_time();
  const std::string message = mistake_in(
      bodies_case({"{kind: polygon, corners: [[0, -2], [1, -1.98], [1, -2]], walls: [bottom, bottom]}"},
                  "    boundary: {left: free, right: free, bottom: clamped, top: free}\n"));
  EXPECT_NE(message.find("its corners are rounded so far that the outline reaches ("), std::string::npos)
      << message;
  EXPECT_EQ(message.find("this box"), std::string::npos) << message;
  // No grids are tried for a curve that leaves the rectangle, with none of the remedies; they would take thousands of times
  // as long.
  EXPECT_LT(tests::processor_time() - before, 300 * usual);
}

}  // namespace
}  // namespace fsi
