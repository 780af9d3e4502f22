// Integrals over composite grids.

#include "common/grid/geometry/partition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/shapes/circle.hpp"
#include "common/grid/shapes/ellipse.hpp"

namespace fsi::grid {
namespace {

using std::numbers::pi;
constexpr int lines = 9;

/// A square background and grids marched from closed curves, connected.
struct Domain {
  CompositeGrid grids;
  std::vector<Field> x;

  std::vector<ConstFieldView> views() const {
    std::vector<ConstFieldView> all;
    for (const Field& field : x) all.push_back(field.view());
    return all;
  }
  Vec2 point(std::size_t grid, int i, int j) const { return {x[grid](0, i, j), x[grid](1, i, j)}; }
  double integral(const std::function<double(const Vec2&)>& f) const {
    const std::vector<Field> areas = area_weights(grids, views());
    double sum = 0;
    for (std::size_t g = 0; g < areas.size(); ++g) {
      for (int j = 0; j < areas[g].layout().n2; ++j) {
        for (int i = 0; i < areas[g].layout().n1; ++i) sum += areas[g](0, i, j) * f(point(g, i, j));
      }
    }
    return sum;
  }
};

struct Hole {
  PlaneCurve curve;
  bool inside = false;  ///< the domain lies inside the curve
};

/// Square [-1.5, 1.5]^2 at spacing h with the domain on one side of each curve.
Domain domain_of(const std::vector<Hole>& holes, double h) {
  const int n = static_cast<int>(std::lround(3 / h)) + 1;
  const CartesianGrid square{.n1 = n, .n2 = n, .x_a = -1.5, .x_b = 1.5, .y_a = -1.5, .y_b = 1.5};
  std::vector<Field> x;
  x.emplace_back(square.layout(), 2);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) x[0](0, i, j) = square.x(i), x[0](1, i, j) = square.y(j);
  }
  std::vector<BodyFittedGrid> bodies;
  for (const Hole& hole : holes) {
    const int points = static_cast<int>(length_of(hole.curve) / h) + 1;
    const Side side = hole.inside ? Side::bottom : Side::top;
    x.emplace_back(Layout(points, lines), 2);
    HyperbolicMarch({.points = points, .lines = lines, .curve = side, .spacing = h})
        .march(points_on(hole.curve, points), x.back().view(), 0);
    bodies.push_back({.n1 = points, .n2 = lines, .curve = side});
  }
  Domain domain{CompositeGrid(square, bodies), std::move(x)};
  const std::vector<ConstFieldView> views = domain.views();
  domain.grids.connect(std::span(views).subspan(1), 0);
  return domain;
}

double one(const Vec2& /*x*/) {
  return 1;
}
double squared_radius(const Vec2& x) {
  return x.squaredNorm();
}

/// The trapezoidal rule misses h^2 / 12 f'(0) per length of curve, f = dA/ds: h^2 / 6 of a disk's area and
/// h^2 of its second moment. Half as much again is left to ellipses.
void expect_second_order(const std::vector<Hole>& holes, const std::function<double(const Vec2&)>& f,
                         double exact) {
  constexpr double h = 0.00625;
  const double coarse = std::abs(domain_of(holes, 2 * h).integral(f) / exact - 1),
               fine = std::abs(domain_of(holes, h).integral(f) / exact - 1);
  EXPECT_GE(std::log2(coarse / fine), 1.9) << coarse << ' ' << fine;
  EXPECT_LT(fine, 1.5 * h * h);
}

TEST(AreaWeights, GiveTheAreaOfADiskToSecondOrder) {
  expect_second_order({{circle({0.013, -0.021}, 1), true}}, one, pi);
}
TEST(AreaWeights, GiveTheSecondMomentOfADiskToSecondOrder) {
  expect_second_order({{circle({0, 0}, 1), true}}, squared_radius, pi / 2);
}
TEST(AreaWeights, GiveAreaAndSecondMomentOfATiltedEllipseToSecondOrder) {
  const std::vector<Hole> inside = {{ellipse({.a = 1.25, .b = 0.7, .angle = pi / 5}), true}};
  expect_second_order(inside, one, pi * 1.25 * 0.7);
  expect_second_order(inside, squared_radius, pi / 4 * 1.25 * 0.7 * (1.25 * 1.25 + 0.7 * 0.7));
}
TEST(AreaWeights, GiveTheAreaOfASquareWithoutADiskToSecondOrder) {
  expect_second_order({{circle({0, 0}, 0.6), false}}, one, 9 - pi * 0.36);
}
TEST(AreaWeights, GiveTheAreaOutsideTwoDisksWhoseGridsOverlap) {
  const double h = 0.025;
  const std::vector<Hole> holes = {{circle({-0.6, 0}, 0.45), false}, {circle({0.6, 0.1}, 0.5), false}};
  EXPECT_NEAR(domain_of(holes, h).integral(one), 9 - pi * (0.45 * 0.45 + 0.25), 9 * h * h);
}

TEST(PartitionOfUnity, IsOneWhereTheOtherGridHasNoValueAndSumsToOneEverywhere) {
  const Domain domain = domain_of({{circle({0, 0}, 1), true}}, 0.05);
  const std::vector<Field> weights = partition_of_unity(domain.grids, domain.views());
  // The ring is a function of the distance from the curve: what a background point lacks, a point of the
  // ring at about the same distance has. Both are differenced against lines of equal distance.
  const double depth = 1 - domain.x[1](0, 0, lines - 1);
  for (int j = 0; j < domain.grids.layout(0).n2; ++j) {
    for (int i = 0; i < domain.grids.layout(0).n1; ++i) {
      const double distance = 1 - domain.point(0, i, j).norm(), w = weights[0](0, i, j);
      if (domain.grids.kind(0, i, j) == PointKind::unused) {
        EXPECT_EQ(w, 0);
        continue;
      }
      EXPECT_GE(w, 0);
      EXPECT_LE(w, 1);
      if (distance > 1.01 * depth) {
        EXPECT_EQ(w, 1);
        continue;
      }
      int line = 0;
      while (line + 2 < lines && 1 - domain.x[1](0, 0, line + 1) < distance) ++line;
      const double a = 1 - domain.x[1](0, 0, line), b = 1 - domain.x[1](0, 0, line + 1);
      const double part = (distance - a) / (b - a);
      const double ring = (1 - part) * weights[1](0, 0, line) + part * weights[1](0, 0, line + 1);
      // Linear interpolation over 1/8 of a ramp whose second derivative is below 5.8: 5.8 / 8 / 64; and the
      // lines are circles up to the chords.
      EXPECT_NEAR(w + ring, 1, 0.0125);
    }
  }
}

TEST(PartitionOfUnity, BelongsToTheCurveOnTheCurve) {
  const Domain domain = domain_of({{circle({-0.6, 0}, 0.45), false}, {circle({0.6, 0.1}, 0.5), false}}, 0.05);
  const std::vector<Field> weights = partition_of_unity(domain.grids, domain.views());
  for (std::size_t g = 1; g <= 2; ++g) {
    for (int i = 0; i < weights[g].layout().n1; ++i) EXPECT_EQ(weights[g](0, i, lines - 1), 1);
  }
}

}  // namespace
}  // namespace fsi::grid
