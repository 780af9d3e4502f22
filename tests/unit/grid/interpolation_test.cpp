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

bool settle(double on_each_other, std::array<double, 2> known, double& value) {
  std::array<Field, 2> fields{Field({3, 1}, 1), Field({3, 1}, 1)};
  for (std::size_t k = 0; k < 2; ++k) fields[k].view()(0, 0, 0) = known[k];
  const std::array<FieldView, 2> views{fields[0].view(), fields[1].view()};
  const bool settled = settle_implicit(mutual_donors(on_each_other), views);
  value = views[0](0, 1, 0);
  return settled;
}

TEST(ImplicitInterpolation, FindsTheCommonSolutionOrSaysThatItDidNot) {
  double value = 0;
  EXPECT_TRUE(settle(0.3, {2, 2}, value));
  EXPECT_NEAR(value, 2, 1e-12);  // a constant is its own interpolation
  EXPECT_TRUE(settle(0.3, {0, 1}, value));
  EXPECT_NEAR(value, 0.7 / 0.91, 1e-12);     // a = 0.7 + 0.3 b, b = 0.3 a
  EXPECT_FALSE(settle(1.5, {0, 1}, value));  // each sweep takes it farther away
  EXPECT_TRUE(settle(1.5, {0, 0}, value));
}

}  // namespace
}  // namespace fsi::grid
