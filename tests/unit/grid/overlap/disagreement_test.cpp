// Two grids that compute the same place agree upon it, or are found out.

#include "common/grid/overlap/disagreement.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <utility>

namespace fsi::grid {
namespace {

/// A background of 21 x 11 points, and a strip over it, slanted and half as wide; rho in plane 0, v in 1 and 2.
class Disagreements : public testing::Test {
 protected:
  using Formula = std::function<double(double x, double y)>;

  Disagreements() {
    for (int j = 0; j < 11; ++j) {
      for (int i = 0; i < 21; ++i) {
        x_(0, i, j) = background_.x(i);
        x_(1, i, j) = background_.y(j);
      }
    }
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 15; ++i) {
        strip_x_(0, i, j) = -0.63 + 0.081 * i + 0.03 * j;
        strip_x_(1, i, j) = -0.24 + 0.07 * j;
      }
    }
  }
  void set(int plane, const Formula& background, const Formula& strip) {
    for (int j = 0; j < 11; ++j)
      for (int i = 0; i < 21; ++i) q_(plane, i, j) = background(x_(0, i, j), x_(1, i, j));
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 15; ++i) strip_q_(plane, i, j) = strip(strip_x_(0, i, j), strip_x_(1, i, j));
  }
  const Finding& look(double t = 0) {
    const WatchedGrid grids[] = {{.q = q_.view(), .x = x_.view(), .points = &points_},
                                 {.q = strip_q_.view(), .x = strip_x_.view(), .points = &strip_points_}};
    watch_.look(background_, grids, ranges_, t);
    return watch_.now();
  }

  CartesianGrid background_{
      .name = "background", .n1 = 21, .n2 = 11, .x_a = -1, .x_b = 1, .y_a = -0.5, .y_b = 0.5};
  Field x_{Layout(21, 11), 2}, q_{Layout(21, 11), 3}, strip_x_{Layout(15, 6), 2}, strip_q_{Layout(15, 6), 3};
  RowSets points_ = all_points(21, 11), strip_points_ = all_points(15, 6);
  std::array<double, 2> ranges_{2, 5};
  DisagreementWatch watch_{{{.components = {"rho"}, .first = 0, .floor = 1e-6},
                            {.components = {"v1", "v2"}, .first = 1, .floor = 1e-6}},
                           {"background", "strip"}};
};

double bilinear(double x, double y) {
  return 1 + 2 * x - 3 * y;
}

TEST_F(Disagreements, OfOneSolutionAreNone) {
  for (const int plane : {0, 1, 2}) set(plane, bilinear, bilinear);
  EXPECT_LT(look().size, 1e-14);
}

TEST_F(Disagreements, AreFoundWithTheirSizeFieldGridAndPlace) {
  for (const int plane : {0, 1, 2}) set(plane, bilinear, bilinear);
  strip_q_(0, 3, 4) += 0.1;
  strip_q_(2, 9, 1) -= 0.75;
  const Finding found = look(1.5);
  EXPECT_NEAR(found.size, 0.75 / 5, 1e-14);  // more than 0.1 / 2
  EXPECT_EQ(watch_.component_of(found), "v2");
  EXPECT_EQ(watch_.grid_of(found), "strip");
  EXPECT_EQ(found.i, 9);
  EXPECT_EQ(found.j, 1);
  EXPECT_EQ(found.place, Vec2(strip_x_(0, 9, 1), strip_x_(1, 9, 1)));
  EXPECT_EQ(
      watch_.in_words(found),
      "v2 differs by 15 % of its range between grid \"strip\", point (9, 1) at (0.129, -0.17), and grid "
      "\"background\", t = 1.5");
  strip_q_(2, 9, 1) += 0.75;
  EXPECT_NEAR(look(2).size, 0.05, 1e-14);
  EXPECT_EQ(watch_.worst().t, 1.5);
}

// Around the strip's point (7, 2) the background has a hole, or interpolates: nothing to compare with.
TEST_F(Disagreements, AreLookedForOnlyWhereBothAreAdvanced) {
  for (const int plane : {0, 1, 2}) set(plane, bilinear, bilinear);
  strip_q_(1, 7, 2) += 1;
  strip_points_.clear();
  for (int j = 0; j < 6; ++j) {
    if (j != 2) strip_points_.append({0, 15});
    strip_points_.end_row();
  }
  EXPECT_LT(look().size, 1e-14);
  strip_points_ = all_points(15, 6);
  EXPECT_NEAR(look().size, 0.2, 1e-14);
  const int i = static_cast<int>((strip_x_(0, 7, 2) + 1) / background_.dx()),
            j = static_cast<int>((strip_x_(1, 7, 2) + 0.5) / background_.dy());
  for (const auto& [hole_i, hole_j] : {std::pair(i, j), {i + 1, j}, {i, j + 1}, {i + 1, j + 1}}) {
    points_.clear();
    for (int row = 0; row < 11; ++row) {
      if (row != hole_j) {
        points_.append({0, 21});
      } else {
        points_.append({0, hole_i});
        points_.append({hole_i + 1, 21});
      }
      points_.end_row();
    }
    EXPECT_LT(look().size, 1e-14) << hole_i << " " << hole_j;
  }
}

// Where one sees a shock as a jump, the other one as a slope.
TEST_F(Disagreements, OfGridsOfWhichOneIsMuchFinerAreNone) {
  for (const auto& [along, away] : {std::pair(0.4, 1.0), {1.0, 0.4}, {4.0, 1.0}, {1.0, 5.0}, {1.0, 1.0}}) {
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 15; ++i) {
        strip_x_(0, i, j) = 0.081 * along * (i - 7) + 0.01;
        strip_x_(1, i, j) = 0.07 * away * (j - 3) + 0.02;
      }
    }
    for (const int plane : {0, 1, 2}) set(plane, bilinear, bilinear);
    strip_q_(0, 7, 3) += 1;
    EXPECT_NEAR(look().size, along == away ? 0.5 : 0, 1e-14) << along << " " << away;
  }
}

TEST_F(Disagreements, OutsideTheBackgroundAreNone) {
  for (const int plane : {0, 1, 2}) set(plane, bilinear, bilinear);
  for (int i = 0; i < 15; ++i) strip_x_(0, i, 5) += 1.5;
  strip_q_(0, 14, 5) += 1;
  strip_q_(0, 13, 5) = bilinear(strip_x_(0, 13, 5), strip_x_(1, 13, 5));
  strip_points_.clear();
  for (int j = 0; j < 6; ++j) {
    strip_points_.append(j < 5 ? Interval{0, 15} : Interval{14, 15});
    strip_points_.end_row();
  }
  EXPECT_LT(look().size, 1e-14);
}

}  // namespace
}  // namespace fsi::grid
