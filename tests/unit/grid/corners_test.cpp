// Sharp corners of curves, and grids that fan around them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"
#include "common/grid/cartesian_grid.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/geometry/quality.hpp"
#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/overlap/hole_cutting.hpp"
#include "common/grid/shapes/blunted.hpp"
#include "common/grid/shapes/rounded_polygon.hpp"
#include "common/grid/shapes/spline.hpp"

namespace fsi::grid {
namespace {

Vec2 point(const std::vector<double>& x, int k) {
  const auto at = static_cast<std::size_t>(k);
  return {x[at], x[x.size() / 2 + at]};
}

PlaneCurve sharp(std::vector<Vec2> corners, Curve ends = Curve::closed) {
  return rounded_polygon({.corners = std::move(corners), .ends = ends, .radius = 0});
}

const std::vector<Vec2> box{{0, 0}, {2, 0}, {2, 1}, {0, 1}};

TEST(Corners, EachIsAPointAndThePointsBetweenTwoOfThemAreEven) {
  const PlaneCurve curve = sharp(box);
  EXPECT_NEAR(length_of(curve), 6, 1e-14);
  for (const int n : {9, 32, 101}) {
    const std::vector<double> s = distribute(curve, n), x = points_at(curve, s);
    const std::vector<int> corners = corners_among(curve, s);
    ASSERT_EQ(corners.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(point(x, corners[k]), box[(k + 1) % 4]) << n;
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = (point(x, corners[k] + 1) - point(x, corners[k])).norm();
      for (int i = corners[k]; i < corners[k + 1]; ++i)
        EXPECT_NEAR((point(x, i + 1) - point(x, i)).norm(), step, 1e-14);
    }
  }
  EXPECT_THROW(distribute(curve, 4), UserMistake);
}

/// Two arcs of the circles of radius 1 around (0, -c) and (0, c) that meet at the tips (+-sqrt(1 - c^2), 0).
std::vector<Vec2> lens(double c, int points) {
  std::vector<Vec2> list;
  const double half = std::acos(c);  // angle of a tip against the axis through the centres
  for (const double side : {1.0, -1.0}) {
    for (int k = 0; k < points; ++k) {
      const double angle = half * (1 - 2.0 * k / points);
      list.emplace_back(side * std::sin(angle), side * (std::cos(angle) - c));
    }
  }
  return list;
}

TEST(Corners, ASplineWithCornersStaysOnItsArcsUpToTheTips) {
  constexpr double c = 0.9;
  const auto off = [](const PlaneCurve& curve) {
    double worst = 0;
    for (double s = 0.001; s < 1; s += 0.002) {
      const Vec2 x = curve.position(s);
      worst = std::max(worst, std::abs((Vec2(x[0], std::abs(x[1])) - Vec2(0, -c)).norm() - 1));
    }
    return worst;
  };
  const PlaneCurve with = spline(lens(c, 12), Curve::closed, std::numbers::pi / 3),
                   without = spline(lens(c, 12), Curve::closed);
  EXPECT_EQ(with.corners.size(), 2U);
  EXPECT_TRUE(without.corners.empty());
  EXPECT_LT(off(with), 1e-5);  // a cubic spline's fourth order
  EXPECT_GT(off(without), 1e-3);
  // The circles' tangents at the tip, an angle of acos(c) from the axis.
  const Vec2 slope = with.slope(with.corners[1]).normalized();
  EXPECT_NEAR(std::abs(slope[0]), c, 1e-3);
}

TEST(Corners, AStretchOfTwoPointsIsStraight) {
  const PlaneCurve curve = spline({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, Curve::closed, 1);
  EXPECT_EQ(curve.corners.size(), 4U);
  EXPECT_NEAR(length_of(curve), 4, 1e-13);
}

TEST(Blunted, CutsSharpEndsOffAsWideAsItIsTold) {
  // A dart whose tail at the origin has an angle of 2 atan(0.1); its other corners are blunt enough.
  const PlaneCurve dart = sharp({{0, 0}, {-1, 0.1}, {-1.05, 0}, {-1, -0.1}});
  constexpr double width = 0.05;
  const PlaneCurve cut = blunted(dart, width);
  const std::vector<double> s = distribute(cut, 81), x = points_at(cut, s);
  const std::vector<int> corners = corners_among(cut, s);
  ASSERT_EQ(corners.size(), 5U);
  int faces = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    const Vec2 a = point(x, corners[k]), b = point(x, corners[(k + 1) % 5]);
    if (std::abs((a - b).norm() - width) > 1e-9) continue;
    ++faces;
    // Straight across, at the place where the sides, 0.2 of their length along x apart, are so far apart.
    EXPECT_NEAR(a[0], -width / 0.2, 1e-9);
    EXPECT_NEAR(b[0], a[0], 1e-9);
  }
  EXPECT_EQ(faces, 1);
  const std::vector<CutCorner> told = cut_corners(dart, width);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told.front().at.norm(), 0);  // the tail
  EXPECT_NEAR(told.front().loss, width / 0.2, 1e-9);
  for (int k = 0; k < 81; ++k) {
    const bool on_face = std::abs(point(x, k)[0] + width / 0.2) < 1e-9;
    if (on_face) continue;
    EXPECT_LT(distance_to(points_on(dart, 4001), point(x, k)), 1e-4);
  }
  EXPECT_NEAR(length_of(cut), length_of(dart) - 2 * std::hypot(0.25, 0.025) + width, 1e-9);
  try {
    blunted(dart, 0.3);
    FAIL() << "a face wider than the dart went unnoticed";
  } catch (const UserMistake& wide) {
    const std::string words = wide.what(), before = "write `blunt: ";
    const std::size_t at = words.find(before);
    ASSERT_NE(at, std::string::npos) << words;
    EXPECT_NO_THROW(blunted(dart, std::stod(words.substr(at + before.size())))) << words;
  }
}

TEST(Blunted, LeavesRightAnglesAlone) {
  EXPECT_EQ(blunted(sharp(box), 0.1).corners, sharp(box).corners);
  EXPECT_TRUE(cut_corners(sharp(box), 0.1).empty());
}

TEST(Outline, ACornerIsNoBend) {
  const PlaneCurve curve = sharp(box);
  const std::vector<double> s = distribute(curve, 61), x = points_at(curve, s);
  EXPECT_LT(sharpest_bend(x, Curve::closed, 1).radius, 0.2);
  EXPECT_TRUE(std::isinf(sharpest_bend(x, Curve::closed, 1, corners_among(curve, s)).radius));
}

/// A grid on the outer side of a right-angled edge, points 0.05 apart.
std::optional<CrowdedCorner> corner_of_grid(double spacing, double angle) {
  const Vec2 down(-std::cos(angle), -std::sin(angle));
  const auto x = points_on(sharp({{-1, 0}, {0, 0}, down}, Curve::open), 41);
  HyperbolicMarch march(
      {.points = 41, .lines = 6, .curve = Side::bottom, .ends = Curve::open, .spacing = spacing});
  Field grid(march.layout(), 2);
  march.march(x, grid.view(), 0);
  return crowded_corner(grid.view(), Side::bottom);
}

TEST(CrowdedCorner, WideLinesFoldBehindACornerAndTheSpacingItNamesDoesNot) {
  const double right = std::numbers::pi / 2, sharp_edge = std::numbers::pi / 6;
  EXPECT_FALSE(corner_of_grid(0.05, right));
  const auto wide = corner_of_grid(0.15, sharp_edge);
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->point, 20);
  EXPECT_LT(wide->spacing, 0.15);
  EXPECT_FALSE(corner_of_grid(0.9 * wide->spacing, sharp_edge));
}

/// A grid on the outer side of a quarter of a circle between two straight edges, points 0.05 apart, lines so far apart.
Field around_bend(double radius, double spacing) {
  const auto x = points_on(
      rounded_polygon({.corners = {{-1, 0}, {0, 0}, {0, -1}}, .ends = Curve::open, .radius = radius}), 41);
  HyperbolicMarch march(
      {.points = 41, .lines = 6, .curve = Side::bottom, .ends = Curve::open, .spacing = spacing});
  Field grid(march.layout(), 2);
  march.march(x, grid.view(), 0);
  return grid;
}

TEST(MostCrowdedBend, IsWhereGhostLinesOfARoundedCornerChangePlacesAndItsSpacingHolds) {
  for (const double radius : {0.1, 0.2}) {
    const Field wide = around_bend(radius, 1.2 * radius), close = around_bend(radius, 0.3 * radius);
    const auto crowded = most_crowded_bend(wide.view(), Side::bottom, {}),
               loose = most_crowded_bend(close.view(), Side::bottom, {});
    ASSERT_TRUE(crowded && loose);
    EXPECT_FALSE(crowded_corner(wide.view(), Side::bottom));  // not for fluxes through the curve
    EXPECT_LT(crowded->part, 1);
    EXPECT_GT(loose->part, 1);
    EXPECT_LT(crowded->x.norm(), 2 * radius);
    // Ghost lines are arcs around the bend's centre: half of one is left at 0.9 of its radius.
    EXPECT_NEAR(crowded->spacing / (0.9 * radius), 1, 0.25);
    EXPECT_NEAR(loose->spacing / crowded->spacing, 1, 0.15);  // in proportion to the distance of lines
    const Field held = around_bend(radius, 0.9 * crowded->spacing);
    EXPECT_GT(most_crowded_bend(held.view(), Side::bottom, {})->part, 1);
  }
}

TEST(MostCrowdedBend, SharpCornersAreNone) {
  const auto x = points_on(sharp({{-1, 0}, {0, 0}, {0, -1}}, Curve::open), 41);
  HyperbolicMarch march(
      {.points = 41, .lines = 6, .curve = Side::bottom, .ends = Curve::open, .spacing = 0.08});
  Field grid(march.layout(), 2);
  march.march(x, grid.view(), 0);
  const std::vector<int> corner{20};
  EXPECT_LT(most_crowded_bend(grid.view(), Side::bottom, {})->part, 1);
  const auto beside = most_crowded_bend(grid.view(), Side::bottom, corner);
  EXPECT_TRUE(!beside || beside->part > 1);
}

TEST(MostCrowdedCorner, AtARightAngleNothingIsLeftOfTheFirstGhostLineWhereLinesAreAsFarApartAsPoints) {
  const auto x = points_on(sharp({{-1, 0}, {0, 0}, {0, -1}}, Curve::open), 41);
  const std::vector<int> corner{20};
  const auto at = [&](double spacing) {
    HyperbolicMarch march(
        {.points = 41, .lines = 6, .curve = Side::bottom, .ends = Curve::open, .spacing = spacing});
    Field grid(march.layout(), 2);
    march.march(x, grid.view(), 0);
    const ConstFieldView view = grid.view();
    const double ghosts = std::hypot(view(0, 21, -1) - view(0, 19, -1), view(1, 21, -1) - view(1, 19, -1));
    return std::pair(most_crowded_corner(view, Side::bottom, corner, least_share_of_turns).value(), ghosts);
  };
  const auto [wide, none] = at(0.05);
  EXPECT_EQ(wide.point, 20);
  EXPECT_LT(wide.part, 1);
  EXPECT_LT(none, 0.02);
  const auto [held, some] = at(wide.spacing);
  EXPECT_GT(held.part, 0.99);
  EXPECT_GT(some, none);
}

TEST(MostSlantedLine, IsThatAtAFlatEndOnAWall) {
  // The curve rises from the wall y = 0 at an angle; its first line leaves it along the wall.
  for (const double angle : {0.2, 0.5, 1.2}) {
    constexpr double spacing = 0.05;
    const Vec2 up(std::cos(angle), std::sin(angle));
    const auto x = points_on(sharp({{0, 0}, up}, Curve::open), 41);  // 1/40 apart
    HyperbolicMarch march({.points = 41,
                           .lines = 6,
                           .curve = Side::bottom,
                           .ends = Curve::open,
                           .spacing = spacing,
                           .walls = {Vec2(1, 0), std::nullopt},
                           .blend = 12});
    Field grid(march.layout(), 2);
    march.march(x, grid.view(), 0);
    const SlantedLine line = most_slanted_line(grid.view(), Side::bottom);
    EXPECT_LE(line.point, 1);
    EXPECT_NEAR(line.slant, 2 * std::cos(angle), 0.15) << angle;
  }
}

TEST(FlatOnAWall, AFoldWhereTheCurveHasComeDownToItsWallSaysSo) {
  const auto message = [](double height, double t) -> std::string {
    const auto x = points_on(sharp({{0, 0}, {0.5, height}, {1, 0.6}}, Curve::open), 41);
    HyperbolicMarch march({.points = 41,
                           .lines = 12,
                           .curve = Side::bottom,
                           .ends = Curve::open,
                           .spacing = 0.05,
                           .walls = {Vec2(1, 0), std::nullopt},
                           .concave_smoothing = 0,
                           .blend = 16});
    Field grid(march.layout(), 2);
    try {
      march.march(x, grid.view(), t);
    } catch (const Diverged& folded) {
      return folded.what();
    }
    return "";
  };
  EXPECT_NE(message(-0.02, 1).find("come down to the wall it stands on"), std::string::npos)
      << message(-0.02, 1);
  EXPECT_EQ(message(0.3, 1).find("come down"), std::string::npos);
  // In the beginning nothing has come down yet.
  EXPECT_EQ(message(-0.02, 0).find("come down"), std::string::npos) << message(-0.02, 0);
  EXPECT_NE(message(-0.02, 0).find("degrees above its wall"), std::string::npos) << message(-0.02, 0);
}

TEST(CurveCut, ACurveOnAWallIsClosedALittleBehindIt) {
  const CartesianGrid background{.name = "gas", .n1 = 21, .n2 = 21, .x_a = -1, .x_b = 1, .y_a = -1, .y_b = 1};
  // A box on y = 0, in both directions: the wall between its ends is behind it, what is deeper is not.
  for (const bool domain_left : {false, true}) {
    const double first = domain_left ? 0.33 : -0.33;
    const auto x =
        points_on(sharp({{-first, 0}, {-first, 0.52}, {first, 0.52}, {first, 0}}, Curve::open), 41);
    CurveCut cut;
    cut.cut(background,
            {.x = x.data(),
             .y = x.data() + 41,
             .points = 41,
             .ends = Curve::open,
             .domain_left = domain_left,
             .on_wall = true},
            "box", 0);
    for (const double place : {-0.3, 0.0, 0.17}) {
      for (const double y : {0.3, 1e-12, -1e-12, -0.005})
        EXPECT_TRUE(cut.behind(background, {place, y})) << y;
      for (const double y : {0.6, -0.02, -0.5}) EXPECT_FALSE(cut.behind(background, {place, y})) << y;
    }
    EXPECT_FALSE(cut.behind(background, {0.4, 0}));
  }
}

// Its four sides lie on lines of the background, but for round-off.
TEST(CurveCut, PointsOnABoxBelongToTheDomainOnAllItsSides) {
  const CartesianGrid background{.name = "gas", .n1 = 21, .n2 = 21, .x_a = -1, .x_b = 1, .y_a = -1, .y_b = 1};
  constexpr int n = 4 * 8 + 1;
  for (const bool domain_left : {false, true}) {
    for (const double off : {0.0, 1e-15, -1e-15, 1e-13, -1e-13}) {
      const double side = 0.4 + off;
      auto x =
          points_on(sharp({{side, side}, {-side, side}, {-side, -side}, {side, -side}}, Curve::closed), n);
      if (domain_left) std::reverse(x.begin(), x.begin() + n), std::reverse(x.begin() + n, x.end());
      CurveCut cut;
      cut.cut(background, {.x = x.data(), .y = x.data() + n, .points = n, .domain_left = domain_left}, "box",
              0);
      for (int j = 0; j < background.n2; ++j) {
        std::vector<Interval> holes;
        cut.append_holes(j, background.n1, holes);
        const bool within = j > 6 && j < 14;
        EXPECT_EQ(holes.size(), within ? 1U : 0U) << j << " " << off;
        for (const Interval& hole : holes) EXPECT_EQ(hole.end - hole.begin, 7) << j << " " << off;
      }
    }
  }
}

// A box that stands on the rim of the background, or hangs over it as a floor does, on each of the four sides.
TEST(CurveCut, IsTheSameOnAllFourSidesOfTheBackground) {
  const CartesianGrid background{.name = "gas", .n1 = 21, .n2 = 21, .x_a = -1, .x_b = 1, .y_a = -1, .y_b = 1};
  constexpr int n = 41;
  for (const double foot : {-1.0, -0.9}) {
    const auto upright =
        points_on(sharp({{-0.33, foot}, {-0.33, -0.48}, {0.33, -0.48}, {0.33, foot}}, Curve::open), n);
    Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();
    for (int quarter = 0; quarter < 4; ++quarter, turn = Eigen::Rotation2Dd(0.5 * std::numbers::pi) * turn) {
      std::vector<double> x(upright.size());
      for (int k = 0; k < n; ++k) {
        const Vec2 turned = turn * point(upright, k);
        x[static_cast<std::size_t>(k)] = turned[0];
        x[static_cast<std::size_t>(k + n)] = turned[1];
      }
      CurveCut cut;
      cut.cut(background,
              {.x = x.data(), .y = x.data() + n, .points = n, .ends = Curve::open, .on_wall = true}, "box",
              0);
      for (int j = 0; j < background.n2; ++j) {
        std::vector<Interval> holes;
        cut.append_holes(j, background.n1, holes);
        for (int i = 0; i < background.n1; ++i) {
          const Vec2 at = background.point(i, j), there = turn.transpose() * at;
          const bool in_box = std::abs(there[0]) < 0.33 && there[1] < -0.48 && there[1] > foot - 1e-3;
          EXPECT_EQ(cut.behind(background, at), in_box) << at.transpose() << " turned by " << quarter;
          const bool is_hole =
              std::ranges::any_of(holes, [i](const Interval& h) { return h.begin <= i && i < h.end; });
          EXPECT_EQ(is_hole, in_box) << at.transpose() << " turned by " << quarter;
        }
      }
    }
  }
}

}  // namespace
}  // namespace fsi::grid
