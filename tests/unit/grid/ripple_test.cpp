// Ripples of the grid's scale are seen, and what flows with shocks may do is not.

#include "common/grid/ripple.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace fsi::grid {
namespace {

constexpr int n1 = 60, n2 = 40;
constexpr double h = 0.05;

/// One grid with two quantities: rho in plane 0, v in planes 1 and 2.
class Ripples : public testing::Test {
 protected:
  using Formula = std::function<double(int i, int j)>;

  Ripples() {
    for (int j = 0; j < n2; ++j) {
      for (int i = 0; i < n1; ++i) {
        x_(0, i, j) = h * i;
        x_(1, i, j) = h * j;
      }
    }
  }
  void set(int plane, const Formula& formula) {
    for (int j = 0; j < n2; ++j) {
      for (int i = 0; i < n1; ++i) q_(plane, i, j) = formula(i, j);
    }
  }
  const Finding& look(double t = 0) {
    const WatchedGrid grids[] = {{.q = q_.view(), .x = x_.view(), .points = &points_}};
    watch_.look(grids, t);
    return watch_.now();
  }

  Field x_{Layout(n1, n2), 2}, q_{Layout(n1, n2), 3};
  RowSets points_ = all_points(n1, n2);
  RippleWatch watch_{{{.components = {"rho"}, .first = 0, .floor = 1e-6},
                      {.components = {"v1", "v2"}, .first = 1, .floor = 1e-6}},
                     {"square"}};
};

double sawtooth(int i) {
  return i % 2 == 0 ? 1 : -1;
}

TEST_F(Ripples, AreFoundWithTheirSizeFieldAndPlace) {
  set(0, [](int i, int j) { return std::sin(0.1 * i) + std::cos(0.1 * j); });
  set(1, [](int i, int) { return 2.0 * i / n1; });
  set(2, [](int i, int j) { return i >= 20 && i < 31 && j == 7 ? 0.1 * sawtooth(i) : 0; });
  const Finding& found = look(1.5);
  EXPECT_NEAR(found.size, 0.1 / (2.0 * (n1 - 1) / n1), 1e-12);  // of the range of both components
  EXPECT_EQ(watch_.component_of(found), "v2");
  EXPECT_EQ(watch_.grid_of(found), "square");
  EXPECT_EQ(found.j, 7);
  EXPECT_GE(found.i, 20);
  EXPECT_LE(found.i, 31);
  EXPECT_EQ(found.place, Vec2(h * found.i, h * 7));
  EXPECT_EQ(found.t, 1.5);
}

// The waves a grid cannot resolve, along rows and along columns, on a slope too.
TEST_F(Ripples, AreFoundAtEveryWavelengthFromTwoToSixPoints) {
  for (const double wavelength : {2.0, 2.3, 2.7, 3.0, 3.4, 3.8, 4.5, 5.0, 5.7}) {
    for (const bool along_columns : {false, true}) {
      set(0, [=](int i, int j) {
        return 1e-3 * (i + j) + std::sin(2 * std::numbers::pi * (along_columns ? j : i) / wavelength + 0.6);
      });
      EXPECT_GT(look().size, 0.12) << wavelength;  // a sample of a wave meets its crests by chance
    }
  }
}

TEST_F(Ripples, OfAWaveTheGridResolvesAreNone) {
  for (const double wavelength : {8.0, 12.0, 20.0}) {
    set(0, [=](int i, int j) { return std::sin(2 * std::numbers::pi * (i + 0.3 * j) / wavelength); });
    EXPECT_EQ(look().size, 0) << wavelength;
  }
}

// Sharp over one point or some, straight or slanted, with over- and undershoot, and two of them side by side.
TEST_F(Ripples, OfShocksKinksAndLonelyPeaksAreNone) {
  const Formula fields[] = {
      [](int i, int) { return i < 30 ? 1.0 : 0.2; },
      [](int i, int j) { return i + j / 3 < 30 ? 1.0 : 0.2; },
      [](int i, int j) { return std::tanh(0.8 * (i - 2 * j)); },
      [](int i, int) {
        return i < 28 ? 1.0 : i == 28 ? 1.2 : i == 29 ? -0.2 : 0.0;
      },
      [](int i, int) { return i < 28   ? 1.0
                              : i < 30 ? 2.5
                                       : 0.3; },
      [](int i, int) { return i == 17 ? 5.0 : 1.0; },
      [](int i, int j) { return std::abs(i - 30) + std::abs(j - 11); },
      [](int i, int) { return i < 30 ? 0.02 * i : i % 7; },
  };
  for (const Formula& field : fields) {
    set(0, field);
    EXPECT_EQ(look().size, 0) << &field - fields;
  }
}

TEST_F(Ripples, OfRoundOffAreNone) {
  set(0, [](int i, int j) { return 1 + 1e-15 * sawtooth(i + j); });
  set(1, [](int i, int) { return 1e-12 * sawtooth(i); });
  EXPECT_EQ(look().size, 0);
}

TEST_F(Ripples, CountAgainstTheLargestRangeSinceTheStart) {
  set(0, [](int i, int) { return std::sin(0.1 * i); });
  EXPECT_EQ(look().size, 0);
  set(0, [](int i, int) { return 1e-4 * sawtooth(i); });
  EXPECT_EQ(look().size, 0);
  set(0, [](int i, int) { return 0.1 * sawtooth(i); });
  EXPECT_NEAR(look().size, 0.05, 1e-3);
}

TEST_F(Ripples, AreNotSoughtAcrossPointsWithoutAValue) {
  points_.clear();
  for (int j = 0; j < n2; ++j) {
    const Interval runs[] = {{.begin = 0, .end = 4}, {.begin = 8, .end = 12}};
    if (j % 5 != 4) points_.append(runs);
    points_.end_row();
  }
  set(0, [](int i, int j) { return sawtooth(i + j); });
  EXPECT_EQ(look().size, 0);
}

TEST_F(Ripples, DoNotStumbleOverValuesThatAreNoNumbers) {
  set(0, [](int i, int j) {
    return i == 5   ? std::numeric_limits<double>::quiet_NaN()
           : j == 3 ? std::numeric_limits<double>::infinity()
                    : 0.2 * sawtooth(i) + i;
  });
  set(1, [](int i, int) { return i > 10 ? 0.1 * sawtooth(i) : 1; });
  EXPECT_NEAR(look().size, 0.1 / 1.1, 1e-12);
}

TEST_F(Ripples, TheWorstIsKeptAndComesBackFromAnArchive) {
  set(1, [](int i, int) { return i > 30 ? 0.2 * sawtooth(i) : i; });
  const double size = look(2).size;
  EXPECT_GT(size, 0);
  set(1, [](int i, int) { return i; });
  EXPECT_EQ(look(3).size, 0);
  EXPECT_EQ(watch_.worst().size, size);
  Archive saved;
  watch_.archive(saved);
  RippleWatch other{{{.components = {"rho"}, .first = 0, .floor = 1e-6},
                     {.components = {"v1", "v2"}, .first = 1, .floor = 1e-6}},
                    {"square"}};
  Archive loaded(saved.entries());
  other.archive(loaded);
  EXPECT_EQ(other.worst().size, size);
  EXPECT_EQ(other.in_words(other.worst()), watch_.in_words(watch_.worst()));
}

}  // namespace
}  // namespace fsi::grid
