/// Where the ghost points of grids around sharp corners lie.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "common/grid/marching/ghost_points.hpp"
#include "common/grid/marching/hyperbolic.hpp"

namespace fsi::grid {
namespace {

/// Points of a square of side 1 with sharp corners, anticlockwise, the first one again at the end.
std::vector<double> square(int of_side) {
  const int n = 4 * of_side + 1;
  std::vector<double> curve(static_cast<std::size_t>(2 * n));
  const std::array<Vec2, 4> corners{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  for (int k = 0; k < n; ++k) {
    const auto side = static_cast<std::size_t>(k / of_side % 4);
    const Vec2 place = corners[side] + (corners[(side + 1) % 4] - corners[side]) * (k % of_side) / of_side;
    for (const int c : {0, 1}) curve[static_cast<std::size_t>(c * n + k)] = place[c];
  }
  return curve;
}

TEST(GhostPoints, BehindASharpCornerKeepTheirDistanceAndOthersTheirPlaces) {
  constexpr int of_side = 12, n = 4 * of_side + 1, lines = 8;
  HyperbolicMarch marcher({.points = n, .lines = lines, .curve = Side::top, .spacing = 0.08});
  Field x(marcher.layout(), 2);
  marcher.march(square(of_side), x.view(), 0);
  const auto at = [&](int i, int j) { return Vec2(x(0, i, j), x(1, i, j)); };
  double least = 1;
  for (int i = 0; i < n; ++i) {
    const Vec2 across = at(i, lines + 1) - at(i, lines - 1),
               own = at(i + 1, lines - 1) - at(i - 1, lines - 1),
               behind = at(i + 1, lines) - at(i - 1, lines);
    const double ratio =
        (behind[0] * across[1] - behind[1] * across[0]) / (own[0] * across[1] - own[1] * across[0]);
    least = std::min(least, ratio);
    if (i % of_side != of_side / 2) continue;  // in the middle of a side
    const Vec2 third_order = 3 * (at(i, lines - 1) - at(i, lines - 2)) + at(i, lines - 3);
    EXPECT_NEAR((at(i, lines) - third_order).norm(), 0, 1e-14) << i;
  }
  EXPECT_GT(least, 0.8 * least_ghost_distance);  // 0.03 without that bound
  for (const int g : {0, 1}) {
    EXPECT_EQ(at(-1, lines + g), at(n - 2, lines + g));
    EXPECT_EQ(at(n, lines + g), at(1, lines + g));
  }
}

}  // namespace
}  // namespace fsi::grid
