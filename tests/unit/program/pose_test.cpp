#include "solid_solver/measures/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fsi::solid {
namespace {

TEST(Pose, FollowsARigidMotionOfASkewedBody) {
  const Layout layout(9, 7);
  Field reference(layout, 2), state(layout, 8);
  const double angle = 2.2, c = std::cos(angle), s = std::sin(angle);
  Vec2 centre = Vec2::Zero();
  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 9; ++i) {
      const double x = 0.1 * i + 0.03 * j, y = 0.1 * j;
      reference(0, i, j) = x;
      reference(1, i, j) = y;
      state(0, i, j) = c * x - s * y + 5 - x;
      state(1, i, j) = s * x + c * y - 3 - y;
      state(2, i, j) = 0.25;
      state(3, i, j) = -4;
      centre += Vec2(x, y) / 63.0;
    }
  }
  const Pose pose = pose_of(reference.view(), state.view());
  EXPECT_NEAR(pose.angle, angle, 1e-12);
  EXPECT_NEAR((pose.velocity - Vec2(0.25, -4)).norm(), 0, 1e-13);
  EXPECT_NEAR(pose.centre[0], c * centre[0] - s * centre[1] + 5, 1e-12);
  EXPECT_NEAR(pose.centre[1], s * centre[0] + c * centre[1] - 3, 1e-12);
}

}  // namespace
}  // namespace fsi::solid
