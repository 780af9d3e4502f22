// Geometry of the reference grid and deformation gradients.

#include <gtest/gtest.h>

#include <cmath>

#include "solid_solver/kernels/sweep/dissipation.hpp"
#include "solid_solver/laws/neo_hookean.hpp"
#include "solid_solver/measures/body_integrals.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"

namespace fsi::solid {
namespace {

TEST(Eq32Metrics, FacesOfEveryControlVolumeClose) {
  const grid::MovingGrid grid = test::skewed_grid(12);
  const ReferenceMetrics metrics(grid.x());
  ASSERT_FALSE(metrics.cartesian());
  const ConstFieldView m = metrics.values();
  using M = ReferenceMetrics;
  for (int j = 0; j < 13; ++j) {
    for (int i = 0; i < 13; ++i) {
      // Sums of four numbers of size 0.1.
      EXPECT_NEAR(m(M::a1x, i + 1, j) - m(M::a1x, i, j) + m(M::a2x, i, j + 1) - m(M::a2x, i, j), 0, 1e-16);
      EXPECT_NEAR(m(M::a1y, i + 1, j) - m(M::a1y, i, j) + m(M::a2y, i, j + 1) - m(M::a2y, i, j), 0, 1e-16);
    }
  }
}

TEST(Eq32Metrics, CartesianGridsStoreNone) {
  const grid::MovingGrid grid = test::unit_square(10);
  const ReferenceMetrics metrics(grid.x());
  EXPECT_TRUE(metrics.cartesian());
  EXPECT_EQ(metrics.values().planes, 0);
  EXPECT_NEAR(metrics.at(3, 4).jacobian, 0.01, 1e-16);
}

/// Field of u = G x with v = H x.
Field linear_field(const grid::MovingGrid& grid, const Mat2& G, const Mat2& H) {
  Field q(grid.layout(), plane::count);
  for (int j = -2; j < grid.layout().n2 + 2; ++j) {
    for (int i = -2; i < grid.layout().n1 + 2; ++i) {
      const Vec2 x(grid.x()(0, i, j), grid.x()(1, i, j));
      store(q.view(), grid.layout().at(i, j), {.u = G * x, .v = H * x, .P = {}});
    }
  }
  return q;
}

TEST(Eq33DeformationGradient, IsExactForLinearMotionOnASkewedGridEq3) {
  const grid::MovingGrid grid = test::skewed_grid(12);
  const ReferenceMetrics metrics(grid.x());
  const Mat2 G = (Mat2() << 0.1, -0.3, 0.2, 0.05).finished(), H = (Mat2() << 1, 2, 3, 4).finished();
  const Field q = linear_field(grid, G, H);
  const double time = 0.1;
  for (int j = 0; j < 13; ++j) {
    const MappedRow row(metrics, j);
    const StateRows rows(q.view(), j);
    const MappedGradient4 gradient4(grid.x(), metrics, j);
    const WideRow u1(q.view(), plane::u1, j), u2(q.view(), plane::u2, j);
    for (int i = 0; i < 13; ++i) {
      const Tensor2 F = deformation_gradient(row, rows, i, time);
      EXPECT_NEAR(F.a11, 1 + G(0, 0) + time * H(0, 0), 1e-13);
      EXPECT_NEAR(F.a12, G(0, 1) + time * H(0, 1), 1e-13);
      EXPECT_NEAR(F.a21, G(1, 0) + time * H(1, 0), 1e-13);
      EXPECT_NEAR(F.a22, 1 + G(1, 1) + time * H(1, 1), 1e-13);
      const Tensor2 wide = gradient4(i, u1.first(i), u2.first(i));
      EXPECT_NEAR(wide.a12, G(0, 1), 1e-13);
      EXPECT_NEAR(wide.a21, G(1, 0), 1e-13);
    }
  }
}

TEST(Eq13AreaRatio, IsTheChangeOfLengthOfABoundaryElement) {
  const Tensor2 F = {1.3, 0.2, -0.4, 0.9};
  const Vec2 n0(0.6, 0.8), t0(-0.8, 0.6);
  const double eps = 0.01;
  const auto moved = [&](const Vec2& x) {
    return Vec2(F.a11 * x.x() + F.a12 * x.y(), F.a21 * x.x() + F.a22 * x.y());
  };
  EXPECT_NEAR(area_ratio(F, n0.x(), n0.y()), eps / (moved(Vec2(1, 2) + eps * t0) - moved({1, 2})).norm(),
              1e-12);
}

TEST(Eq13AreaRatio, IsOneForRotations) {
  EXPECT_NEAR(area_ratio({std::cos(0.7), -std::sin(0.7), std::sin(0.7), std::cos(0.7)}, 0.6, 0.8), 1, 1e-15);
}

}  // namespace
}  // namespace fsi::solid
