#include "common/grid/geometry/interface_geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace fsi::grid {
namespace {

std::vector<double> circle(std::size_t n, double part) {
  std::vector<double> x(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = part * 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n - 1);
    x[k] = std::cos(angle);
    x[n + k] = std::sin(angle);
  }
  return x;
}

TEST(InterfaceGeometry, NormalsOfAClosedCircleAreRadialToRoundOff) {
  const auto x = circle(33, 1.0);
  const auto n = normals(x, Curve::closed, 1);
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(n[k], x[k], 1e-14);
}

/// The last point is the first one of the next period: a straight line has one normal, with few points too.
TEST(InterfaceGeometry, NormalsOfAPeriodicLineAreOneToRoundOff) {
  const std::vector<double> x = {0.25, 0.25, 0.25, 0.25, 0.25, 0.0, 0.1, 0.2, 0.3, 0.4};
  const auto n = normals(x, Curve::closed, 1);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(n[k], 1, 1e-15);
    EXPECT_NEAR(n[5 + k], 0, 1e-15);
  }
}

TEST(InterfaceGeometry, NormalsOfAnArcAreSecondOrderAtItsEnds) {
  const auto error = [](std::size_t points) {
    const auto x = circle(points, 0.25);
    const auto n = normals(x, Curve::open, 1);
    return std::hypot(n[0] - x[0], n[points] - x[points]);
  };
  EXPECT_GT(std::log2(error(17) / error(33)), 1.9);
}

}  // namespace
}  // namespace fsi::grid
