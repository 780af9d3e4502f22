// Values carried from grid to grid where points are donors of each other.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/core/field.hpp"
#include "common/grid/overlap/implicit_system.hpp"

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

/// Both grids have a row of three points.
constexpr std::array layouts{Layout{3, 1}, Layout{3, 1}};

TEST(ImplicitInterpolation, FindsTheCommonSolutionBySweepsOrByElimination) {
  for (const double on_each_other : {0.0, 0.3, 0.45, 0.7, 1.5, -0.4, -1.5}) {
    const auto lists = mutual_donors(on_each_other);
    const ImplicitSystem system(lists, layouts);
    EXPECT_EQ(system.factored(), std::abs(on_each_other) > 0.5) << on_each_other;
    Pair constant({2, 2}), pair({0, 1}), zero({0, 0});
    system.solve(lists, constant.views);
    EXPECT_NEAR(constant.value(0), 2, 1e-12);  // a constant is its own interpolation
    system.solve(lists, pair.views);
    for (const std::size_t k : {0U, 1U}) {  // the equations themselves
      const double known = pair.views[1 - k](0, 0, 0);
      EXPECT_NEAR(pair.value(k), (1 - on_each_other) * known + on_each_other * pair.value(1 - k), 1e-12);
    }
    system.solve(lists, zero.views);
    EXPECT_EQ(zero.value(0), 0);
  }
}

TEST(ImplicitInterpolation, KnowsHowMuchErrorsGrow) {
  // a = (1 - w) f + w b, b = (1 - w) g + w a, so a = ((1 -
  // w) f + w (1 - w) g) / (1 - w^2) = (f + w g) / (1 + w). What the two equations are off by goes in like (1 - w) f.
  for (const double w : {0.6, 1.5, -0.6, -0.9}) {
    const ImplicitSystem system(mutual_donors(w), layouts);
    const double own = ImplicitSystem::own_error / std::abs(1 - w);
    EXPECT_NEAR(system.amplification(), (1 + own) * (1 + std::abs(w)) / std::abs(1 + w), 1e-12) << w;
  }
}

TEST(ImplicitInterpolation, WithoutASolutionSaysSoAndNamesAPoint) {
  for (const double singular : {1.0, -1.0}) {
    const ImplicitSystem system(mutual_donors(singular), layouts);
    EXPECT_GT(system.amplification(), 1e12);
    EXPECT_LT(system.worst().list, 2U);
    EXPECT_EQ(system.worst().point, 0U);
    EXPECT_TRUE(system.amplifiers(mutual_donors(singular)).empty());  // they have two donors each already
  }
}

// As where points of two grids lie on each other but for round-off, of whatever sign.
TEST(ImplicitInterpolation, WeightsOfRoundOffAreNoTieToKnownValues) {
  for (const double off : {-1e-15, 1e-15, -1e-12, 1e-12, 1e-9}) {
    const ImplicitSystem system(mutual_donors(1 - off), layouts);
    EXPECT_GT(system.amplification(), 1e4) << off;
  }
}

TEST(ImplicitInterpolation, ListsLoseEntriesAndKeepTheOthers) {
  InterpolationList list{.width = 2, .implicit = true, .target = {}, .donor = {}, .weight = {}};
  for (const int k : {0, 1, 2})
    list.append(10 + k, 20 + k, {.width = 2, .r = 0.25 * k, .s = 0.5}, {1.0 * k, 0});
  InterpolationList wanted = list;
  list.move(2, 1);
  list.cut(2);
  EXPECT_EQ(list.target, (std::vector<std::int32_t>{10, 12}));
  EXPECT_EQ(list.donor, (std::vector<std::int32_t>{20, 22}));
  EXPECT_EQ(list.x[1][0], 2);
  for (const std::size_t m : {0U, 1U, 2U, 3U}) EXPECT_EQ(list.weight[4 + m], wanted.weight[8 + m]);
}

TEST(Interpolation, GivesEachPlaneTheSameBitsWhateverPlanesGoWithIt) {
  constexpr int planes = 7;
  const Layout layout(6, 5);
  for (const int width : {2, 3}) {
    InterpolationList list{
        .target_grid = 0, .donor_grid = 1, .width = width, .target = {}, .donor = {}, .weight = {}};
    for (int k = 0; k < 4; ++k) {
      const Stencil stencil{.grid = 1, .i = k, .j = 1, .width = width, .r = 0.3 + 0.1 * k, .s = 0.8};
      list.append(layout.at(k, 2), layout.at(k, 1), stencil);
    }
    Field target(layout, planes), donor(layout, planes);
    for (std::size_t k = 0; k < donor.values().size(); ++k)
      donor.values()[k] = std::sin(1.7 * static_cast<double>(k));
    const std::array<FieldView, 2> together{target.view(), donor.view()};
    grid::apply(list, together);
    for (int p = 0; p < planes; ++p) {
      Field alone(layout, 1), its_donor(layout, 1);
      std::copy_n(donor.view().plane(p), layout.plane_size(), its_donor.view().data);
      const std::array<FieldView, 2> one{alone.view(), its_donor.view()};
      grid::apply(list, one);
      for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(target(p, k, 2), alone(0, k, 2)) << width << ", plane " << p;
        EXPECT_NE(target(p, k, 2), 0);
      }
    }
  }
}

}  // namespace
}  // namespace fsi::grid
