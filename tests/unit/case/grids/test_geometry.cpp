// Bodies that are in each other's way, or out of their grids.

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::load_text;
using tests::mistake_in;

/// What the tests replace in a case of two disks in a gas.
struct TwoBodies {
  std::string left = "{kind: circle, centre: [-1, 0], radius: 0.5}";
  std::string right = "{kind: circle, centre: [1, 0], radius: 0.5}";
  std::string box = "{x: [-1.5, -0.5], y: [-0.5, 0.5], spacing: 0.5 * h}";  ///< of the left one
  std::string fitted = "{lines: 6, spacing: 0.5 * h}";                      ///< of the left one
};

std::string text_of(const TwoBodies& bodies) {
  const auto solid = [](const std::string& name, const std::string& box, const std::string& shape,
                        const std::string& fitted) {
    return "  " + name + ":\n    law: neo_hookean\n    rho: 1\n    lambda: 1\n    mu: 1\n    grid: " + box +
           "\n    shape: " + shape + "\n    body_fitted: " + fitted + "\n";
  };
  return "time: {end: 1}\ngrid: {factor: 2}\n"
         "fluid:\n"
         "  grid: {x: [-2.5, 2.5], y: [-2, 2], spacing: h}\n"
         "  body_fitted:\n    - {name: ring_a, solid: a}\n    - {name: ring_b, solid: b}\n"
         "  boundary: {left: outflow, right: outflow, bottom: outflow, top: outflow}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n"
         "solids:\n" +
         solid("a", bodies.box, bodies.left, bodies.fitted) +
         solid("b", "{x: [-2, 3], y: [-1, 1], spacing: 0.5 * h}", bodies.right,
               "{lines: 6, spacing: 0.5 * h}");
}

/// Places in the file above.
const std::string ring_b = "case.yaml:7:7: ", grid_a = "case.yaml:16:11: ", shape_a = "case.yaml:17:12: ",
                  fitted_a = "case.yaml:18:18: ", shape_b = "case.yaml:25:12: ";

void expect_mistake(const TwoBodies& bodies, const std::string& beginning, const std::string& part) {
  const std::string message = mistake_in(text_of(bodies));
  EXPECT_TRUE(message.starts_with(beginning)) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

/// The number behind a word of a message.
double value_after(const std::string& message, const std::string& words) {
  const std::size_t at = message.find(words);
  return at == std::string::npos ? 0 : std::stod(message.substr(at + words.size()));
}

std::string disk_at(double x) {
  return "{kind: circle, centre: [" + std::to_string(x) + ", 0], radius: 0.5}";
}

TEST(CaseGeometry, TwoDisksApartAreFine) {
  EXPECT_EQ(mistake_in(text_of({})), "");
}

/// The grid that is chosen inside a disk.
GridSpec core_at(const std::string& x) {
  return load_text("parameters: {X: " + x +
                   "}\ntime: {end: 1}\ngrid: {factor: 2}\n"
                   "fluid:\n"
                   "  grid: {x: [X - 2, X + 2], y: [-2, 2]}\n"
                   "  boundary: {left: outflow, right: outflow, bottom: outflow, top: outflow}\n"
                   "  initial: {rho: 1, v: [0, 0], p: 1}\n"
                   "solids:\n  a: {law: neo_hookean, rho: 1, lambda: 1, mu: 1, shape: {kind: circle, "
                   "centre: [X, 0], radius: 0.5}}\n")
      .solids[0]
      .grid;
}

TEST(CaseGeometry, GridsAreChosenFarFromTheOriginAsTheyAreThere) {
  const GridSpec near = core_at("0"), far = core_at("2e6");
  const double hundredth = 0.01 * (near.x_b - near.x_a) / (near.n1 - 1);
  EXPECT_EQ(far.n1, near.n1);
  EXPECT_NEAR(far.x_a - 2e6, near.x_a, 2 * hundredth);
  EXPECT_NEAR(far.x_b - 2e6, near.x_b, 2 * hundredth);
}

TEST(CaseGeometry, SolidsThatOverlapAreNamedWithHowFar) {
  const TwoBodies bodies{.right = disk_at(-0.2)};
  expect_mistake(bodies, shape_b + "solids.b.shape: ", "solid `b` overlaps that of solid `a` by ");
  // Centres 0.8 apart, radii 0.5: the rims are 0.2 within each other, up to a chord's height.
  EXPECT_NEAR(value_after(mistake_in(text_of(bodies)), "overlaps that of solid `a` by "), 0.2, 2e-3);
}

TEST(CaseGeometry, OneSolidWithinAnotherOverlapsItToo) {
  const TwoBodies bodies{.right = "{kind: circle, centre: [-1, 0], radius: 0.3}"};
  expect_mistake(bodies, shape_b + "solids.b.shape: ", "solid `b` overlaps that of solid `a` by 0.2 ");
}

TEST(CaseGeometry, SolidsOfOneOutlineAreOnEachOther) {
  const TwoBodies bodies{.right = disk_at(-1)};
  expect_mistake(bodies, shape_b + "solids.b.shape: ", "solid `b` is on that of solid `a` at ");
}

TEST(CaseGeometry, SolidsNearerThanTheirGridsAreToldTheDistanceThatIsEnough) {
  const TwoBodies near{.right = disk_at(0.02)};
  expect_mistake(near, ring_b + "fluid.body_fitted[1]: ", "solid `b` and solid `a` are 0.02");
  const double enough = value_after(mistake_in(text_of(near)), "move them ");
  EXPECT_EQ(mistake_in(text_of({.right = disk_at(enough + 1e-3)})), "");
}

TEST(CaseGeometry, SolidBeyondTheGasSaysWhichSideAndHowFar) {
  expect_mistake({.right = disk_at(2.2)}, shape_b + "solids.b.shape: ",
                 "reaches (2.7, 0), 0.2 beyond the right side of fluid.grid, x = 2.5");
}

TEST(CaseGeometry, SolidNearTheRimOfTheGasIsToldTheDistanceThatIsEnough) {
  const TwoBodies near{.right = disk_at(1.95)};
  expect_mistake(near, ring_b + "fluid.body_fitted[1]: ", "solid `b` is 0.05 from the rim of fluid.grid");
  const double enough = value_after(mistake_in(text_of(near)), ", or leave ");
  EXPECT_EQ(mistake_in(text_of({.right = disk_at(2 - enough - 1e-3)})), "");
}

TEST(CaseGeometry, BoxOfASolidThatDoesNotHoldItsShapeIsToldTheOneThatDoes) {
  TwoBodies bodies{.box = "{x: [-1.5, -0.6], y: [-0.5, 0.5], spacing: 0.5 * h}"};
  const std::string remedy = "x: [-1.5, -0.5], y: [-0.5, 0.5]";
  expect_mistake(bodies, grid_a + "solids.a.grid: ", "0.1 beyond its right side; write at least " + remedy);
  bodies.box = "{" + remedy + ", spacing: 0.5 * h}";
  EXPECT_EQ(mistake_in(text_of(bodies)), "");
}

TEST(CaseGeometry, OutlineThatCrossesItselfSaysWhichListedPointsAreOutOfOrder) {
  const TwoBodies bodies{.left =
                             "{kind: polygon, sharpness: 100, corners: [[-1.4, -0.4], [-0.6, 0.4], [-0.6, "
                             "-0.4], [-1.4, 0.4]]}"};
  expect_mistake(bodies, shape_a + "solids.a.shape: ",
                 "crosses itself near (-1, 0), where the line from its point 1 (-1.4, -0.4) to 2 (-0.6, 0.4) "
                 "meets that from its point 3 (-0.6, -0.4) to 4 (-1.4, 0.4)");
}

TEST(CaseGeometry, AnOutlineThatCrossesItselfIsSaidBeforeGridsAreChosenForIt) {
  const TwoBodies bodies{.left =
                             "{kind: polygon, radius: 0.05, corners: [[-1.4, -0.4], [-0.6, 0.4], [-0.6, "
                             "-0.4], [-1.4, 0.4]]}"};
  std::string text = text_of(bodies);
  for (const std::string& given :
       {"    grid: " + bodies.box + "\n", "    body_fitted: " + bodies.fitted + "\n"})
    text.erase(text.find(given), given.size());
  const std::string message = mistake_in(text);
  EXPECT_NE(message.find("solids.a.shape: the outline crosses itself near (-1, 0)"), std::string::npos)
      << message;
}

// The arc in the notch ends above the bottom that its corner lies below.
TEST(CaseGeometry, CornersWhoseLinesCrossAreRefusedThoughTheirArcsCutThatOff) {
  const TwoBodies bodies{
      .left =
          "{kind: polygon, radius: 0.01, corners: [[-1.4, -0.4], [-0.6, -0.4], [-0.6, 0.4], "
          "[-0.9, 0.4], [-1, -0.404], [-1.1, 0.4], [-1.4, 0.4]]}"};
  expect_mistake(bodies, shape_a + "solids.a.shape: ",
                 "where the line from its point 1 (-1.4, -0.4) to 2 (-0.6, -0.4) meets that from its point 5 "
                 "(-1, -0.404) to 6");
}

TEST(CaseGeometry, TooCoarseACoreIsToldTheSpacingThatConnects) {
  TwoBodies bodies{.box = "{x: [-1.5, -0.5], y: [-0.5, 0.5], spacing: h}",
                   .fitted = "{lines: 6, spacing: 0.25 * h}"};
  expect_mistake(bodies, grid_a + "solids.a.grid: ", "the points of `grid` are too far apart");
  const double spacing = value_after(mistake_in(text_of(bodies)), "write `spacing: ");
  EXPECT_LT(spacing, 0.05);
  bodies.box = "{x: [-1.5, -0.5], y: [-0.5, 0.5], spacing: " + std::to_string(spacing) + "}";
  EXPECT_EQ(mistake_in(text_of(bodies)), "");
}

TEST(CaseGeometry, TooDeepAGridInASolidIsToldTheLinesThatFit) {
  TwoBodies bodies{.fitted = "{lines: 40, spacing: 0.5 * h}"};  // deeper than the radius
  expect_mistake(bodies, fitted_a + "solids.a.body_fitted: ", "write `lines: ");
  const int lines = static_cast<int>(value_after(mistake_in(text_of(bodies)), "write `lines: "));
  EXPECT_LE((lines - 1) * 0.025, 0.6 * 0.5);
  bodies.fitted = "{lines: " + std::to_string(lines) + ", spacing: 0.5 * h}";
  EXPECT_EQ(mistake_in(text_of(bodies)), "");
}

TEST(CaseGeometry, BeamHigherThanItsChannelIsToldSo) {
  try {
    load_case("beam", {"parameters.height=1.6"});
    ADD_FAILURE() << "nothing was said";
  } catch (const std::exception& mistake) {
    const std::string message = mistake.what();
    EXPECT_NE(message.find("solids.beam.shape: the outline of solid `beam` reaches (0, "), std::string::npos)
        << message;
    EXPECT_NE(message.find("beyond the top side of fluid.grid, y = 1.5"), std::string::npos) << message;
  }
}

/// A gas above a layer, or a wall, from the left side of its rectangle to the right one.
std::string gas_above(const std::string& y, const std::string& bottom, const std::string& curve,
                      const std::string& more = "") {
  return "time: {end: 1}\n"
         "grid: {factor: 2}\n"
         "fluid:\n"
         "  grid: {x: [0, 1], y: " +
         y +
         "}\n"
         "  body_fitted: [{name: strip, " +
         curve +
         "}]\n"
         "  boundary: {left: slip_wall, right: slip_wall, bottom: " +
         bottom +
         ", top: slip_wall}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n" +
         more;
}

const std::string layer =
    "solids:\n"
    "  panel:\n"
    "    law: linear_elastic\n"
    "    rho: 2\n"
    "    lambda: 2\n"
    "    mu: 2\n"
    "    grid: {x: [0, 1], y: [-0.2, 0], spacing: h}\n"
    "    boundary: {left: slip_wall, right: slip_wall, bottom: clamped, top: interface}\n";

// The gas of the rim would go its own way there.
TEST(Rim, CurvesAlongItAreRefusedUnlessTheyAreTheSameWall) {
  const std::string at_layer = "solid: panel, walls: [left, right]";
  const std::string message = mistake_in(gas_above("[0, 1]", "slip_wall", at_layer, layer));
  EXPECT_NE(message.find(
                "fluid.body_fitted[0]: the curve of grid `strip` lies along the bottom side of fluid.grid"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("`y: [-0.2, 1]`"), std::string::npos) << message;
  EXPECT_EQ(mistake_in(gas_above("[-0.2, 1]", "slip_wall", at_layer, layer)), "");
  const std::string floor =
      "shape: {kind: polygon, radius: 0, corners: [[0, 0], [1, 0]], walls: [left, right]}";
  EXPECT_NE(mistake_in(gas_above("[0, 1]", "outflow", floor)), "");
  EXPECT_EQ(mistake_in(gas_above("[0, 1]", "slip_wall", floor)), "");
}

TEST(OpenCurve, ThatCutsTheRectangleIntoHalvesIsRefused) {
  for (const char* corners : {"[[0, 0], [1, 0]]", "[[1, 0], [0, 0]]"}) {
    const std::string walls = corners[2] == '0' ? "[left, right]" : "[right, left]";
    const std::string floor =
        std::string("shape: {kind: polygon, radius: 0, corners: ") + corners + ", walls: " + walls + "}";
    const std::string message = mistake_in(gas_above("[-1, 1]", "slip_wall", floor));
    EXPECT_NE(message.find("fluid.body_fitted[0].shape: cuts the rectangle of the gas into halves"),
              std::string::npos)
        << message;
    EXPECT_EQ(mistake_in(gas_above("[-0.9, 1]", "slip_wall", floor)), "");
  }
}

}  // namespace
}  // namespace fsi
