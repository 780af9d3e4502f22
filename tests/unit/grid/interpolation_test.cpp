// Values carried from grid to grid where points are donors of each other.

#include "common/grid/interpolation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "common/core/field.hpp"

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

}  // namespace
}  // namespace fsi::grid
