/// Pictures show the fields they are made of, and stay small.

#include "common/program/picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "common/core/field.hpp"

namespace fsi {
namespace {

using Place = std::pair<double, double>;

/// A grid of n1 x n2 points on the image of the index square, with fields given at the points.
struct Sheet {
  Sheet(int n1, int n2, const std::function<Place(double, double)>& map) : x(Layout(n1, n2), 2) {
    for (int j = 0; j < n2; ++j) {
      for (int i = 0; i < n1; ++i) std::tie(x(0, i, j), x(1, i, j)) = map(i, j);
    }
  }
  void add(const std::string& name, const std::function<double(double, double)>& value) {
    names.push_back(name);
    Field& field = fields.emplace_back(x.layout(), 1);
    for (int j = 0; j < x.layout().n2; ++j) {
      for (int i = 0; i < x.layout().n1; ++i) field(0, i, j) = value(x(0, i, j), x(1, i, j));
    }
  }
  io::GridOutput output() const {
    io::GridOutput result{.grid = "sheet", .x = x.view(), .u = {}, .fields = {}};
    for (std::size_t k = 0; k < names.size(); ++k) result.fields.push_back({names[k], fields[k].view(), 0});
    return result;
  }
  Field x;
  std::vector<std::string> names;
  std::vector<Field> fields;
};

Place sheared(double i, double j) {
  return {0.1 * i + 0.03 * j, 0.2 * j - 0.02 * i};
}

wire::Picture picture(const io::GridOutput& grid, const std::string& quantity) {
  const auto result = picture_of(std::vector{grid}, quantity);
  EXPECT_TRUE(result.has_value());
  return result.value_or(wire::Picture{});
}

double value(const wire::Picture& p, std::size_t k) {
  const std::uint16_t level = p.grids[0].level.at(k);
  EXPECT_NE(level, wire::Picture::no_value);
  return p.low + (level - 1.0) / 65534.0 * (p.high - p.low);
}

/// Half the distance of two levels.
double resolution(const wire::Picture& p) {
  return (p.high - p.low) / 65534.0 * 0.5001;
}

std::size_t bytes(const wire::Picture& p) {
  std::size_t sum = 0;
  for (const auto& grid : p.grids) sum += sizeof(float) * grid.x.size() + 2 * grid.level.size();
  return sum;
}

TEST(Picture, OfASmallGridHasEveryPointAndItsValue) {
  Sheet sheet(7, 5, sheared);
  sheet.add("p", [](double x, double y) { return 3 + 2 * x - 5 * y; });
  const wire::Picture p = picture(sheet.output(), "pressure");
  const auto& grid = p.grids.at(0);
  ASSERT_EQ(std::pair(grid.n1, grid.n2), std::pair(7U, 5U));
  EXPECT_FALSE(grid.straight);
  for (std::size_t k = 0; k < 35; ++k) {
    const double x = grid.x.at(k), y = grid.x.at(35 + k);
    EXPECT_NEAR(value(p, k), 3 + 2 * x - 5 * y, resolution(p) + 1e-6) << k;
  }
}

TEST(Picture, OfStraightLinesHasOnlyTheirPlaces) {
  Sheet sheet(4, 3, [](double i, double j) { return Place{i * i, 10 + j}; });
  sheet.add("p", [](double x, double) { return x; });
  const wire::Picture p = picture(sheet.output(), "pressure");
  EXPECT_TRUE(p.grids.at(0).straight);
  EXPECT_EQ(p.grids[0].x, (std::vector<float>{0, 1, 4, 9, 10, 11, 12}));
  EXPECT_EQ(p.low, 0);
  EXPECT_EQ(p.high, 9);
}

TEST(Picture, OfALargeGridStaysSmallAndReachesItsEnds) {
  for (const auto& [n1, n2] : {std::pair(1000, 700), std::pair(3000, 9), std::pair(257, 2)}) {
    Sheet sheet(n1, n2, sheared);
    sheet.add("rho", [](double x, double y) { return x + y; });
    const wire::Picture p = picture(sheet.output(), "density");
    const auto& grid = p.grids.at(0);
    EXPECT_LE(bytes(p), largest_picture);
    EXPECT_LE(grid.n1, wire::Picture::most_samples);
    EXPECT_LE(grid.n2, wire::Picture::most_samples);
    EXPECT_GT(bytes(p), largest_picture / 64);  // it is not thrown away either
    const std::size_t samples = grid.level.size();
    EXPECT_FLOAT_EQ(grid.x.at(samples - 1), static_cast<float>(sheared(n1 - 1, n2 - 1).first));
    EXPECT_FLOAT_EQ(grid.x.at(2 * samples - 1), static_cast<float>(sheared(n1 - 1, n2 - 1).second));
    EXPECT_FLOAT_EQ(grid.x.at(0), 0);
  }
}

TEST(Picture, OfManyGridsStaysSmall) {
  Sheet sheet(60, 12, sheared);
  sheet.add("p", [](double x, double y) { return x * y; });
  const std::vector<io::GridOutput> grids(300, sheet.output());
  const auto p = picture_of(grids, "pressure");
  ASSERT_TRUE(p.has_value());
  EXPECT_EQ(p->grids.size(), 300U);
  EXPECT_LE(bytes(*p), largest_picture);
}

TEST(Picture, OfSchlierenIsTheSizeOfTheGradientOnAnyGridAndAtItsEdges) {
  Sheet sheet(9, 8, sheared);
  sheet.add("rho", [](double x, double y) { return 3 * x + 4 * y; });
  const wire::Picture p = picture(sheet.output(), "schlieren");
  EXPECT_NEAR(p.low, 5, 1e-11);
  EXPECT_NEAR(p.high, 5, 1e-11);
}

TEST(Picture, OfSchlierenMissesNoShockBetweenItsSamples) {
  for (int shock = 3; shock < 600; shock += 85) {
    Sheet sheet(600, 550, sheared);
    sheet.add("rho", [&](double x, double y) { return x - 0.15 * y > 0.103 * shock ? 2 : 1; });
    const wire::Picture p = picture(sheet.output(), "schlieren");
    EXPECT_GT(p.high, 1) << shock;
  }
}

TEST(Picture, OfSpeedAndStressAreRootsOfSumsOfSquares) {
  Sheet sheet(3, 3, sheared);
  const std::vector<std::pair<const char*, double>> parts{{"v1", -3},  {"v2", 4},  {"P11", 1},
                                                          {"P12", -2}, {"P21", 4}, {"P22", 10}};
  for (const auto& [name, number] : parts)
    sheet.add(name, [value = number](double, double) { return value; });
  EXPECT_DOUBLE_EQ(picture(sheet.output(), "speed").high, 5);
  EXPECT_DOUBLE_EQ(picture(sheet.output(), "stress").high, 11);
}

TEST(Picture, OfWhatAProgramLacksIsNone) {
  Sheet sheet(3, 3, sheared);
  sheet.add("v1", [](double, double) { return 0; });
  for (const char* quantity : {"pressure", "speed", "stress", "nonsense", ""})
    EXPECT_FALSE(picture_of(std::vector{sheet.output()}, quantity).has_value()) << quantity;
  EXPECT_FALSE(picture_of({}, "pressure").has_value());
}

TEST(Picture, LeavesUnusedPointsAndBrokenNumbersOut) {
  Sheet sheet(4, 3, sheared);
  sheet.add("p", [](double x, double) { return x; });
  sheet.fields[0](0, 3, 2) = std::numeric_limits<double>::quiet_NaN();
  sheet.fields[0](0, 0, 0) = 1e30;  // never written: unused
  io::GridOutput output = sheet.output();
  output.kinds.assign(12, 1);
  output.kinds[0] = 0;
  const wire::Picture p = picture(output, "pressure");
  EXPECT_EQ(p.grids.at(0).level.at(0), wire::Picture::no_value);
  EXPECT_EQ(p.grids[0].level.at(11), wire::Picture::no_value);
  EXPECT_NE(p.grids[0].level.at(1), wire::Picture::no_value);
  EXPECT_LT(p.high, 1);
}

TEST(Picture, OfASolidLiesWhereItHasMoved) {
  Sheet sheet(3, 2, sheared);
  sheet.add("v1", [](double, double) { return 1; });
  sheet.add("v2", [](double, double) { return 1; });
  Field u(Layout(3, 2), 2);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 3; ++i) u(0, i, j) = 100, u(1, i, j) = -200;
  }
  io::GridOutput output = sheet.output();
  output.u = u.view();
  const auto grid = picture(output, "speed").grids.at(0);
  for (int k = 0; k < 6; ++k) {
    const auto [x, y] = sheared(k % 3, k / 3);  // NOLINT(bugprone-integer-division)
    EXPECT_FLOAT_EQ(grid.x.at(static_cast<std::size_t>(k)), static_cast<float>(x + 100));
    EXPECT_FLOAT_EQ(grid.x.at(static_cast<std::size_t>(6 + k)), static_cast<float>(y - 200));
  }
}

}  // namespace
}  // namespace fsi
