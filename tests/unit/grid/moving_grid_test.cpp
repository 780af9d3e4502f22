#include "common/grid/moving_grid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

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

/// Where a smooth map of the whole square takes a side: its commands agree at the corners.
std::vector<double> carried(const MovingGrid& grid, Side side) {
  std::vector<double> x = grid.side_points(side);
  const std::size_t n = x.size() / 2;
  for (std::size_t k = 0; k < n; ++k) {
    const double X = x[k], Y = x[n + k];
    x[k] += 0.05 + 0.04 * std::sin(3 * Y) + 0.03 * X * X;
    x[n + k] += -0.02 + 0.05 * std::cos(2 * X) - 0.03 * X * Y;
  }
  return x;
}

void expect_side(const MovingGrid& grid, Side side, const std::vector<double>& command) {
  const std::vector<double> x = grid.side_points(side);
  for (std::size_t k = 0; k < x.size(); ++k)
    EXPECT_NEAR(x[k], command[k], 1e-15) << name_of(side) << " " << k;  // round-off of numbers of order one
}

TEST(MovingGrid, TakesAdjacentSidesWhereTheyAreToldInWhateverOrder) {
  auto description = unit_square(11, 6);
  description.follows = true;
  MovingGrid grid(description, 0), other(description, 0);
  std::vector<std::vector<double>> told;
  for (const Side side : all_sides) told.push_back(carried(grid, side));
  std::vector<SideCommand> commands;
  for (const Side side : {Side::left, Side::bottom, Side::right, Side::top})
    commands.push_back({side, told[static_cast<std::size_t>(side)]});
  for (std::size_t count = 2; count <= 4; ++count) {
    const std::span<const SideCommand> some = std::span(commands).first(count);
    grid.move(0.1, some);
    const std::vector<SideCommand> reversed(some.rbegin(), some.rend());
    other.move(0.1, reversed);
    for (const SideCommand& command : some) {
      expect_side(grid, command.side, told[static_cast<std::size_t>(command.side)]);
      expect_side(other, command.side, told[static_cast<std::size_t>(command.side)]);
    }
    for (int j = -2; j < 8; ++j) {
      for (int i = -2; i < 13; ++i) EXPECT_NEAR(grid.x()(0, i, j), other.x()(0, i, j), 1e-14);
    }
  }
}

TEST(MovingGrid, PutsACornerToldTwoPlacesInTheMiddleAndNothingElse) {
  auto description = unit_square(11, 6);
  description.follows = true;
  MovingGrid grid(description, 0);
  std::vector<double> left = carried(grid, Side::left), bottom = carried(grid, Side::bottom);
  const double x_left = left[0] += 0.02, x_bottom = bottom[0] -= 0.01;
  const SideCommand commands[] = {{Side::left, left}, {Side::bottom, bottom}};
  grid.move(0.1, commands);
  left[0] = bottom[0] = 0.5 * (x_left + x_bottom);
  expect_side(grid, Side::left, left);
  expect_side(grid, Side::bottom, bottom);
}

TEST(MovingGrid, NamesTheSidesThatAreToldPlacesACellApartForTheirCorner) {
  auto description = unit_square(11, 6);
  description.follows = true;
  MovingGrid grid(description, 0);
  std::vector<double> right = grid.side_points(Side::right), top = grid.side_points(Side::top);
  right[5] += 0.07;
  top[10] -= 0.07;
  const SideCommand commands[] = {{Side::right, right}, {Side::top, top}};
  try {
    grid.move(0.1, commands);
    FAIL() << "the corner has two places";
  } catch (const Diverged& broke) {
    const std::string words = broke.what();
    EXPECT_NE(words.find("square"), std::string::npos);
    EXPECT_NE(words.find("right and top"), std::string::npos) << words;
    EXPECT_NE(words.find("0.14 apart"), std::string::npos) << words;
  }
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
  } catch (const Diverged& broke) {
    const std::string words = broke.what();
    EXPECT_NE(words.find("square"), std::string::npos);
    EXPECT_NE(words.find("t = 0.5"), std::string::npos);
    EXPECT_NE(words.find("folded"), std::string::npos);
  }
}

/// A strip above a line that rises by one half from the wall x = 0 to the wall x = 1.
MovingGrid strip_between_walls(std::vector<double>& curve) {
  constexpr std::size_t n = 21;
  curve.assign(2 * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    curve[k] = static_cast<double>(k) / static_cast<double>(n - 1);
    curve[n + k] = 0.5 * curve[k];
  }
  const HyperbolicGrid strip{.name = "strip",
                             .points = static_cast<int>(n),
                             .lines = 6,
                             .curve = Side::bottom,
                             .ends = Curve::open,
                             .spacing = 0.05,
                             .walls = {Vec2(0, 1), Vec2(0, 1)}};
  return {marched_from(strip, curve), 0};
}

TEST(MovingGrid, AnEndThatIsToldToLeaveItsWallGoesAlongItsCurveToTheWall) {
  std::vector<double> curve;
  MovingGrid grid = strip_between_walls(curve);
  const std::size_t n = curve.size() / 2;
  // Everything along the normal, (-1, 2): both ends leave their walls, the last one inwards.
  for (std::size_t k = 0; k < n; ++k) curve[k] -= 0.01, curve[n + k] += 0.02;
  grid.move(0.1, std::array{SideCommand{Side::bottom, curve}});
  const std::vector<double> x = grid.side_points(Side::bottom);
  EXPECT_NEAR(x[0], 0, 1e-15);
  EXPECT_NEAR(x[n - 1], 1, 1e-15);
  // The line y = x / 2 + 0.025, which was told, meets the walls at 0.025 and 0.525.
  EXPECT_NEAR(x[n], 0.025, 1e-15);
  EXPECT_NEAR(x[2 * n - 1], 0.525, 1e-15);
  for (std::size_t k = 1; k + 1 < n; ++k) EXPECT_EQ(x[k], curve[k]);
  for (const int j : {0, 3, 5}) {
    EXPECT_NEAR(grid.x()(0, 0, j), 0, 1e-14);
    EXPECT_NEAR(grid.x()(0, static_cast<int>(n) - 1, j), 1, 1e-14);
  }
}

TEST(MovingGrid, AnEndFarFromItsWallEndsTheRunByName) {
  std::vector<double> curve;
  MovingGrid grid = strip_between_walls(curve);
  for (std::size_t k = 0; k < curve.size() / 2; ++k) curve[k] *= 0.9;
  try {
    grid.move(0.1, std::array{SideCommand{Side::bottom, curve}});
    FAIL() << "the end is two cells from its wall";
  } catch (const Diverged& failure) {
    EXPECT_NE(std::string(failure.what()).find("has left the wall it stands on, by 0.1"), std::string::npos)
        << failure.what();
  }
}

}  // namespace
}  // namespace fsi::grid
