#include "common/grid/moving_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/failure.hpp"
#include "common/grid/shapes/circle.hpp"

namespace fsi::grid {
namespace {

GridDescription unit_square(int n1, int n2) {
  return {
      .name = "square", .n1 = n1, .n2 = n2, .mapping = [](double r, double s, double) { return Vec2(r, s); }};
}

TEST(MovingGrid, PlacesVerticesAndGhostsOnTheMapping) {
  const MovingGrid grid(unit_square(11, 6), 0);
  EXPECT_DOUBLE_EQ(grid.x()(0, 3, 2), 0.3);
  EXPECT_DOUBLE_EQ(grid.x()(1, 3, 2), 0.4);
  EXPECT_DOUBLE_EQ(grid.x()(0, -2, 2), -0.2);
  EXPECT_DOUBLE_EQ(grid.x()(1, 3, 7), 1.4);
}

TEST(MovingGrid, FollowsACommandedSideAndKeepsTheOppositeSide) {
  auto description = unit_square(11, 6);
  description.follows = true;
  MovingGrid grid(description, 0);
  std::vector<double> command = grid.side_points(Side::left);
  for (int k = 0; k < 6; ++k) command[static_cast<std::size_t>(k)] += 0.2;
  const SideCommand commands[] = {{Side::left, command}};
  grid.move(0.1, commands);
  EXPECT_EQ(grid.side_points(Side::left), command);
  EXPECT_DOUBLE_EQ(grid.x()(0, 10, 3), 1.0);
  // Halfway between, half the displacement; on the ghost line beyond the side, a little more than all of it.
  EXPECT_NEAR(grid.x()(0, 5, 3), 0.5 + 0.1, 1e-15);
  EXPECT_NEAR(grid.x()(0, -1, 3), -0.1 + 0.2 * 1.1, 1e-15);
  EXPECT_DOUBLE_EQ(grid.x_old()(0, 5, 3), 0.5);
}

TEST(MovingGrid, ShakesInnerPointsOnlyAndTheSameWayEveryTime) {
  auto description = unit_square(11, 11);
  description.shake = 0.2;
  MovingGrid a(description, 0), b(description, 0);
  a.move(0.1);
  b.move(0.1);
  EXPECT_NE(a.x()(0, 5, 5), 0.5);
  EXPECT_LE(std::abs(a.x()(0, 5, 5) - 0.5), 0.02 + 1e-15);
  EXPECT_DOUBLE_EQ(a.x()(0, 0, 5), 0.0);
  for (int j = 0; j < 11; ++j) {
    for (int i = 0; i < 11; ++i) EXPECT_EQ(a.x()(1, i, j), b.x()(1, i, j));
  }
}

TEST(MovingGrid, IsMarchedFromTheCommandedCurve) {
  const HyperbolicGrid ring{.name = "ring", .points = 65, .lines = 6, .curve = Side::top, .spacing = 0.05};
  std::vector<double> curve = points_on(circle({0, 0}, 1), 65);
  MovingGrid grid(marched_from(ring, curve), 0);
  EXPECT_TRUE(grid.moves());
  EXPECT_TRUE(grid.periodic(0));
  EXPECT_EQ(grid.side_points(Side::top), curve);
  for (std::size_t k = 0; k < 65; ++k) curve[k] += 0.1;
  const SideCommand commands[] = {{Side::top, curve}};
  grid.move(0.1, commands);
  EXPECT_EQ(grid.side_points(Side::top), curve);
  // A shifted curve shifts the whole grid.
  EXPECT_NEAR(grid.x()(0, 13, 0) - grid.x_old()(0, 13, 0), 0.1, 1e-14);
  EXPECT_NEAR(grid.x()(1, 13, 7) - grid.x_old()(1, 13, 7), 0.0, 1e-14);
  grid.move(0.2);
  EXPECT_EQ(grid.side_points(Side::top), curve);
}

TEST(MovingGrid, NamesGridPointAndTimeOfAFoldedCell) {
  auto description = unit_square(11, 6);
  description.moving = true;
  description.mapping = [](double r, double s, double t) { return Vec2(r + t * std::sin(7 * r), s); };
  MovingGrid grid(description, 0);
  try {
    grid.move(0.5);
    FAIL() << "the fold went unnoticed";
  } catch (const NumbersBroke& broke) {
    const std::string words = broke.what();
    EXPECT_NE(words.find("square"), std::string::npos);
    EXPECT_NE(words.find("t = 0.5"), std::string::npos);
    EXPECT_NE(words.find("folded"), std::string::npos);
  }
}

}  // namespace
}  // namespace fsi::grid
