#include "common/grid/overlap/composite_grid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "common/core/failure.hpp"
#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/shapes/circle.hpp"
#include "tests/unit/grid/overlap_checks.hpp"
#include "tests/unit/grid/shapes_of_cases.hpp"

namespace fsi::grid {
namespace {

using std::numbers::pi;

/// A body-fitted grid with its description.
struct Strip {
  HyperbolicGrid description;
  Field x;

  BodyFittedGrid body() const {
    return {.name = description.name,
            .n1 = description.points,
            .n2 = description.lines,
            .curve = description.curve,
            .ends = description.ends};
  }
  int curve_line() const { return description.curve == Side::bottom ? 0 : description.lines - 1; }
};

Strip strip(const PlaneCurve& shape, const HyperbolicGrid& description) {
  Strip result{description, Field(Layout(description.points, description.lines), 2)};
  HyperbolicMarch(description).march(points_on(shape, description.points), result.x.view(), 0);
  return result;
}

CartesianGrid box(double x_a, double x_b, double y_a, double y_b, double h) {
  return {.n1 = static_cast<int>(std::lround((x_b - x_a) / h)) + 1,
          .n2 = static_cast<int>(std::lround((y_b - y_a) / h)) + 1,
          .x_a = x_a,
          .x_b = x_b,
          .y_a = y_a,
          .y_b = y_b};
}

int points_for(const PlaneCurve& shape, double h) {
  return static_cast<int>(length_of(shape) / h) + 1;
}

/// Gas around the disk (outward) or the disk itself (inward) at h.
Strip annulus(double h, int lines, bool gas) {
  const PlaneCurve shape = circle({0, 0}, 1);
  return strip(shape, {.name = gas ? "annulus" : "rim",
                       .points = points_for(shape, h),
                       .lines = lines,
                       .curve = gas ? Side::top : Side::bottom,
                       .spacing = h});
}

Strip beam_strip(double h, int lines, bool gas) {
  return strip(beam_outline(), {.name = "beam",
                                .points = points_for(beam_outline(), h),
                                .lines = lines,
                                .curve = gas ? Side::bottom : Side::top,
                                .ends = Curve::open,
                                .spacing = gas ? h : std::min(h, 0.015 / (lines - 1)),
                                .walls = {Vec2(1, 0), Vec2(1, 0)}});
}

/// The beam's region: its outline closed below the wall.
Region beam_region(const Strip& beam, bool outside) {
  std::vector<Vec2> corners = region_of(beam.x.view(), beam.curve_line()).corners;
  corners.emplace_back(0.05, 0);
  corners.emplace_back(0.05, -1);
  corners.emplace_back(-0.05, -1);
  return {std::move(corners), outside};
}

OverlapCounts connect_and_check(const CartesianGrid& background, const Strip& grid, const Region& region) {
  CompositeGrid grids(background, {grid.body()});
  const ConstFieldView x[] = {grid.x.view()};
  grids.connect(x, 0);
  OverlapChecker(grids, {region}).check(x);
  return grids.counts();
}

TEST(CompositeGrid, DiskGasAndSolidConnectExplicitlyWithQuadraticInterpolation) {
  for (const int j : {2, 4, 8}) {
    const double h = 1.0 / (10 * j);
    for (const bool gas : {true, false}) {
      const Strip grid = annulus(h, 8, gas);
      const double half = gas ? 2 : 1;
      const auto counts = connect_and_check(box(-half, half, -half, half, h), grid,
                                            region_of(grid.x.view(), grid.curve_line(), !gas));
      EXPECT_EQ(counts.width_2, 0U) << j << gas;
      EXPECT_EQ(counts.implicit, 0U) << j << gas;
      EXPECT_GT(counts.interpolated, 2 * 2 * pi / h);
    }
  }
}

TEST(CompositeGrid, DiskConnectsAtEveryResolution) {
  for (int factor = 2; factor <= 16; ++factor) {
    const double h = 0.1 / factor;
    const Strip ring = annulus(h, 8, true);
    CompositeGrid grids(box(-2, 2, -2, 2, h), {ring.body()});
    grids.connect(std::array{ring.x.view()}, 0);
    const std::size_t unused = grids.layout(0).points() - grids.valid(0).points();
    EXPECT_NEAR(static_cast<double>(unused) * h * h, pi, 4 * pi * h);
  }
}

TEST(CompositeGrid, EllipseConnectsInGasAndSolid) {
  for (const int j : {4, 8}) {
    const double h = 1.0 / (10 * j);
    const int around = static_cast<int>(2 * pi * 0.875 / h) + 1;
    for (const bool gas : {true, false}) {
      const Strip grid = strip(tilted_ellipse(), {.name = "ellipse",
                                                  .points = around,
                                                  .lines = 8,
                                                  .curve = gas ? Side::top : Side::bottom,
                                                  .spacing = h});
      const auto background = gas ? box(-4, 5, -4, 4, h) : box(-2.75, 0.75, -1.75, 1.75, h);
      const auto counts =
          connect_and_check(background, grid, region_of(grid.x.view(), grid.curve_line(), !gas));
      EXPECT_EQ(counts.width_2, 0U) << j << gas;
    }
  }
}

TEST(CompositeGrid, BeamConnectsInGasAndSolidWithBothEndsOnTheWall) {
  const double h = 1.0 / 160;
  const Strip gas = beam_strip(h, 9, true), solid = beam_strip(h / 1.2, 10, false);
  // A background shifted a little, so that no point lies on the curve but for round-off.
  const auto counts = connect_and_check(box(-1.0003, 1.9997, 0, 1.5, h), gas, beam_region(gas, false));
  EXPECT_EQ(counts.width_2, 0U);
  connect_and_check(box(-0.06, 0.06, 0, 1.02, h / 2.4), solid, beam_region(solid, true));
}

TEST(CompositeGrid, PointsOnAStraightCurveBelongToTheDomainAllTheSame) {
  for (const int j : {16, 32}) {
    const double h = 1.0 / (10 * j);
    const Strip gas = beam_strip(h, 9, true);
    CompositeGrid grids(box(-1, 2, 0, 1.5, h), {gas.body()});
    const ConstFieldView x[] = {gas.x.view()};
    grids.connect(x, 0);
    const int on_curve = static_cast<int>(std::lround(0.95 / h));
    for (int row = 0; row < static_cast<int>(0.8 / h); ++row) {
      EXPECT_EQ(grids.kind(0, on_curve, row), PointKind::interpolated);
      EXPECT_EQ(grids.kind(0, on_curve - 1, row), PointKind::interpolated);
      EXPECT_EQ(grids.kind(0, on_curve - 2, row), PointKind::discretised);
      EXPECT_EQ(grids.kind(0, on_curve + 1, row), PointKind::unused);
    }
    EXPECT_EQ(grids.counts().width_2, 0U);
  }
}

TEST(CompositeGrid, StarConnects) {
  const double h = 0.0125;
  for (const bool gas : {true, false}) {
    const Strip grid = strip(star(), {.name = "star",
                                      .points = points_for(star(), h),
                                      .lines = 9,
                                      .curve = gas ? Side::top : Side::bottom,
                                      .spacing = h});
    connect_and_check(box(-2, 2, -2, 2, h), grid, region_of(grid.x.view(), grid.curve_line(), !gas));
  }
}

TEST(CompositeGrid, TwoBodiesShareABackground) {
  const double h = 0.025;
  const PlaneCurve first = circle({-0.2503, -1.0004}, 1), second = circle({0.5001, 1.2507}, 0.8);
  const Strip a = strip(
      first,
      {.name = "cylinder_1", .points = points_for(first, h), .lines = 8, .curve = Side::top, .spacing = h});
  const Strip b = strip(
      second,
      {.name = "cylinder_2", .points = points_for(second, h), .lines = 8, .curve = Side::top, .spacing = h});
  CompositeGrid grids(box(-3, 3, -3, 3, h), {a.body(), b.body()});
  const ConstFieldView x[] = {a.x.view(), b.x.view()};
  grids.connect(x, 0);
  OverlapChecker(grids, {region_of(a.x.view(), 7), region_of(b.x.view(), 7)}).check(x);
  EXPECT_EQ(grids.counts().width_2, 0U);
}

TEST(CompositeGrid, GridsOfTwoCloseBodiesCutAndFeedEachOther) {
  const double h = 0.025;
  // The gap of 0.2 is crossed by both grids, 0.25 deep: each is cut by the other's curve.
  const PlaneCurve first = circle({-0.6, 0.013}, 0.5), second = circle({0.6, -0.021}, 0.5);
  const Strip a = strip(
      first, {.name = "a", .points = points_for(first, h), .lines = 11, .curve = Side::top, .spacing = h});
  const Strip b = strip(
      second, {.name = "b", .points = points_for(second, h), .lines = 11, .curve = Side::top, .spacing = h});
  CompositeGrid grids(box(-2, 2, -2, 2, h), {a.body(), b.body()});
  const ConstFieldView x[] = {a.x.view(), b.x.view()};
  grids.connect(x, 0);
  OverlapChecker(grids, {region_of(a.x.view(), 10), region_of(b.x.view(), 10)}).check(x);
  bool some_cut = false;
  for (int i = 0; i < a.description.points; ++i)
    some_cut = some_cut || grids.kind(1, i, 0) == PointKind::unused;
  EXPECT_TRUE(some_cut);
}

TEST(CompositeGrid, GasBetweenADiskAndACircularWall) {
  const double h = 0.05;
  const Strip disk = annulus(h, 8, true);
  const PlaneCurve wall = circle({0, 0}, 2);
  const Strip rim = strip(
      wall, {.name = "wall", .points = points_for(wall, h), .lines = 8, .curve = Side::bottom, .spacing = h});
  CompositeGrid grids(box(-2, 2, -2, 2, h), {disk.body(), rim.body()});
  const ConstFieldView x[] = {disk.x.view(), rim.x.view()};
  grids.connect(x, 0);
  OverlapChecker(grids, {region_of(disk.x.view(), 7), region_of(rim.x.view(), 0, true)}).check(x);
}

TEST(CompositeGrid, StraightInterfaceFromWallToWallInAnyDirection) {
  const double h = 0.05;
  // A piston's interface: the gas lies to the right of (upward) and below (rightward) the curve.
  for (const bool upright : {true, false}) {
    std::vector<double> curve(42, 0.2513);
    for (std::size_t k = 0; k < 21; ++k) curve[(upright ? 21 : 0) + k] = h * static_cast<double>(k);
    const Vec2 wall = upright ? Vec2(1, 0) : Vec2(0, 1);
    HyperbolicGrid description{.name = "front",
                               .points = 21,
                               .lines = 10,
                               .curve = Side::top,
                               .ends = Curve::open,
                               .spacing = h,
                               .walls = {wall, wall}};
    Strip grid{description, Field(Layout(21, 10), 2)};
    HyperbolicMarch(description).march(curve, grid.x.view(), 0);
    const auto background = upright ? box(-0.75, 1.5, 0, 1, h) : box(0, 1, -0.75, 1.5, h);
    const Region behind = upright ? Region{{{0.2513, -1}, {0.2513, 2}, {-2, 2}, {-2, -1}}, false}
                                  : Region{{{-1, 0.2513}, {2, 0.2513}, {2, 3}, {-1, 3}}, false};
    const auto counts = connect_and_check(background, grid, behind);
    EXPECT_EQ(counts.width_2, 0U);
  }
}

TEST(CompositeGrid, SixLinesFallBackAndSayHowOften) {
  const double h = 0.05;
  const Strip grid = annulus(h, 6, true);
  const auto counts = connect_and_check(box(-2, 2, -2, 2, h), grid, region_of(grid.x.view(), 5));
  EXPECT_GT(counts.width_2 + counts.implicit, 0U);
}

TEST(CompositeGrid, FiveThinLinesLeaveANamedOrphan) {
  const double h = 0.05;
  Strip grid = annulus(h, 5, true);
  grid.description.spacing = 0.02;
  HyperbolicMarch(grid.description)
      .march(points_on(circle({0, 0}, 1), grid.description.points), grid.x.view(), 0);
  CompositeGrid grids(box(-2, 2, -2, 2, h), {grid.body()});
  const ConstFieldView x[] = {grid.x.view()};
  try {
    grids.connect(x, 0.25);
    FAIL() << "points without donors went unnoticed";
  } catch (const Diverged& broke) {
    const std::string words = broke.what();
    EXPECT_NE(words.find("t = 0.25, grid \"background\", point ("), std::string::npos) << words;
    EXPECT_NE(words.find("without a donor"), std::string::npos) << words;
  }
}

TEST(CompositeGrid, TrimmingLeavesOutLinesThatNobodyNeeds) {
  const double h = 0.05;
  const Strip grid = annulus(h, 15, true);
  CompositeGrid grids(box(-2, 2, -2, 2, h), {grid.body()}, {.trim = true});
  const ConstFieldView x[] = {grid.x.view()};
  grids.connect(x, 0);
  EXPECT_EQ(grids.kind(1, 0, 0), PointKind::unused);
  EXPECT_EQ(grids.kind(1, 0, 14), PointKind::discretised);
  EXPECT_LE(grids.valid(1).points(), static_cast<std::size_t>(8 * grid.description.points));
  EXPECT_EQ(grids.counts().width_2 + grids.counts().implicit, 0U);
}

/// Fields on all grids with the values of a function of position, NaN where there is no value.
std::vector<Field> fields_with(const CompositeGrid& grids, std::span<const ConstFieldView> x,
                               const std::function<double(const Vec2&)>& f, PointKind least) {
  std::vector<Field> fields;
  for (int g = 0; g < grids.grids(); ++g) {
    fields.emplace_back(grids.layout(g), 2);
    for (int j = 0; j < grids.layout(g).n2; ++j) {
      for (int i = 0; i < grids.layout(g).n1; ++i) {
        const Vec2 p = g == 0 ? grids.background().point(i, j)
                              : Vec2(x[static_cast<std::size_t>(g) - 1](0, i, j),
                                     x[static_cast<std::size_t>(g) - 1](1, i, j));
        const bool has = grids.kind(g, i, j) >= least;
        fields.back()(0, i, j) = has ? f(p) : std::nan("");
        fields.back()(1, i, j) = has ? 2 * f(p) : std::nan("");
      }
    }
  }
  return fields;
}

/// Largest error of interpolated values of f on the disk's gas grids.
double interpolation_error(double h, const std::function<double(const Vec2&)>& f) {
  const Strip grid = annulus(h, 8, true);
  CompositeGrid grids(box(-2, 2, -2, 2, h), {grid.body()});
  const ConstFieldView x[] = {grid.x.view()};
  grids.connect(x, 0);
  auto fields = fields_with(grids, x, f, PointKind::discretised);
  std::vector<FieldView> views;
  for (Field& field : fields) views.push_back(field.view());
  grids.interpolate(views);
  const auto exact = fields_with(grids, x, f, PointKind::interpolated);
  double worst = 0;
  for (int g = 0; g < 2; ++g) {
    for (int j = 0; j < grids.layout(g).n2; ++j) {
      for (const Interval& run : grids.valid(g).row(j)) {
        for (int i = run.begin; i < run.end; ++i) {
          const auto k = static_cast<std::size_t>(g);
          const double error = std::abs(fields[k](0, i, j) - exact[k](0, i, j));
          EXPECT_TRUE(std::isfinite(error));
          EXPECT_EQ(fields[k](1, i, j), 2 * fields[k](0, i, j));
          worst = std::max(worst, error);
        }
      }
    }
  }
  return worst;
}

TEST(CompositeGrid, InterpolatesLinearFunctionsOfPositionExactly) {
  EXPECT_LT(interpolation_error(0.05, [](const Vec2& x) { return 1 + 2 * x[0] - 3 * x[1]; }), 2e-14);
}

TEST(CompositeGrid, InterpolatesSmoothFunctionsWithThirdOrder) {
  const auto f = [](const Vec2& x) { return std::sin(2 * x[0] + 0.3) * std::cos(3 * x[1]); };
  const double coarse = interpolation_error(0.05, f), fine = interpolation_error(0.025, f),
               finest = interpolation_error(0.0125, f);
  EXPECT_GT(std::log2(coarse / fine), 2.6);
  EXPECT_GT(std::log2(fine / finest), 2.8);
  EXPECT_LT(finest, 2e-6 * 27);
}

TEST(CompositeGrid, InterpolatesQuadraticsOfTheDonorsCoordinatesExactly) {
  const double h = 0.05;
  const Strip grid = annulus(h, 8, true);
  CompositeGrid grids(box(-2, 2, -2, 2, h), {grid.body()});
  const ConstFieldView x[] = {grid.x.view()};
  grids.connect(x, 0);
  const auto quadratic = [](double a, double b) {
    return 1 + a - 2 * b + 0.5 * a * a + a * b - 0.25 * b * b + 0.1 * a * a * b * b;
  };
  Field background(grids.layout(0), 1), ring(grids.layout(1), 1);
  for (int j = 0; j < grids.layout(0).n2; ++j) {
    for (int i = 0; i < grids.layout(0).n1; ++i)
      background(0, i, j) = quadratic(grids.background().x(i), grids.background().y(j));
  }
  FieldView fields[] = {background.view(), ring.view()};
  grids.interpolate(fields);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < grids.layout(1).n1; ++i) {
      EXPECT_NEAR(ring(0, i, j), quadratic(grid.x(0, i, j), grid.x(1, i, j)),
                  2e-14);  // round-off of values up to 5
    }
  }
}

TEST(CompositeGrid, ImplicitPointsSettleToTheirCommonSolution) {
  const double h = 0.05;
  const Strip grid = annulus(h, 6, true);
  CompositeGrid grids(box(-2, 2, -2, 2, h), {grid.body()});
  const ConstFieldView x[] = {grid.x.view()};
  grids.connect(x, 0);
  ASSERT_GT(grids.counts().implicit, 0U);
  const auto linear = [](const Vec2& p) { return 1 + 2 * p[0] - 3 * p[1]; };
  auto fields = fields_with(grids, x, linear, PointKind::interpolated);
  for (const InterpolationList& list : grids.interpolation()) {
    for (const std::int32_t at : list.target)
      fields[static_cast<std::size_t>(list.target_grid)].view().plane(0)[at] = 7;
  }
  std::vector<FieldView> views;
  for (Field& field : fields) views.push_back(field.view());
  grids.interpolate(views);
  const auto exact = fields_with(grids, x, linear, PointKind::interpolated);
  for (const InterpolationList& list : grids.interpolation()) {
    const auto g = static_cast<std::size_t>(list.target_grid);
    for (const std::int32_t at : list.target)
      EXPECT_NEAR(fields[g].view().plane(0)[at], exact[g].view().plane(0)[at], 1e-11);
  }
}

TEST(CompositeGrid, MistakesAreTheUsers) {
  EXPECT_THROW(CompositeGrid(box(0, 1, 0, 1, 0.5), {}), UserMistake);
  EXPECT_THROW(CompositeGrid(box(0, 1, 0, 1, 0.1), {{.name = "thin", .n1 = 20, .n2 = 4}}), UserMistake);
  EXPECT_THROW(
      CompositeGrid(box(0, 1, 0, 1, 0.1), {{.name = "side", .n1 = 20, .n2 = 8, .curve = Side::left}}),
      UserMistake);
}

}  // namespace
}  // namespace fsi::grid
