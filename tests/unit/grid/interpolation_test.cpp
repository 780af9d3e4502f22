// Values carried from grid to grid where points are donors of each other.

#include "common/grid/interpolation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "common/core/field.hpp"
#include "common/grid/composite_grid.hpp"

namespace fsi::grid {
namespace {

/// Two fields of one row; point 1 of each is the mean of two of the other, `on_each_other` of it its point 1.
std::vector<InterpolationList> mutual_donors(double on_each_other) {
  const Layout layout{3, 1};
  const auto at = [&](int i) { return static_cast<std::int32_t>(layout.at(i, 0)); };
  std::vector<InterpolationList> lists;
  for (const int target : {0, 1}) {
    InterpolationList list{.target_grid = target,
                           .donor_grid = 1 - target,
                           .width = 2,
                           .implicit = true,
                           .target = {},
                           .donor = {},
                           .weight = {}};
    list.target = {at(1)};
    list.donor = {at(0)};
    list.weight = {1 - on_each_other, on_each_other, 0, 0};
    lists.push_back(list);
  }
  return lists;
}

/// The two fields with the values at their points 0.
struct Pair {
  std::array<Field, 2> fields{Field({3, 1}, 1), Field({3, 1}, 1)};
  std::array<FieldView, 2> views{fields[0].view(), fields[1].view()};

  explicit Pair(std::array<double, 2> known) {
    for (std::size_t k = 0; k < 2; ++k) views[k](0, 0, 0) = known[k];
  }
  double value(std::size_t k) const { return views[k](0, 1, 0); }
};

TEST(ImplicitInterpolation, FindsTheCommonSolutionOrSaysThatItDidNot) {
  const auto settle = [](double on_each_other, Pair& pair) {
    return settle_implicit(mutual_donors(on_each_other), pair.views);
  };
  Pair constant({2, 2}), sound({0, 1}), steep({0, 1}), zero({0, 0});
  EXPECT_TRUE(settle(0.3, constant));
  EXPECT_NEAR(constant.value(0), 2, 1e-12);  // a constant is its own interpolation
  EXPECT_TRUE(settle(0.3, sound));
  EXPECT_NEAR(sound.value(0), 0.7 / 0.91, 1e-12);  // a = 0.7 + 0.3 b, b = 0.3 a
  EXPECT_FALSE(settle(1.5, steep));                // each sweep takes it farther away
  EXPECT_TRUE(settle(1.5, zero));
}

TEST(ImplicitInterpolation, IsSolvedByEliminationWhereSweepsDoNotSettle) {
  Pair sound({0, 1}), steep({0, 1});
  EXPECT_FALSE(solve_implicit(mutual_donors(0.3), sound.views).has_value());
  EXPECT_NEAR(sound.value(0), 0.7 / 0.91, 1e-14);
  EXPECT_FALSE(settle_implicit(mutual_donors(1.5), steep.views));
  EXPECT_FALSE(solve_implicit(mutual_donors(1.5), steep.views).has_value());
  EXPECT_NEAR(steep.value(0), 0.4, 1e-14);  // a = -0.5 + 1.5 b, b = 1.5 a
  EXPECT_NEAR(steep.value(1), 0.6, 1e-14);
}

TEST(ImplicitInterpolation, WithoutASolutionNamesAPoint) {
  Pair same({0, 1});
  const auto unsolved = solve_implicit(mutual_donors(1), same.views);  // a = b and nothing else
  ASSERT_TRUE(unsolved.has_value());
  EXPECT_LT(unsolved->list, 2U);
  EXPECT_EQ(unsolved->point, 0U);
}

/// Around the unit circle, the domain outside: `lines` lines, clockwise along the circle, a distance h apart.
Field ring_of(double h, int lines) {
  const double pi = std::numbers::pi;
  const int points = static_cast<int>(std::lround(2 * pi / h)) + 1;
  Field x(Layout(points, lines), 2);
  for (int j = -Layout::ghosts; j < lines + Layout::ghosts; ++j) {
    for (int i = -Layout::ghosts; i < points + Layout::ghosts; ++i) {
      const double angle = -2 * pi * i / (points - 1), r = 1 + j * h;
      x(0, i, j) = r * std::cos(angle);
      x(1, i, j) = r * std::sin(angle);
    }
  }
  return x;
}

/// No values solve equations that are not finite.
TEST(CompositeGrid, ImplicitPointsWithoutASolutionAreNamedWithPlaceAndTime) {
  const double h = 0.05;
  const Field ring = ring_of(h, 6);
  CompositeGrid grids({.name = "box", .n1 = 81, .n2 = 81, .x_a = -2, .x_b = 2, .y_a = -2, .y_b = 2},
                      {{.name = "ring", .n1 = ring.layout().n1, .n2 = ring.layout().n2}});
  const ConstFieldView x[] = {ring.view()};
  grids.connect(x, 0.25);
  ASSERT_GT(grids.counts().implicit, 0U);
  std::vector<Field> fields;
  std::vector<FieldView> views;
  for (const int k : {0, 1}) fields.emplace_back(grids.layout(k), 1);
  for (Field& field : fields) {
    std::ranges::fill(field.values(), std::numeric_limits<double>::max());
    views.push_back(field.view());
  }
  for (double& value : fields[1].values()) value = -value;
  try {
    grids.interpolate(views);
    FAIL() << "found values";
  } catch (const NumbersBroke& broke) {
    const std::regex words(
        "t = 0\\.25, grid \"(\\w+)\", point \\((\\d+), (\\d+)\\) at \\(([^,]+), ([^)]+)\\): it and "
        "points of grid \"(\\w+)\" .*");
    const std::string message = broke.what();
    std::smatch match;
    ASSERT_TRUE(std::regex_match(message, match, words)) << message;
    EXPECT_NE(match[1], match[6]);
    const int i = std::stoi(match[2]), j = std::stoi(match[3]);
    const bool in_ring = match[1] == "ring";
    const Vec2 place = in_ring ? Vec2(ring(0, i, j), ring(1, i, j)) : grids.background().point(i, j);
    EXPECT_NEAR(std::stod(match[4]), place[0], 1e-5);
    EXPECT_NEAR(std::stod(match[5]), place[1], 1e-5);
  }
}

}  // namespace
}  // namespace fsi::grid
