// Bodies thinner than a cell of the background.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "common/grid/geometry/outline.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "common/grid/overlap/hole_cutting.hpp"
#include "common/grid/shapes/circle.hpp"
#include "common/grid/shapes/rounded_polygon.hpp"
#include "tests/unit/grid/marched.hpp"

namespace fsi::grid::thin_bodies {
namespace {

constexpr double h = 0.05;
constexpr int layers = 2;

/// Its half length, its thickness, and the angle of its long sides against the rows.
struct Plate {
  Vec2 middle;
  double length = 0.35, thickness = h, angle = 0;

  std::vector<Vec2> corners() const {
    const Vec2 along(std::cos(angle), std::sin(angle)), across(-along[1], along[0]);
    const Vec2 a = length * along, b = 0.5 * thickness * across;
    return {middle - a - b, middle + a - b, middle + a + b, middle - a + b};
  }
};

/// Of a curve with the body to its left.
Marched ring_around(const PlaneCurve& curve) {
  constexpr double along = 0.4 * h;
  return march(curve, {.name = "ring",
                       .points = static_cast<int>(length_of(curve) / along) + 2,
                       .lines = 8,
                       .curve = Side::top,
                       .spacing = h});
}

bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto cross = [](const Vec2& u, const Vec2& v) { return u[0] * v[1] - u[1] * v[0]; };
  const Vec2 u = b - a, v = d - c;
  const double area = cross(u, v);
  if (area == 0) return false;
  const double s = cross(c - a, v) / area, r = cross(c - a, u) / area;
  constexpr double on = 1e-6;  // what lies on the curve belongs to the domain
  return s > on && s < 1 - on && r >= 0 && r <= 1;
}

/// Discretised points of the background whose stencil reaches through the curve.
int through(const CompositeGrid& grids, const Marched& ring) {
  int count = 0;
  const CartesianGrid& background = grids.background();
  const auto crossed = [&](const Vec2& a, const Vec2& b) {
    const std::size_t n = ring.curve.size() / 2;
    for (std::size_t k = 0; k + 1 < n; ++k) {
      if (meet(a, b, {ring.curve[k], ring.curve[n + k]}, {ring.curve[k + 1], ring.curve[n + k + 1]}))
        return true;
    }
    return false;
  };
  for (int j = 0; j < background.n2; ++j) {
    for (int i = 0; i < background.n1; ++i) {
      if (grids.kind(0, i, j) != PointKind::discretised) continue;
      const Vec2 x = background.point(i, j);
      for (const Vec2& step :
           {Vec2(layers * h, 0), Vec2(-layers * h, 0), Vec2(0, layers * h), Vec2(0, -layers * h)})
        count += crossed(x, x + step);
    }
  }
  return count;
}

CompositeGrid connected(const Marched& ring) {
  CompositeGrid grids({.n1 = 41, .n2 = 41, .x_a = -1, .x_b = 1, .y_a = -1, .y_b = 1},
                      {{.name = "ring",
                        .n1 = ring.description.points,
                        .n2 = ring.description.lines,
                        .curve = ring.description.curve}},
                      {.layers = layers});
  const ConstFieldView views[] = {ring.x.view()};
  grids.connect(views, 0);
  return grids;
}

TEST(ThinBodies, NoPointOfTheBackgroundReachesThroughAPlate) {
  for (const double thickness : {0.2 * h, 0.6 * h, h, 1.3 * h}) {
    for (const double angle : {0.0, 0.5 * 3.14159265358979, 0.3, 0.25 * 3.14159265358979, 1.2}) {
      for (const double place : {0.0, 0.25 * h, 0.5 * h, 0.77 * h}) {
        const Plate plate{.middle = {place, place}, .thickness = thickness, .angle = angle};
        const Marched ring = ring_around(
            rounded_polygon({.corners = plate.corners(), .ends = Curve::closed, .radius = 0.09 * h}));
        const CompositeGrid grids = connected(ring);
        EXPECT_EQ(through(grids, ring), 0)
            << thickness << " thick, at an angle of " << angle << ", at " << place;
      }
    }
  }
}

TEST(ThinBodies, ABodyThatLiesWithinACellTakesThePointBesideIt) {
  for (const double place : {0.3 * h, 0.6 * h}) {
    const CompositeGrid grids = connected(ring_around(circle({place, 0.4 * h}, 0.2 * h)));
    EXPECT_EQ(grids.kind(0, place < 0.5 * h ? 20 : 21, 20), PointKind::unused) << place;
    EXPECT_EQ(grids.kind(0, 20, 22), PointKind::interpolated);
  }
}

/// Points behind a plate of half a cell that stands on a side of the square, between two lines of the grid, and where it
/// passes between points.
struct BehindPlate {
  int holes = 0;
  std::size_t pinches = 0;

  /// @param turns quarter turns from the lower side
  explicit BehindPlate(int turns) {
    const CartesianGrid square{.n1 = 41, .n2 = 41, .x_a = -1, .x_b = 1, .y_a = -1, .y_b = 1};
    std::vector<double> x, y;
    for (Vec2 corner : {Vec2(2.2 * h, -1), Vec2(2.2 * h, -0.42), Vec2(2.7 * h, -0.42), Vec2(2.7 * h, -1)}) {
      for (int k = 0; k < turns; ++k) corner = Vec2(-corner[1], corner[0]);
      x.push_back(corner[0]);
      y.push_back(corner[1]);
    }
    CurveCut cut;
    cut.cut(square, {.x = x.data(), .y = y.data(), .points = 4, .ends = Curve::open}, "plate", 0);
    std::vector<Interval> parts;
    for (int j = 0; j < square.n2; ++j) cut.append_holes(j, square.n1, parts);
    for (const Interval& part : parts) holes += part.end - part.begin;
    pinches = cut.pinches().size();
  }
};

TEST(ThinBodies, APlateOnAWallPassesBetweenPointsAlikeOnEverySide) {
  for (const int turns : {0, 1, 2, 3}) {
    const BehindPlate plate(turns);
    EXPECT_EQ(plate.holes, 0) << turns;
    EXPECT_EQ(plate.pinches, 12) << turns;  // lines from the wall to the end, 11.6 cells
  }
}

TEST(ThinBodies, WhereAPointLiesBehindTheCurveNothingChanges) {
  // The top of the disk passes between two points of a row.
  const Marched ring = ring_around(circle({0.5 * h, 0}, 0.3 + 0.01 * h));
  const CompositeGrid grids = connected(ring);
  for (int j = 0; j < 41; ++j) {
    for (int i = 0; i < 41; ++i) {
      const double r = (grids.background().point(i, j) - Vec2(0.5 * h, 0)).norm();
      if (r > 0.3 + 0.02 * h && r < 0.3 + 0.9 * h) {
        EXPECT_EQ(grids.kind(0, i, j), PointKind::interpolated) << i << ", " << j;
      }
    }
  }
}

}  // namespace
}  // namespace fsi::grid::thin_bodies
