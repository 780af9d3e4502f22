/// What levels are made of: sets of points, averages of a finer level and polynomials for it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include "common/core/field.hpp"
#include "fluid_solver/levels/cell_mask.hpp"
#include "fluid_solver/levels/transfer.hpp"

namespace fsi::fluid {
namespace {

TEST(Field, ClearsAPlaneAndLeavesTheOthers) {
  for (const int width : {5, 700}) {  // small, and so large that its pages are given back
    Field field(Layout(width, 400), 3);
    std::ranges::fill(field.values(), 1.5);
    field.clear_plane(1);
    const auto n = static_cast<std::ptrdiff_t>(field.layout().plane_size());
    const auto first = field.values().begin();
    EXPECT_EQ(std::count(first, first + n, 1.5), n);
    EXPECT_EQ(std::count(first + n, first + 2 * n, 0.0), n);
    EXPECT_EQ(std::count(first + 2 * n, first + 3 * n, 1.5), n);
  }
}

TEST(LevelPolynomials, HaveTheCoarseValuesAsAverages) {
  constexpr double gamma = 1.4;
  Field coarse(Layout(5, 5), 4), fine(Layout(13, 13), 4), averages(Layout(5, 5), 4);
  for (int j = -2; j < 7; ++j) {
    for (int i = -2; i < 7; ++i)
      store(coarse.view(), {i, j},
            {1.0 + 0.1 * i * i, 0.3 * j, std::sin(i + 2.0 * j), 2.0 + std::cos(3.0 * i * j)});
  }
  CellMask inner({5, 5, {}}), one = inner;
  for (int k = 1; k < 4; ++k) inner.set(k, 2), inner.set(2, k);
  one.set(2, 2);
  prolong_from(inner.rows(), std::as_const(coarse).view(), fine.view(), gamma);
  restrict_to(inner.rows(), averages.view(), std::as_const(fine).view(), {}, gamma);
  for (const auto& [i, j] : {std::pair{1, 2}, {2, 2}, {3, 2}, {2, 1}, {2, 3}}) {
    for (int plane = 0; plane < 4; ++plane) EXPECT_NEAR(averages(plane, i, j), coarse(plane, i, j), 1e-14);
  }
  EXPECT_GT(std::fabs(fine(2, 7, 6) - fine(2, 5, 6)), 0.01) << "no polynomial, but a constant";
  EXPECT_EQ(one.rows().points(), 1U);
}

TEST(LevelPolynomials, AverageTheDensityAlone) {
  constexpr double gamma = 1.4;
  Field fine(Layout(13, 13), 4), states(Layout(5, 5), 4), density(Layout(5, 5), 4);
  for (int j = 0; j < 13; ++j) {
    for (int i = 0; i < 13; ++i)
      store(fine.view(), {i, j}, {2.0 + std::sin(3.0 * i + j * j), 0.3 * j, 0.2 * i, 1.0});
  }
  CellMask all({5, 5, {}});
  all.set_all(true);
  const ConstFieldView from = std::as_const(fine).view();
  for (const Beyond beyond : {Beyond::mirror, Beyond::period, Beyond::other}) {
    const Ends ends{beyond, beyond, beyond, beyond};
    restrict_to(all.rows(), states.view(), from, ends, gamma);
    restrict_density(all.rows(), density.view(), from, ends);
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(density(0, i, j), states(0, i, j), 1e-14) << i << ", " << j;
        EXPECT_EQ(density(3, i, j), 0) << "what else there is, is kept";
      }
    }
  }
}

/// The last point of a period is the first one of the next: its control volume is the same.
TEST(LevelMembers, AreTheSameAtBothEndsOfAPeriod) {
  const std::array<Beyond, 2> period{Beyond::period, Beyond::period};
  const int n = 28;
  const Members first = members_of(0, n, period), last = members_of((n - 1) / refinement_ratio, n, period);
  ASSERT_EQ(first.n, 3);
  ASSERT_EQ(last.n, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(first.at[k] % (n - 1), last.at[k] % (n - 1));
    EXPECT_EQ(first.weight[k], last.weight[k]);
  }
}

TEST(LevelMembers, OfPeriodicPointsLieAroundTheirOwnAtTheEndsAsWithin) {
  const std::array<Beyond, 2> period{Beyond::period, Beyond::period};
  const int n = 28;
  const double turn = 2 * std::numbers::pi / (n - 1);
  for (int k = 0; k <= (n - 1) / refinement_ratio; ++k) {
    const Members members = members_of(k, n, period);
    double along = 0,
           across = 0;  // the mean of a wave of one period about the point: the wave itself, weaker
    for (std::size_t m = 0; m < static_cast<std::size_t>(members.n); ++m) {
      const double from_own = turn * (members.at[m] - refinement_ratio * k);
      along += members.weight[m] * std::cos(from_own);
      across += members.weight[m] * std::sin(from_own);
    }
    EXPECT_NEAR(along, (1 + 2 * std::cos(turn)) / 3, 1e-14) << k;
    EXPECT_NEAR(across, 0, 1e-14) << k;
  }
}

TEST(LevelMasks, GrowAcrossPeriodsAndRefineToWholeControlVolumes) {
  CellMask mask({7, 5, {true, false}});
  mask.set(0, 2);
  mask.close_ends();
  EXPECT_TRUE(mask.contains(6, 2)) << "the last point is the first one of the next period";
  mask.grow(1);
  for (const int i : {0, 1, 5, 6}) EXPECT_TRUE(mask.contains(i, 1)) << i;
  EXPECT_FALSE(mask.contains(2, 2));
  EXPECT_FALSE(mask.contains(0, 0));
  const grid::RowSets fine = refined(mask.rows(), 19, 13);
  for (int j = 0; j < 13; ++j) {
    for (int i = 0; i < 19; ++i)
      EXPECT_EQ(fine.contains(i, j), mask.contains(coarse_index(i), coarse_index(j))) << i << ", " << j;
  }
}

/// Every point by chance, and its image in the next period.
CellMask scattered(const LatticeShape& shape) {
  CellMask mask(shape);
  std::uint32_t chance = 1;
  for (int j = 0; j < shape.n2; ++j) {
    for (int i = 0; i < shape.n1; ++i) {
      chance = chance * 1664525U + 1013904223U;
      mask.set(i, j, chance > 0xf4000000U);
    }
  }
  for (int j = 0; shape.periodic[0] && j < shape.n2; ++j) mask.set(shape.n1 - 1, j, mask.contains(0, j));
  for (int i = 0; shape.periodic[1] && i < shape.n1; ++i) mask.set(i, shape.n2 - 1, mask.contains(i, 0));
  return mask;
}

TEST(LevelMasks, GrowByAllPointsWithinReach) {
  for (const std::array<bool, 2> periodic :
       {std::array{false, false}, {true, false}, {false, true}, {true, true}}) {
    for (const int reach : {0, 1, 2, 5, 12}) {
      const CellMask mask = scattered({37, 23, periodic});
      CellMask grown = mask, rest = mask;
      grown.grow(reach);
      rest.remove(grown);
      EXPECT_EQ(rest.rows().points(), 0U) << "what it was grown from is in it";
      for (int j = 0; j < 23; ++j) {
        for (int i = 0; i < 37; ++i) {
          bool near = false;
          for (int b = j - reach; b <= j + reach; ++b) {
            for (int a = i - reach; a <= i + reach; ++a) near = near || mask.contains(a, b);
          }
          ASSERT_EQ(grown.contains(i, j), near) << i << ", " << j << ", reach " << reach;
          ASSERT_EQ(grown.rows().contains(i, j), near);
        }
      }
    }
  }
}

TEST(LevelMasks, FillNarrowGapsOfRows) {
  CellMask mask({12, 2, {}});
  for (const int i : {1, 2, 5, 10}) mask.set(i, 1);
  mask.fill_gaps(2);
  const grid::RowSets rows = mask.rows();
  EXPECT_TRUE(rows.row(0).empty());
  ASSERT_EQ(rows.row(1).size(), 2U);
  EXPECT_EQ(rows.row(1)[0], (grid::Interval{1, 6}));
  EXPECT_EQ(rows.row(1)[1], (grid::Interval{10, 11}));
}

}  // namespace
}  // namespace fsi::fluid
