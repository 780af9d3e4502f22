#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/shapes/circle.hpp"
#include "common/grid/shapes/ellipse.hpp"
#include "common/grid/shapes/rounded_polygon.hpp"
#include "common/grid/shapes/smoothed_polygon.hpp"
#include "common/grid/shapes/spline.hpp"
#include "tests/unit/grid/shapes_of_cases.hpp"

namespace fsi::grid {
namespace {

using std::numbers::pi;

/// Largest difference between slope() and centred differences of position(), relative to the slope.
double slope_error(const PlaneCurve& curve) {
  double worst = 0;
  for (double s = 0.013; s < 0.99; s += 0.031) {
    const Vec2 difference = (curve.position(s + 1e-6) - curve.position(s - 1e-6)) / 2e-6;
    worst = std::max(worst, (difference - curve.slope(s)).norm() / curve.slope(s).norm());
  }
  return worst;
}

TEST(Shapes, SlopesAreTheDerivativesOfPositions) {
  // Differences over 2e-6 carry round-off of 1e-10.
  for (const PlaneCurve& curve : {circle({1, 2}, 3), tilted_ellipse(), beam_outline(), star()}) {
    EXPECT_LT(slope_error(curve), 1e-8);
  }
}

/// A box with round corners, listed counter-clockwise.
PlaneCurve rounded_box(double width, double height, double radius) {
  return rounded_polygon({.corners = {{0, 0}, {width, 0}, {width, height}, {0, height}},
                          .ends = Curve::closed,
                          .radius = radius});
}

TEST(RoundedPolygon, KeepsItsEdgesAndHasTheLengthOfEdgesAndArcs) {
  const PlaneCurve box = rounded_box(2, 1, 0.25);
  EXPECT_NEAR(length_of(box), 6 - 8 * 0.25 + 2 * pi * 0.25, 1e-14);
  EXPECT_LT(slope_error(box), 1e-8);
  const auto x = points_on(box, 4001);
  const std::size_t n = x.size() / 2;
  double low = 1, left = 1, high = 0, right = 0;
  for (std::size_t k = 0; k < n; ++k) {
    left = std::min(left, x[k]), right = std::max(right, x[k]);
    low = std::min(low, x[n + k]), high = std::max(high, x[n + k]);
  }
  for (const auto& [found, wanted] : {std::pair{left, 0.0}, {right, 2.0}, {low, 0.0}, {high, 1.0}})
    EXPECT_NEAR(found, wanted, 1e-14);
  EXPECT_EQ(x[0], x[n - 1]);
  EXPECT_EQ(x[n], x[2 * n - 1]);
}

TEST(RoundedPolygon, ArcsHaveTheirRadiusWhicheverWayTheyTurn) {
  // A step: up along x = 0, a corner to the right, one to the left, one to the right; every point is on an
  // edge or at the radius from a corner's centre, which lies at the radius from both its edges.
  const double r = 0.1;
  const PlaneCurve step = rounded_polygon({.corners = {{0, 0}, {0, 1}, {1, 1}, {1, 2}}, .radius = r});
  EXPECT_NEAR(length_of(step), 3 - 4 * r + pi * r, 1e-14);
  EXPECT_LT(slope_error(step), 1e-8);
  EXPECT_EQ(step.position(0), Vec2(0, 0));
  EXPECT_EQ(step.position(1), Vec2(1, 2));
  for (double s = 0; s <= 1; s += 0.003) {
    const Vec2 x = step.position(s);
    const double to_edges = std::min({std::abs(x[0]), std::abs(x[1] - 1), std::abs(x[0] - 1)});
    const double to_arcs =
        std::min(std::abs((x - Vec2(r, 1 - r)).norm() - r), std::abs((x - Vec2(1 - r, 1 + r)).norm() - r));
    EXPECT_LT(std::min(to_edges, to_arcs), 1e-14) << s;
  }
}

TEST(RoundedPolygon, SaysWhichRadiusFits) {
  EXPECT_NO_THROW(rounded_box(2, 1, 0.499));
  try {
    rounded_box(2, 1, 0.6);
    FAIL() << "arcs longer than their edge";
  } catch (const UserMistake& mistake) {
    EXPECT_NE(std::string(mistake.what()).find("write at most 0.5"), std::string::npos) << mistake.what();
  }
  EXPECT_THROW(rounded_polygon({.corners = {{0, 0}, {1, 0}, {0, 0}}, .radius = 0.1}), UserMistake);
  EXPECT_THROW(rounded_polygon({.corners = {{0, 0}, {0, 0}}, .radius = 0.1}), UserMistake);
  EXPECT_THROW(rounded_polygon({.corners = {{0, 0}, {1, 0}}, .radius = -0.1}), UserMistake);
}

TEST(Outline, IsAsThickAsItsNarrowestNormal) {
  const auto box = points_on(rounded_box(2, 0.5, 0.1), 2001);  // counter-clockwise: the body is on the left
  EXPECT_NEAR(narrowest(box, Curve::closed, 1).distance, 0.5, 1e-3);
  EXPECT_TRUE(std::isinf(narrowest(box, Curve::closed, -1).distance));  // no bay
  const auto lens = points_on(ellipse({.centre = {1, 2}, .a = 1, .b = 0.2, .angle = 0.7}), 801);
  // The shortest normal chord of an ellipse with a > sqrt(2) b: 3 sqrt(3) a^2 b^2 / (a^2 + b^2)^(3/2).
  EXPECT_NEAR(narrowest(lens, Curve::closed, 1).distance, 3 * std::sqrt(3.0) * 0.04 / std::pow(1.04, 1.5),
              1e-3);
  // A bay 0.4 wide between two towers, its floor and corners round.
  const auto bay = points_on(
      rounded_polygon(
          {.corners = {{0, 0}, {0, 1}, {0.5, 1}, {0.5, 0.3}, {0.9, 0.3}, {0.9, 1}, {1.4, 1}, {1.4, 0}},
           .radius = 0.1}),
      1601);
  EXPECT_NEAR(narrowest(bay, Curve::open, 1).distance, 0.4,
              1e-3);  // listed clockwise: the gas is on the left
  EXPECT_NEAR(narrowest(bay, Curve::open, -1).distance, 0.5, 1e-3);
}

TEST(Shapes, CircleHasItsLengthAndEvenPoints) {
  const PlaneCurve curve = circle({1, -2}, 0.5);
  EXPECT_NEAR(length_of(curve), pi, 1e-15);
  const auto x = points_on(curve, 9);
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_NEAR(x[k], 1 + 0.5 * std::cos(pi * static_cast<double>(k) / 4), 1e-15);
    EXPECT_NEAR(x[9 + k], -2 + 0.5 * std::sin(pi * static_cast<double>(k) / 4), 1e-15);
  }
  EXPECT_EQ(x[0], x[8]);
  EXPECT_EQ(x[9], x[17]);
}

TEST(Shapes, EllipseHasItsAxesWhereTheAngleSaysAndItsKnownLength) {
  const PlaneCurve curve = tilted_ellipse();
  const double c = std::sqrt(0.5);
  EXPECT_NEAR((curve.position(0) - Vec2(-1 + 1.25 * c, 1.25 * c)).norm(), 0, 1e-15);
  EXPECT_NEAR((curve.position(0.25) - Vec2(-1 - 0.5 * c, 0.5 * c)).norm(), 0, 1e-15);
  // Ramanujan's second formula, whose own error is 1e-6 at this axis ratio.
  const double h = std::pow((1.25 - 0.5) / (1.25 + 0.5), 2);
  EXPECT_NEAR(length_of(curve), pi * 1.75 * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h))), 2e-6);
}

TEST(Shapes, PointsAreEvenInArclengthOnAnEllipse) {
  const PlaneCurve curve = tilted_ellipse();
  const auto s = distribute(curve, 41);
  const double step = length_of(curve) / 40;
  for (std::size_t k = 0; k + 1 < s.size(); ++k) {
    double length = 0;
    for (int m = 0; m < 200; ++m) {
      const double from = s[k] + (s[k + 1] - s[k]) * m / 200, to = s[k] + (s[k + 1] - s[k]) * (m + 1) / 200;
      length += (curve.position(to) - curve.position(from)).norm();
    }
    EXPECT_NEAR(length, step, 1e-6 * step);  // 200 chords miss 1e-7 of an arc this short
  }
}

TEST(Shapes, BeamOutlineHasThePublishedTipAndWidth) {
  const PlaneCurve beam = beam_outline();
  EXPECT_EQ(beam.position(0), Vec2(-0.05, 0));
  EXPECT_NEAR((beam.position(1) - Vec2(0.05, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(beam.position(0.5)[1], 0.99629, 5e-6);  // the digits given
  EXPECT_NEAR(beam.position(0.5)[0], 0, 1e-12);
  double low = 0, high = 0.5;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (beam.position(middle)[1] < 0.5 ? low : high) = middle;
  }
  EXPECT_NEAR(-2 * beam.position(low)[0], 0.1, 1e-9);
}

TEST(Shapes, BeamIsSharpestNearTheTipAsGiven) {
  const PlaneCurve beam = beam_outline();
  double smallest = 1, height = 0;
  for (double s = 0.4; s < 0.5; s += 1e-4) {
    const Vec2 d = beam.slope(s), c = (beam.slope(s + 1e-6) - beam.slope(s - 1e-6)) / 2e-6;
    const double radius = std::pow(d.norm(), 3) / std::abs(d[0] * c[1] - d[1] * c[0]);
    if (radius < smallest) smallest = radius, height = beam.position(s)[1];
  }
  EXPECT_NEAR(smallest, 0.029, 5e-4);
  EXPECT_NEAR(height, 0.986, 5e-3);
}

TEST(Shapes, WeightsDrawPointsTogetherByTheirDensity) {
  const PlaneCurve beam = beam_outline();
  const PointWeight weights[] = {{.1, 1.5, 1 / 2.1}, {.1, 1.5, 1.1 / 2.1}};
  const auto s = distribute(beam, 401, weights);
  // The published density runs from 1.09 at the base to 1.15 at the tip.
  const double at_base = s[1] - s[0], at_tip = s[201] - s[200];
  const double speed = beam.slope(0.5).norm() / beam.slope(0).norm();
  EXPECT_NEAR(at_base / (at_tip * speed), 1.15 / 1.09, 0.01);
}

TEST(Shapes, ClosedSmoothedPolygonClosesSmoothlyAndKeepsItsEdges) {
  const PlaneCurve square =
      smoothed_polygon({.corners = {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, .ends = Curve::closed, .sharpness = 60});
  EXPECT_NEAR((square.position(0) - square.position(1)).norm(), 0, 1e-12);
  EXPECT_NEAR((square.slope(0) - square.slope(1)).norm(), 0, 1e-12);
  EXPECT_NEAR(square.position(1.0 / 6)[1], 0, 1e-8);  // e^(-2 60 / 6)
  EXPECT_NEAR(square.position(2.0 / 3)[1], 1, 1e-8);  // the opposite edge
  EXPECT_NEAR(square.position(2.5 / 6)[0], 2, 1e-4);  // e^(-2 60 / 12)
  const Vec2 corner = square.position(0);
  EXPECT_GT(corner[0], 0);  // rounded inward
  EXPECT_NEAR(corner[0], corner[1], 1e-8);
}

TEST(Shapes, ClosedSmoothedPolygonIsTheSameFromWhicheverCornerItIsListed) {
  const std::vector<Vec2> corners{{1.5, -0.5}, {2.5, -0.5}, {2.8, 0.4}, {1.5, 0.5}};
  for (const double sharpness : {5.0, 10.0, 50.0}) {
    const PlaneCurve curve =
        smoothed_polygon({.corners = corners, .ends = Curve::closed, .sharpness = sharpness});
    std::vector<Vec2> turned = corners;
    double from = 0, total = 0;
    for (std::size_t k = 0; k < 4; ++k) total += (corners[(k + 1) % 4] - corners[k]).norm();
    for (std::size_t first = 1; first < 4; ++first) {
      from += (corners[first] - corners[first - 1]).norm() / total;
      std::ranges::rotate(turned, turned.begin() + 1);
      const PlaneCurve other =
          smoothed_polygon({.corners = turned, .ends = Curve::closed, .sharpness = sharpness});
      for (double s = 0; s < 1; s += 0.017) {
        const Vec2 there = curve.position(std::fmod(s + from, 1.0));
        EXPECT_NEAR((other.position(s) - there).norm(), 0, 1e-12) << "sharpness " << sharpness;
      }
    }
  }
}

TEST(Shapes, SmoothedSquareHasTheSymmetryOfTheSquare) {
  // Blunt enough that the corners are felt everywhere.
  const PlaneCurve square = smoothed_polygon({.corners = {{1.5, -0.5}, {2.5, -0.5}, {2.5, 0.5}, {1.5, 0.5}},
                                              .ends = Curve::closed,
                                              .sharpness = 10});
  const Vec2 centre(2, 0);
  for (double s = 0; s < 0.75; s += 0.013) {
    const Vec2 x = square.position(s) - centre, turned = square.position(s + 0.25) - centre;
    EXPECT_NEAR((turned - Vec2(-x[1], x[0])).norm(), 0, 1e-12);  // by a quarter turn
    const Vec2 mirrored = square.position(1 - s) - centre;  // across the diagonal through the first corner
    EXPECT_NEAR((mirrored - Vec2(x[1], x[0])).norm(), 0, 1e-12);
  }
}

TEST(Shapes, SmoothedPolygonIsTheMovingAverageOfThePolygon) {
  // The mean of all points is kept by an average, whatever its width.
  const std::vector<Vec2> corners{{0, 0}, {3, 0}, {0, 4}};  // lengths 3, 5, 4
  const Vec2 mean = (3 * Vec2(1.5, 0) + 5 * Vec2(1.5, 2) + 4 * Vec2(0, 2)) / 12;
  for (const double sharpness : {6.0, 12.0, 100.0}) {
    const PlaneCurve curve =
        smoothed_polygon({.corners = corners, .ends = Curve::closed, .sharpness = sharpness});
    Vec2 sum = Vec2::Zero();
    constexpr int n = 1200;
    for (int k = 0; k < n; ++k) sum += curve.position(static_cast<double>(k) / n) / n;
    EXPECT_NEAR((sum - mean).norm(), 0, 1e-11) << "sharpness " << sharpness;
  }
}

TEST(Shapes, ClosedPolygonThatItsSharpnessDrawsToAPointIsAMistake) {
  for (const double sharpness : {0.01, 1.0, 3.0}) {
    const SmoothedPolygon shape{
        .corners = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, .ends = Curve::closed, .sharpness = sharpness};
    try {
      smoothed_polygon(shape);
      ADD_FAILURE() << "sharpness " << sharpness;
    } catch (const UserMistake& mistake) {
      EXPECT_NE(std::string(mistake.what()).find("is too blunt"), std::string::npos) << mistake.what();
    }
  }
}

TEST(Shapes, SplineMeetsItsPointsAndIsSmoothAcrossTheSeam) {
  std::vector<Vec2> points;
  for (int k = 0; k < 24; ++k) points.emplace_back(2 * std::cos(2 * pi * k / 24), std::sin(2 * pi * k / 24));
  const PlaneCurve curve = spline(points, Curve::closed);
  EXPECT_EQ(curve.position(0), points[0]);
  EXPECT_NEAR((curve.position(1) - points[0]).norm(), 0, 1e-15);
  EXPECT_NEAR((curve.slope(1) - curve.slope(0)).norm(), 0, 1e-12);
  const auto second = [&](double a, double b) -> Vec2 { return (curve.slope(b) - curve.slope(a)) / (b - a); };
  // Second derivative from both sides of the seam: one-sided differences over 1e-5 see the third derivative.
  EXPECT_NEAR((second(0, 1e-5) - second(1 - 1e-5, 1)).norm(), 0, 1e-2 * second(0, 1e-5).norm());
}

TEST(Shapes, SplinesConvergeWithFourthOrder) {
  const auto error = [](int n, Curve ends) {
    std::vector<Vec2> points;
    const double whole = ends == Curve::closed ? 2 * pi : 2.0;
    for (int k = 0; k <= n; ++k) points.emplace_back(std::cos(whole * k / n), std::sin(whole * k / n));
    const PlaneCurve curve = spline(points, ends);
    double worst = 0;
    for (double s = 0; s <= 1; s += 0.0007) worst = std::max(worst, std::abs(curve.position(s).norm() - 1));
    return worst;
  };
  for (const Curve ends : {Curve::closed, Curve::open}) {
    EXPECT_GT(std::log2(error(16, ends) / error(32, ends)), 3.7);
    EXPECT_LT(error(32, ends), 1e-5);
  }
}

TEST(Shapes, CsvTextOfASpreadsheetKeepsItsFirstPoint) {
  for (const std::string heading : {"", "x,y\n"}) {
    const auto points = points_from_csv("\xEF\xBB\xBF" + heading + "1,2\n3,4\n", "outline.csv");
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0], Vec2(1, 2));
  }
}

TEST(Shapes, CsvTextGivesPointsAndNamesThePlaceOfAMistake) {
  const auto points = points_from_csv("x, y\n# comment\n1, 2\n\n3;4.5\n-1e-3 +6\r\n", "outline.csv");
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1], Vec2(3, 4.5));
  EXPECT_EQ(points[2], Vec2(-1e-3, 6));
  const auto complaint = [](const char* text) -> std::string {
    try {
      points_from_csv(text, "outline.csv");
    } catch (const UserMistake& mistake) {
      return mistake.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("1,2\n3,x\n").substr(0, 16), "outline.csv:2:3:");
  EXPECT_EQ(complaint("1,2\n3\n").substr(0, 14), "outline.csv:2:");
  EXPECT_EQ(complaint("1,2,3\n").substr(0, 16), "outline.csv:1:5:");
  EXPECT_EQ(complaint("1..0,2\n3,4\n").substr(0, 16), "outline.csv:1:1:");  // no heading
  EXPECT_NE(complaint("").find("no points"), std::string::npos);
}

TEST(Shapes, MistakesAreTheUsers) {
  EXPECT_THROW(circle({0, 0}, -1), UserMistake);
  EXPECT_THROW(smoothed_polygon({.corners = {{0, 0}, {0, 0}, {1, 1}}, .ends = Curve::open}), UserMistake);
  EXPECT_THROW(spline({{0, 0}, {1, 0}, {1, 1}}, Curve::open), UserMistake);
  EXPECT_THROW(spline({{0, 0}, {1, 0}, {1, 0}, {1, 1}}, Curve::open), UserMistake);
  try {
    spline({{0, 0}, {1, 0}}, Curve::closed);
    FAIL() << "a closed spline through two points went unnoticed";
  } catch (const UserMistake& few) {
    EXPECT_STREQ(few.what(), "a spline through 2 points; write at least 4");
  }
  const PointWeight away[] = {{-2, 10, 0.5}};
  EXPECT_THROW(distribute(circle({0, 0}, 1), 40, away), UserMistake);
}

TEST(Shapes, SmoothedPolygonsHaveTheSameBitsInOtherUnits) {
  constexpr double length = 0x1p-9;
  for (const Curve ends : {Curve::closed, Curve::open}) {
    SmoothedPolygon shape{
        .corners = {{0.1, 0}, {1.3, 0.2}, {1, 0.9}, {-0.3, 0.7}}, .ends = ends, .sharpness = 20};
    const PlaneCurve curve = smoothed_polygon(shape);
    for (Vec2& corner : shape.corners) corner *= length;
    const PlaneCurve other = smoothed_polygon(shape);
    for (const double s : {0.0, 0.13, 0.4, 0.77}) {
      EXPECT_EQ(Vec2(length * curve.position(s)), other.position(s));
      EXPECT_EQ(Vec2(length * curve.slope(s)), other.slope(s));
    }
  }
}

}  // namespace
}  // namespace fsi::grid
