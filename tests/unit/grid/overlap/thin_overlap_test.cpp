// Grids that overlap so little that many points are donors of each other.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "common/grid/shapes/circle.hpp"
#include "common/grid/shapes/rounded_polygon.hpp"

namespace fsi::grid {
namespace {

/// +1 and -1 in turn: the roughest field there is.
double rough(double x, double y) {
  return std::sin(1e4 * x + 2e4 * y) > 0 ? 1 : -1;
}

/// A field on all points of a grid.
Field rough_field(const CompositeGrid& grids, int grid, ConstFieldView x) {
  Field field(grids.layout(grid), 1);
  for (int j = 0; j < field.layout().n2; ++j) {
    for (int i = 0; i < field.layout().n1; ++i) {
      const Vec2 p = grid == 0 ? grids.background().point(i, j) : Vec2(x(0, i, j), x(1, i, j));
      field(0, i, j) = rough(p[0], p[1]);
    }
  }
  return field;
}

/// The largest value that interpolation makes of the rough field.
double largest_interpolated(const CompositeGrid& grids, ConstFieldView x) {
  std::vector<Field> fields;
  for (int grid = 0; grid < grids.grids(); ++grid) fields.push_back(rough_field(grids, grid, x));
  std::vector<FieldView> views;
  for (Field& field : fields) views.push_back(field.view());
  grids.interpolate(views);
  double most = 0;
  for (const InterpolationList& list : grids.interpolation()) {
    for (const std::int32_t at : list.target)
      most = std::max(most, std::abs(views[static_cast<std::size_t>(list.target_grid)].plane(0)[at]));
  }
  return most;
}

TEST(ThinOverlap, DoesNotAmplifyErrors) {
  constexpr double h = 0.05;
  std::size_t implicit = 0, narrowed = 0;
  for (const double part : {0.55, 0.6, 0.65, 0.7, 0.8}) {
    const HyperbolicGrid ring{.name = "thin",
                              .points = static_cast<int>(2 * std::numbers::pi / h) + 1,
                              .lines = 6,
                              .curve = Side::top,
                              .spacing = part * h};
    Field x(Layout(ring.points, ring.lines), 2);
    HyperbolicMarch(ring).march(points_on(circle({0.013, 0.007}, 1), ring.points), x.view(), 0);
    CompositeGrid grids({.n1 = 81, .n2 = 81, .x_a = -2, .x_b = 2, .y_a = -2, .y_b = 2},
                        {{.name = "thin", .n1 = ring.points, .n2 = ring.lines, .curve = Side::top}});
    const ConstFieldView views[] = {x.view()};
    try {
      grids.connect(views, 0);
    } catch (const Diverged&) {
      continue;  // too thin for any donor
    }
    implicit += grids.counts().implicit;
    narrowed += grids.counts().narrowed;
    // 25/8 is what the grids settle for, as a bound on weights;
    // 25/16 what three known donors per direction have.
    EXPECT_LE(largest_interpolated(grids, views[0]), 25.0 / 8) << part;
  }
  EXPECT_GT(implicit, 0U);
  EXPECT_GT(narrowed, 0U);  // with three donors per direction everywhere errors would grow
}

TEST(ThinOverlap, ABodyThatHasComeToTheRimIsNamedWithItsDistance) {
  constexpr double h = 0.05;
  const HyperbolicGrid ring{.name = "ring", .points = 127, .lines = 8, .curve = Side::top, .spacing = h};
  HyperbolicMarch march(ring);
  Field x(march.layout(), 2);
  march.march(points_on(circle({0, 0}, 1), ring.points), x.view(), 0);
  const auto message = [&](double right, double t) -> std::string {
    CompositeGrid grids(
        {.name = "gas", .n1 = 81, .n2 = 81, .x_a = right - 4, .x_b = right, .y_a = -2, .y_b = 2},
        {{.name = "ring", .n1 = ring.points, .n2 = 8, .curve = Side::top, .of = "body `disk`"}});
    const ConstFieldView views[] = {x.view()};
    try {
      grids.connect(views, t);
    } catch (const Diverged& broke) {
      return broke.what();
    }
    return "";
  };
  EXPECT_EQ(message(1.5, 1), "");
  const std::string later = message(1.04, 1), first = message(1.04, 0);
  EXPECT_NE(later.find("; body `disk` has come within "), std::string::npos) << later;
  EXPECT_EQ(later.find("within 3 cells"), std::string::npos)
      << later;  // of which it says that they are enough
  EXPECT_NE(later.find("let the run end before"), std::string::npos) << later;
  EXPECT_NE(later.find("let the rectangle reach farther; if that side is a wall, give it a grid along it in"),
            std::string::npos)
      << later;
  EXPECT_NE(first, "");
  EXPECT_EQ(first.find("has come"), std::string::npos) << first;  // in the beginning nothing has come yet
}

/// A flap that stands on the bottom, y = 0, and hangs over to the right until its tip is near it.
std::vector<double> hanging_flap(int points, double low) {
  return points_on(
      rounded_polygon(
          {.corners = {{-0.4, 0}, {-0.4, 1.2}, {1, 1.2}, {1, low}, {0.6, low}, {0.6, 0.8}, {0, 0.8}, {0, 0}},
           .radius = 0.15}),
      points);
}

/// One whose belly lies on the wall beside its foot, but for a sliver of gas.
std::vector<double> crouching_flap(int points) {
  return points_on(
      rounded_polygon({.corners = {{-0.4, 0}, {-0.4, 1.2}, {0.35, 1.2}, {0.35, 0.06}, {0, 0.06}, {0, 0}},
                       .radius = 0.02}),
      points);
}

std::string what_is_said_of(const std::vector<double>& flap, double spacing) {
  HyperbolicGrid ring{.name = "ring",
                      .points = static_cast<int>(flap.size() / 2),
                      .lines = 8,
                      .curve = Side::bottom,
                      .spacing = spacing};
  ring.ends = Curve::open;
  ring.walls = {Vec2(1, 0), Vec2(1, 0)};
  HyperbolicMarch march(ring);
  Field x(march.layout(), 2);
  march.march(flap, x.view(), 1);
  CompositeGrid grids({.name = "gas", .n1 = 121, .n2 = 61, .x_a = -2, .x_b = 2, .y_a = 0, .y_b = 2},
                      {{.name = "ring",
                        .n1 = ring.points,
                        .n2 = 8,
                        .curve = Side::bottom,
                        .ends = Curve::open,
                        .of = "body `flap`"}});
  const ConstFieldView views[] = {x.view()};
  try {
    grids.connect(views, 1);
  } catch (const Diverged& broke) {
    return broke.what();
  }
  return "two cells of gas went unnoticed";
}

TEST(ThinOverlap, ABodyThatStandsOnTheSideItComesNearIsNotToldAGridThere) {
  const std::string words = what_is_said_of(hanging_flap(181, 0.06), 0.015);
  EXPECT_NE(words.find("body `flap` has come within "), std::string::npos) << words;
  EXPECT_NE(words.find("it stands on that side: let the run end before, or write a larger grid.factor"),
            std::string::npos)
      << words;
  EXPECT_EQ(words.find("give that side a grid"), std::string::npos) << words;
}

// A finer grid lets a foot fold earlier.
TEST(ThinOverlap, ABodyThatComesNearTheSideAtItsFootIsNotToldAFinerGrid) {
  const std::string words = what_is_said_of(crouching_flap(1200), 0.001);
  EXPECT_NE(words.find("it stands on that side and folds over at its foot"), std::string::npos) << words;
  EXPECT_EQ(words.find("larger grid.factor"), std::string::npos) << words;
}

/// A wall from the left side to the right one, at a height, with its grid above it.
std::string message_of_floor(double height) {
  constexpr int points = 41;
  std::vector<double> curve(std::size_t{2} * points, height);
  for (std::size_t k = 0; k < points; ++k) curve[k] = -1 + 0.05 * static_cast<double>(k);
  HyperbolicGrid strip{.name = "strip", .points = points, .lines = 8, .curve = Side::bottom, .spacing = 0.05};
  strip.ends = Curve::open;
  strip.walls = {Vec2(0, 1), Vec2(0, 1)};
  HyperbolicMarch march(strip);
  Field x(march.layout(), 2);
  march.march(curve, x.view(), 1);
  CompositeGrid grids({.name = "gas", .n1 = 41, .n2 = 41, .x_a = -1, .x_b = 1, .y_a = -1, .y_b = 1},
                      {{.name = "strip",
                        .n1 = points,
                        .n2 = 8,
                        .curve = Side::bottom,
                        .ends = Curve::open,
                        .of = "body `plate`"}});
  const ConstFieldView views[] = {x.view()};
  try {
    grids.connect(views, 1);
  } catch (const Diverged& broke) {
    return broke.what();
  }
  return "";
}

// Without its points the gas would not know of it.
TEST(ThinOverlap, ACurveThatHasLeftTheBackgroundIsNamed) {
  EXPECT_EQ(message_of_floor(-0.9), "");
  EXPECT_EQ(message_of_floor(-1), "");
  const std::string below = message_of_floor(-1.001);
  EXPECT_NE(below.find("t = 1, grid \"strip\", at (-0.95, -1"), std::string::npos) << below;
  EXPECT_NE(below.find("the curve of body `plate` has left the rectangle of \"gas\" here"), std::string::npos)
      << below;
}

}  // namespace
}  // namespace fsi::grid
