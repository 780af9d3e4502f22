// Curves that come near each other leave their grids as much room as there is between them.

#include "common/grid/geometry/near_curves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "common/grid/shapes/circle.hpp"

namespace fsi::grid {
namespace {

constexpr double h = 0.05;
constexpr int points = 64, lines = 8;

std::vector<double> circle_at(double x) {
  return points_on(circle({x, 0.01}, 0.5), points);
}

/// Two circles of radius 1/2, so far apart.
NearCurves two_circles(double gap) {
  return NearCurves({{circle_at(-0.5 - 0.5 * gap), h}, {circle_at(0.5 + 0.5 * gap), h}});
}

double least_of(std::span<const double> part) {
  return part.empty() ? 1 : *std::ranges::min_element(part);
}

TEST(NearCurves, LeaveAllDepthWhereNothingIsWithinReach) {
  const NearCurves near = two_circles(1.01 * NearCurves::onset * h);
  EXPECT_TRUE(near.part(0).empty());
  EXPECT_TRUE(near.part(1).empty());
  EXPECT_FALSE(near.nearest().gap.distance < 1);
}

TEST(NearCurves, HaveFiveLinesBetweenThemHoweverNearTheyAre) {
  for (const double gap : {3.0, 2.0, 1.0, 0.5}) {
    const NearCurves near = two_circles(gap * h);
    const double between =
        gap_between(circle_at(-0.5 - 0.5 * gap * h), circle_at(0.5 + 0.5 * gap * h)).distance;
    const double step = h * std::min(least_of(near.part(0)), least_of(near.part(1)));
    EXPECT_NEAR(NearCurves::lines_between * step, between, 1e-12) << gap;
    EXPECT_NEAR(near.nearest().gap.distance, between, 1e-12) << gap;
  }
}

TEST(NearCurves, DrawInTheirLinesWithoutJumpsAsTheyComeNear) {
  double before = 1;
  constexpr double step = 0.01;
  for (double gap = 7; gap > 0.5; gap -= step) {
    const double least = least_of(two_circles(gap * h).part(0));
    EXPECT_LE(least, before + 1e-12) << gap;
    EXPECT_LT(before - least, 1.1 * step / NearCurves::lines_between) << gap;  // no faster than the gap
    before = least;
  }
}

TEST(NearCurves, ThatTouchInTheBeginningStayOutOfIt) {
  const std::vector<double> floor{-1, 0, 1, 0, 0, 0}, post{0, 0, 0, 0, 0.5, 1};  // one stands on the other
  const NearCurves near({{floor, h}, {post, h}});
  EXPECT_TRUE(near.part(0).empty());
  EXPECT_TRUE(near.part(1).empty());
}

/// Grids around two circles on a background of spacing h.
struct TwoRings {
  std::vector<MovingGrid> grids;
  std::vector<BodyFittedGrid> bodies;
  CompositeGrid composite;

  explicit TwoRings(double gap)
      : bodies{{.name = "one", .n1 = points, .n2 = lines, .curve = Side::top, .of = "body `one`"},
               {.name = "two", .n1 = points, .n2 = lines, .curve = Side::top, .of = "body `two`"}},
        composite({.n1 = 81, .n2 = 61, .x_a = -2, .x_b = 2, .y_a = -1.5, .y_b = 1.5}, bodies) {
    for (const double side : {-1, 1}) {
      const HyperbolicGrid ring{.name = side < 0 ? "one" : "two",
                                .points = points,
                                .lines = lines,
                                .curve = Side::top,
                                .spacing = h};
      grids.emplace_back(marched_from(ring, circle_at(side * (0.5 + 0.5 * gap))), 0);
    }
  }
  NearCurves leave_room() { return grid::leave_room(std::vector{grids.data(), grids.data() + 1}, bodies, 0); }
  void connect() { composite.connect(std::vector{grids[0].x(), grids[1].x()}, 0); }
};

TEST(NearCurves, LetGridsConnectDownToHalfACell) {
  for (const double gap : {6.0, 4.0, 3.0, 2.0, 1.5, 1.0, 0.7, 0.5}) {
    TwoRings rings(gap * h);
    rings.leave_room();
    EXPECT_NO_THROW(rings.connect()) << gap;
    EXPECT_LE(rings.composite.record().amplification, CompositeGrid::sound_amplification) << gap;
  }
  TwoRings as_they_were(2 * h);
  EXPECT_THROW(as_they_were.connect(), Diverged);
}

TEST(NearCurves, NearerThanHalfACellAreNamedWithTheirDistance) {
  TwoRings rings(0.4 * h), farther(0.6 * h);
  EXPECT_NO_THROW(report_too_near(farther.leave_room(), farther.composite, 0));
  try {
    report_too_near(rings.leave_room(), rings.composite, 1.5);
    FAIL() << "nothing was said";
  } catch (const Diverged& told) {
    const std::string what = told.what();
    for (const char* word : {"t = 1.5", "body `one`", "body `two`", "0.0", "grid.factor"})
      EXPECT_NE(what.find(word), std::string::npos) << word << " in " << what;
  }
}

}  // namespace
}  // namespace fsi::grid
