/// Area, centre and second moment of plane regions.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "common/grid/shapes/ellipse.hpp"
#include "solid_solver/rigid/inertia.hpp"

namespace fsi::rigid {
namespace {

using std::numbers::pi;

/// A rectangle of sides 2 and 1 with a corner at `corner`, turned by `angle` about it.
std::vector<double> rectangle(const Vec2& corner, double angle) {
  const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  std::vector<double> x(8);
  const Vec2 corners[] = {corner, corner + 2 * along, corner + 2 * along + across, corner + across};
  for (std::size_t k = 0; k < 4; ++k) {
    x[k] = corners[k].x();
    x[4 + k] = corners[k].y();
  }
  return x;
}

TEST(Inertia, OfARectangleIsExactWhereverItLies) {
  for (const double far : {0.0, 1e3}) {
    const Inertia body = inertia_of(rectangle({far, -far}, 0.7));
    EXPECT_NEAR(body.area, 2, 1e-12);
    EXPECT_NEAR(body.second_moment, 2 * (4 + 1) / 12.0, 1e-11);
    EXPECT_NEAR((body.centre - Vec2(far, -far)).norm(), std::hypot(1, 0.5), 1e-12);
  }
}

TEST(Inertia, OfAnEllipseIsOfSecondOrderInTheSpacingOfItsPoints) {
  const double a = 1.25, b = 0.5, area = pi * a * b, moment = area * (a * a + b * b) / 4;
  const auto errors = [&](int n) {
    const Inertia body =
        inertia_of(grid::points_on(grid::ellipse({.centre = {-1, 0}, .a = a, .b = b, .angle = pi / 4}), n));
    EXPECT_NEAR((body.centre - Vec2(-1, 0)).norm(), 0, 1e-9);
    return Vec2(std::abs(body.area / area - 1), std::abs(body.second_moment / moment - 1));
  };
  const Vec2 coarse = errors(81), fine = errors(161);
  EXPECT_LE(fine.maxCoeff(), 2e-3);
  for (int k = 0; k < 2; ++k) EXPECT_GE(std::log2(coarse[k] / fine[k]), 1.95);
}

TEST(Inertia, TheSeamOfARingCancels) {
  // A square of side 3 with a square hole of side 1: once
  // around outside, along the seam, back around the hole.
  const std::vector<double> x{0, 3, 3, 0, 0, 1, 1, 2, 2, 1, /**/ 0, 0, 3, 3, 0, 1, 2, 2, 1, 1};
  const Inertia ring = inertia_of(x);
  EXPECT_NEAR(ring.area, 9 - 1, 1e-14);
  EXPECT_NEAR((ring.centre - Vec2(1.5, 1.5)).norm(), 0, 1e-14);
  EXPECT_NEAR(ring.second_moment, (81 - 1) / 6.0, 1e-13);
}

TEST(Inertia, ARimTheWrongWayRoundIsRefused) {
  EXPECT_THROW(inertia_of(std::vector<double>{0, 0, 1, 0, 1, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace fsi::rigid
