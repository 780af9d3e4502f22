// Shapes of solids and body-fitted grids in the case file.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/case/grids/composite_from_case.hpp"
#include "common/case/grids/curve_side.hpp"
#include "common/case/report/cost.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::load_text;
using tests::mistake_in;

/// A disk in a gas; SHAPE, RING and OUTLINE are replaced.
std::string disk_case(const std::string& shape, const std::string& ring = "{name: ring, solid: disk}",
                      const std::string& outline = "{lines: 8}") {
  return "time: {end: 1}\ngrid: {factor: 1}\n"
         "fluid:\n"
         "  grid: {x: [-2, 2], y: [-2, 2], spacing: h}\n"
         "  body_fitted: [" +
         ring +
         "]\n"
         "  boundary: {left: outflow, right: outflow, bottom: outflow, top: outflow}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n"
         "solids:\n  disk:\n    law: neo_hookean\n    rho: 1\n    lambda: 1\n    mu: 1\n"
         "    grid: {x: [-1, 1], y: [-1, 1], spacing: h}\n"
         "    shape: " +
         shape + "\n    body_fitted: " + outline + "\n";
}

const std::string disk_outline = "{kind: circle, radius: 0.9}";

TEST(CaseShape, GasAndSolidShareThePointsOfTheOutline) {
  const Case problem = load_text(disk_case(disk_outline));
  const BodyFittedSpec& gas = problem.fluids.front().body_fitted.at(0);
  const BodyFittedSpec& solid = problem.solids.at(0).body_fitted.at(0);
  EXPECT_EQ(gas.curve.x, solid.curve.x);
  EXPECT_EQ(gas.curve.points(), std::lround(2 * M_PI * 0.9 / 0.1) + 1);
  EXPECT_EQ(gas.side, Side::top);
  EXPECT_EQ(solid.side, Side::bottom);
  EXPECT_EQ(gas.boundary[static_cast<std::size_t>(Side::top)].kind, BoundaryKind::interface);
  EXPECT_EQ(gas.boundary[static_cast<std::size_t>(Side::left)].kind, BoundaryKind::periodic);
}

TEST(CaseShape, OverlappingGridsOfASolidAreStabilisedUnlessTheSchemeSaysOtherwise) {
  const auto scheme_with = [](const std::string& scheme) {
    return load_text(disk_case(disk_outline) + scheme).solids.at(0).scheme;
  };
  for (const std::string scheme : {"", "    scheme: {limiter: none}\n"}) {
    const SolidScheme found = scheme_with(scheme);
    EXPECT_GT(found.tangential_stress.scaled, 0) << scheme;
    EXPECT_GT(found.displacement.scaled, 0) << scheme;
    EXPECT_GT(found.relaxation.scaled, 0) << scheme;
  }
  const SolidScheme own = scheme_with("    scheme: {displacement: {scaled: 0}, relaxation: {rate: 2}}\n");
  EXPECT_EQ(own.displacement.scaled, 0);
  EXPECT_EQ(own.relaxation.scaled, 0);
  EXPECT_EQ(own.relaxation.rate, 2);
  EXPECT_GT(own.tangential_stress.scaled, 0);
}

TEST(CaseShape, TheBodyLiesToTheLeftWhateverTheOrderOfItsCorners) {
  const auto area = [](const std::string& corners) {
    const Case problem =
        load_text(disk_case("{kind: polygon, sharpness: 20, corners: " + corners + "}"), {"grid.factor=4"});
    const std::vector<double>& x = problem.solids.at(0).body_fitted.at(0).curve.x;
    const std::size_t n = x.size() / 2;
    double twice = 0;
    for (std::size_t k = 0; k + 1 < n; ++k) twice += x[k] * x[n + k + 1] - x[k + 1] * x[n + k];
    return 0.5 * twice;
  };
  const double one_way = area("[[-0.8, -0.8], [0.8, -0.8], [0.8, 0.8], [-0.8, 0.8]]");
  EXPECT_NEAR(one_way, 2.56, 0.2);  // less the rounded corners
  EXPECT_NEAR(area("[[-0.8, -0.8], [-0.8, 0.8], [0.8, 0.8], [0.8, -0.8]]"), one_way, 1e-12);
}

TEST(CaseShape, PointsOfAFileBecomePartOfTheResolvedCase) {
  const tests::TemporaryFolder folder;
  folder.write("outline.csv", "x, y\n0.8, 0\n0, 0.9\n-0.8, 0\n0, -0.9\n");
  const Case from_file =
      load_case(folder.write("case.yaml", disk_case("{kind: spline, file: outline.csv}")), {"grid.factor=2"});
  const Case inlined = load_text(
      disk_case("{kind: spline, through: [[0.8, 0], [0, 0.9], [-0.8, 0], [0, -0.9]]}"), {"grid.factor=2"});
  EXPECT_EQ(from_file.solids.at(0).body_fitted.at(0).curve.x, inlined.solids.at(0).body_fitted.at(0).curve.x);
  EXPECT_EQ(from_file.resolved.find("outline.csv"), std::string::npos);
}

TEST(CaseShape, AHeadingInAnotherUnitThanTheCasesIsRefused) {
  const tests::TemporaryFolder folder;
  const std::string points = "0.8, 0\n0, 0.9\n-0.8, 0\n0, -0.9\n";
  const auto with = [&](const std::string& heading, const std::string& units) {
    folder.write("outline.csv", heading + "\n" + points);
    try {
      load_case(folder.write("case.yaml", units + disk_case("{kind: spline, file: outline.csv}")),
                {"grid.factor=2"});
    } catch (const UserMistake& mistake) {
      return std::string(mistake.what());
    }
    return std::string();
  };
  const std::string SI = "units: SI\n";
  for (const char* heading :
       {"x_mm,y_mm", "# points x, y\nX [mm]; Y [mm]", "# x/mm y/mm", "x1 (mm) x2 (mm)"}) {
    EXPECT_NE(with(heading, SI).find("says mm, but with `units: SI` its numbers are metres"),
              std::string::npos)
        << heading << with(heading, SI);
    EXPECT_EQ(with(heading, ""), "") << heading;
  }
  for (const char* heading :
       {"x, y", "x_m,y_m", "# points x, y [m] of the outline in mm.csv", "x [m]; y [m]", "index mm"})
    EXPECT_EQ(with(heading, SI), "") << heading;
  EXPECT_EQ(with("# " + std::string(1'000'000, 'x'), SI), "");
}

/// Lines of a disk of radius 0.9 down to radius 0.2.
const std::string rings = "map: [(0.9 - 0.7 * s) * cos(2 * pi * r), (0.9 - 0.7 * s) * sin(2 * pi * r)]";

TEST(CaseShape, LinesOfABodyFittedGridMayBeGivenByAFormulaFromTheirCurve) {
  const Case problem =
      load_text(disk_case(disk_outline, "{name: ring, solid: disk}", "{lines: 8, " + rings + "}"));
  const BodyFittedSpec& fitted = problem.solids.at(0).body_fitted.at(0);
  const grid::MovingGrid grid(grid_of(fitted), 0);
  EXPECT_TRUE(grid.periodic(0));
  for (int j = 0; j < 8; ++j) {
    EXPECT_NEAR(std::hypot(grid.x()(0, 5, j), grid.x()(1, 5, j)), 0.9 - 0.1 * j, 1e-14);
  }
}

TEST(CaseShape, TheCoreBehindLinesThatAFormulaGivesIsChosen) {
  std::string text = disk_case(disk_outline, "{name: ring, solid: disk}", "{" + rings + "}");
  const std::string core = "    grid: {x: [-1, 1], y: [-1, 1], spacing: h}\n";
  text.erase(text.find(core), core.size());
  const Case problem = load_text(text);
  EXPECT_GT(problem.solids.at(0).grid.n1, 5);
  EXPECT_TRUE(problem.solids.at(0).body_fitted.at(0).map);
  EXPECT_EQ(load_text(problem.resolved).solids.at(0).grid.n1, problem.solids.at(0).grid.n1);
}

/// A dart whose tail at (1, 0) has an angle of 2 atan(0.1).
std::string dart_case(const std::string& more) {
  return "time: {end: 1}\ngrid: {factor: 2}\n"
         "fluid:\n"
         "  grid: {x: [-2, 3], y: [-2, 2]}\n"
         "  boundary: {left: outflow, right: outflow, bottom: outflow, top: outflow}\n"
         "  initial: {rho: 1, v: [0, 0], p: 1}\n"
         "solids:\n  dart:\n    law: rigid\n    rho: 1\n    motion: fixed\n"
         "    shape: {kind: polygon, corners: [[1, 0], [0, 0.1], [-0.05, 0], [0, -0.1]], radius: 0" +
         more + "}\n";
}

TEST(CaseShape, ATailThatIsCutOffIsToldAndWrittenDown) {
  const Case problem = load_text(dart_case(""));
  // Half of h = 0.05 wide, where its sides, 0.2 of their distance from it, are so far apart; of 1.05 in all.
  const std::string& told = problem.chosen.front();
  for (const std::string words : {"solids.dart.shape: blunt 0.025", "(1, 0)", " 0.125 is missing", " 12 %"})
    EXPECT_NE(told.find(words), std::string::npos) << words << " in " << told;
  EXPECT_TRUE(load_text(problem.resolved).chosen.empty());
  EXPECT_EQ(load_text(problem.resolved).solids.front().body_fitted.front().curve.x,
            problem.solids.front().body_fitted.front().curve.x);
  for (const std::string& line : load_text(dart_case(", blunt: 0.01")).chosen)
    EXPECT_EQ(line.find("blunt"), std::string::npos) << line;
}

/// A flap on the lower wall, thick `thick` and 1 high; `more`: keys of its shape.
std::string flap_case(const std::string& law, double thick, const std::string& more = "") {
  return fmt::format(
      "time: {{end: 1}}\ngrid: {{factor: 2}}\nparameters: {{d: {}}}\n"
      "fluid:\n"
      "  grid: {{x: [-2, 2], y: [0, 2]}}\n"
      "  boundary: {{left: outflow, right: outflow, bottom: slip_wall, top: outflow}}\n"
      "  initial: {{rho: 1, v: [0, 0], p: 1}}\n"
      "solids:\n  flap:\n    {}\n"
      "    shape: {{kind: polygon, corners: [[-0.5 * d, 0], [-0.5 * d, 1], [0.5 * d, 1], [0.5 * d, 0]], "
      "walls: [bottom, bottom]{}}}\n",
      thick, law, more);
}

TEST(CaseShape, TheCornersOfAThinPolygonAreSharpUnlessTheFileSaysOtherwise) {
  const std::string rigid = "law: rigid\n    rho: 1\n    motion: fixed",
                    elastic =
                        "law: neo_hookean\n    rho: 1\n    lambda: 1\n    mu: 1\n"
                        "    boundary: {left: free, right: free, bottom: clamped, top: free}",
                    beam =
                        "law: beam\n    rho: 1\n    E: 1\n    nu: 0.3\n"
                        "    beam: {line: [[0, 0], [0, 1]], thickness: d, ends: [clamped, free]}";
  const auto corners = [](const std::string& text) {
    return load_text(text).fluids.front().body_fitted.at(0).curve.corners.size();
  };
  for (const std::string& law : {rigid, elastic, beam}) {
    const Case problem = load_text(flap_case(law, 0.04));
    EXPECT_EQ(problem.fluids.front().body_fitted.at(0).curve.corners.size(), 2U) << law;
    EXPECT_LT(problem.fluids.front().body_fitted.at(0).curve.points(), 150) << law;  // rounded: 500
    EXPECT_NE(problem.chosen.front().find("solids.flap.shape: radius 0"), std::string::npos) << law;
    EXPECT_EQ(load_text(problem.resolved).chosen.size(), 0U) << law;
  }
  for (const std::string own : {", radius: 0.01", ", sharpness: 50"})
    EXPECT_EQ(corners(flap_case(rigid, 0.04, own)), 0U) << own;
  EXPECT_EQ(corners(flap_case(rigid, 0.15)), 0U);
  // With a hollow corner.
  EXPECT_EQ(corners(flap_case(rigid, 0.04)
                        .replace(flap_case(rigid, 0.04).find("[-0.5 * d, 1]"), 13,
                                 "[-0.5 * d, 0.5], [-0.4 * d, 0.7], [-0.5 * d, 1]")),
            0U);
}

TEST(CaseShape, WhoHasSharpCornersIsNotToldToRoundThemMore) {
  const auto advice = [](const std::string& corners) {
    const std::string text =
        cost_text(cost_of(load_text(flap_case("law: rigid\n    rho: 1\n    motion: fixed", 0.02, corners))));
    const std::size_t from = text.find("the others need");
    return from == std::string::npos ? "" : text.substr(from);
  };
  EXPECT_NE(advice(", sharpness: 50").find("round the outline"), std::string::npos);
  EXPECT_NE(advice(", radius: 0").find("write a greater"), std::string::npos) << advice(", radius: 0");
  EXPECT_EQ(advice(", radius: 0").find("round the outline"), std::string::npos) << advice(", radius: 0");
}

// The gas could take larger steps without a few cells of its own, but the solid would take as many.
TEST(CaseShape, AThinSolidThatTakesMostOfTheTimeIsNamedAndNotTheGas) {
  const auto advice = [](const std::string& corners, const std::string& end) {
    return cost_text(
        cost_of(load_text(flap_case("law: neo_hookean\n    rho: 1\n    lambda: 100\n    mu: 100\n    "
                                    "boundary: {left: free, right: free, bottom: clamped, top: free}",
                                    0.01, corners),
                          {"time.end=" + end, "time.multirate=true"})));
  };
  const std::string round = advice(", radius: 0.001", "20");
  EXPECT_NE(round.find("flap: takes most of the time: its sharpest bend and thinnest place ask for cells "),
            std::string::npos)
      << round;
  EXPECT_EQ(round.find("the others need"), std::string::npos) << round;
  EXPECT_EQ(advice(", radius: 0", "20").find("takes most of the time"), std::string::npos);
  EXPECT_EQ(advice(", radius: 0.001", "1e-3").find("takes most of the time"),
            std::string::npos);  // of a second
}

struct ShapeMistake {
  std::string text, part;
};

TEST(CaseShape, MistakesSayWhereAndWhatToWrite) {
  const ShapeMistake mistakes[] = {
      {disk_case(disk_outline, "{name: ring, solid: disc}"),
       "there is no solid `disc`; did you mean `disk`?"},
      {disk_case(disk_outline, "{name: ring}"), "give `solid` or `shape`, one of them"},
      {disk_case(disk_outline, "{name: ring, solid: disk}, {name: ring, solid: disk}"),
       "there are two grids `ring`"},
      {disk_case(disk_outline, "{name: fluid, solid: disk}"), "fluid.grid: there are two grids `fluid`"},
      {disk_case(disk_outline, "{name: wall, shape: {kind: circle, radius: 1.5}}"),
       "solid `disk` overlaps that of grid `wall`"},
      {disk_case(disk_outline, "{name: ring, solid: disk}", "{boundary: free}"), "must be an interface"},
      {disk_case(disk_outline, "{name: ring, solid: disk}", "{boundary: periodic}"), "no opposite side"},
      {disk_case(disk_outline, "{name: wall, shape: " + disk_outline + ", boundary: periodic}"),
       "no opposite side"},
      {disk_case(disk_outline,
                 "{name: wall, shape: " + disk_outline + ", boundary: {kind: interface, solid: disk}}"),
       "write `solid: NAME` in place of `shape`"},
      {disk_case("{kind: circle, radius: 0.9, walls: [bottom, top]}"), "a circle has no ends"},
      {disk_case("{kind: circle, radius: 0.9, points: 70, spacing: h}"),
       "`points` or `spacing`, one of them"},
      {disk_case("{kind: spline}"), "give `through: [[x, y], ..]` or `file: NAME.csv`"},
      {disk_case("{kind: spline, through: [[0.8, 0], [0, 0.9], [-0.8, 0], [0, -0.9]], file: nowhere.csv}"),
       "leave out one of them"},
      {disk_case("{kind: spline, file: nowhere.csv}"), "cannot be read"},
      {disk_case(disk_outline, "{name: ring, solid: disk}",
                 "{lines: 8, map: [(0.8 - 0.6 * s) * cos(2 * pi * r), (0.8 - 0.6 * s) * sin(2 * pi * r)]}"),
       "but point 0 of its curve is at (0.9, 0)"},
      {disk_case(disk_outline, "{name: ring, solid: disk}", "{spacing: h, " + rings + "}"),
       "`map` says where its lines are"},
      {disk_case("{kind: circle, radius: 1.3}"), "write at least x: [-1.3, 1.3], y: [-1.3, 1.3]"},
      {disk_case("{kind: circle, centre: [12345.6, 0], radius: 0.13}"),
       "write at least x: [12345.47, 12345.73], y: [-0.13, 0.13]"},
  };
  for (const ShapeMistake& mistake : mistakes) {
    const std::string message = mistake_in(mistake.text);
    EXPECT_NE(message.find(mistake.part), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with("case.yaml:")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(CaseShape, GridOfASolidHasAnotherNameThanTheOneAlongItsOutline) {
  EXPECT_EQ(mistake_in(disk_case(disk_outline), {"solids.disk.grid.name=inner"}), "");
  const std::string message = mistake_in(disk_case(disk_outline), {"solids.disk.grid.name=outline"});
  EXPECT_NE(message.find("there are two grids `outline`"), std::string::npos) << message;
}

/// What a case of configs/ says with other sides of its solid.
std::string with_side(const std::string& name, const std::string& side,
                      const std::vector<std::string>& laws = {}) {
  return mistake_in(tests::text_of_file(FSI_ROOT "/configs/" + name + ".yaml"), {"solids." + side}, laws);
}

TEST(CaseShape, LeavesSidesThatAreNoSideOfTheBodyFree) {
  const std::string idle =
      "is no side of the body, whose outline is `shape`, and would have no effect; write free; what "
      "holds on the outline of a body without a gas is `body_fitted: {boundary: ..}`, and a rigid body may "
      "be held";
  for (const char* side : {"bar.boundary.left=clamped", "bar.boundary.top=slip_wall",
                           "bar.boundary.right={kind: traction, value: [-5, 0]}"})
    EXPECT_NE(with_side("bar_on_wall", side).find(idle), std::string::npos) << with_side("bar_on_wall", side);
  EXPECT_NE(
      with_side("bar_on_wall", "bar.boundary.left=clamped").find(" solids.bar.boundary.left: is no side"),
      std::string::npos);
  EXPECT_EQ(with_side("bar_on_wall", "bar.boundary.right={kind: traction, value: [0, 0]}"), "");
  EXPECT_NE(with_side("beam", "beam.boundary.left=interface").find(idle), std::string::npos);
  EXPECT_NE(with_side("beam", "beam.boundary.left=clamped", {"beam=beam"}).find(idle), std::string::npos);
  const std::string of_disk = "    boundary: {left: free, right: free, bottom: clamped, top: free}\n";
  EXPECT_NE(mistake_in(disk_case(disk_outline) + of_disk).find("solids.disk.boundary.bottom: " + idle),
            std::string::npos);
}

TEST(CaseShape, StandsOnNoInterface) {
  const std::string bar = with_side("bar_on_wall", "bar.boundary.bottom=interface");
  EXPECT_NE(bar.find("solids.bar.boundary.bottom: the body stands on this side; write `bottom: clamped` or "
                     "`bottom: slip_wall`"),
            std::string::npos)
      << bar;
  const std::string rigid = with_side("beam", "beam.boundary.bottom=interface", {"beam=rigid"});
  EXPECT_NE(rigid.find("the body stands on this side; write `bottom: slip_wall`"), std::string::npos)
      << rigid;
}

/// The body is to the left of its outline: a hill from the right side to the left one has the bottom below it.
TEST(CaseShape, HasTheSidesBetweenTheEndsOfItsOutline) {
  const auto sides = [](Side first, Side last) {
    SolidSpec solid;
    solid.body_fitted.emplace_back();
    solid.body_fitted.front().curve.walls = std::array{first, last};
    return sides_of_body(solid);
  };
  EXPECT_EQ(sides(Side::bottom, Side::bottom), (std::vector{Side::bottom}));
  EXPECT_EQ(sides(Side::right, Side::left), (std::vector{Side::left, Side::bottom, Side::right}));
  EXPECT_EQ(sides(Side::right, Side::bottom), (std::vector{Side::bottom, Side::right}));
  EXPECT_EQ(sides(Side::left, Side::top), (std::vector{Side::top, Side::left}));
}

}  // namespace
}  // namespace fsi
