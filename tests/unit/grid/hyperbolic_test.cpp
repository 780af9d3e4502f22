#include "common/grid/marching/hyperbolic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "common/grid/geometry/quality.hpp"
#include "common/grid/marching/ghost_points.hpp"
#include "common/grid/marching/line_solver.hpp"
#include "common/grid/shapes/circle.hpp"
#include "common/grid/shapes/rounded_polygon.hpp"
#include "tests/unit/grid/marched.hpp"
#include "tests/unit/grid/shapes_of_cases.hpp"

namespace fsi::grid {
namespace {

using std::numbers::pi;

HyperbolicGrid beam_grid(int points, int lines, Side side, double spacing) {
  return {.name = "beam",
          .points = points,
          .lines = lines,
          .curve = side,
          .ends = Curve::open,
          .spacing = spacing,
          .walls = {Vec2(1, 0), Vec2(1, 0)}};
}

/// Largest distance of the points of an annulus of the given radii from the polar grid, parts of the width.
double polar_error(int points, int lines, Side side, double depth) {
  const double spacing = depth / (lines - 1), outward = side == Side::top ? 1 : -1;
  const Marched grid =
      march(circle({0, 0}, 1), {.points = points, .lines = lines, .curve = side, .spacing = spacing});
  double worst = 0;
  for (int m = 0; m < lines; ++m) {
    const int j = side == Side::bottom ? m : lines - 1 - m;
    for (int i = 0; i < points; ++i) {
      const double r = 1 + outward * m * spacing, angle = 2 * pi * i / (points - 1);
      worst = std::max(
          worst, std::hypot(grid.x(0, i, j) - r * std::cos(angle), grid.x(1, i, j) - r * std::sin(angle)));
    }
  }
  return worst / depth;
}

TEST(LineSolver, SolvesOpenAndClosedLines) {
  constexpr std::size_t n = 7;
  for (const bool closed : {false, true}) {
    LineSolver solver(n);
    std::vector<LineRow> rows(n);
    for (std::size_t k = 0; k < n; ++k) {
      const double a = std::sin(3.0 * static_cast<double>(k));
      rows[k].diagonal << 2, a, 0.1, 3;
      rows[k].below << 0.3, 0.1 * a, -0.2, 0.5;
      rows[k].above << -0.4, 0.2, 0.3 * a, 0.1;
      rows[k].right << a, 1;
    }
    std::ranges::copy(rows, solver.rows().begin());
    const auto x = closed ? solver.solve_closed() : solver.solve_open();
    for (std::size_t k = 0; k < n; ++k) {
      Vec2 miss = rows[k].diagonal * x[k] - rows[k].right;
      if (closed || k > 0) miss += rows[k].below * x[(k + n - 1) % n];
      if (closed || k + 1 < n) miss += rows[k].above * x[(k + 1) % n];
      EXPECT_LT(miss.norm(), 1e-15 * 10);  // a few roundings of numbers of order one
    }
  }
}

TEST(HyperbolicMarch, CircleGivesAPolarGridInTheLimit) {
  for (const Side side : {Side::top, Side::bottom}) {
    const double coarse = polar_error(65, 6, side, 0.25), fine = polar_error(257, 21, side, 0.25);
    // The smoothing pulls towards the centre by eps times spacing per line: first order.
    EXPECT_LT(coarse, 0.02);
    EXPECT_LT(fine, coarse / 3.5);
  }
}

TEST(HyperbolicMarch, CircleWithoutSmoothingIsThePolarGrid) {
  const Marched grid = march(circle({0, 0}, 1),
                             {.points = 65, .lines = 6, .curve = Side::top, .spacing = 0.05, .smoothing = 0});
  for (int i = 0; i < 65; ++i) EXPECT_NEAR(std::hypot(grid.x(0, i, 0), grid.x(1, i, 0)), 1.25, 1e-13);
}

TEST(HyperbolicMarch, StartCurveIsTheCurveToTheBitOnEitherSide) {
  const Marched outside = march(star(), {.points = 201, .lines = 6, .curve = Side::top, .spacing = 0.02});
  const Marched inside = march(star(), {.points = 201, .lines = 6, .curve = Side::bottom, .spacing = 0.02});
  for (int i = 0; i < 201; ++i) {
    for (int c = 0; c < 2; ++c) {
      EXPECT_EQ(outside.x(c, i, 5), outside.curve[static_cast<std::size_t>(201 * c + i)]);
      EXPECT_EQ(inside.x(c, i, 0), outside.x(c, i, 5));
    }
  }
}

TEST(HyperbolicMarch, ClosedGridsArePeriodicToTheBitGhostsIncluded) {
  const Marched grid = march(star(), {.points = 201, .lines = 6, .curve = Side::top, .spacing = 0.02});
  for (int j = -2; j < 8; ++j) {
    for (int c = 0; c < 2; ++c) {
      for (int m = -2; m <= 2; ++m)
        EXPECT_EQ(grid.x(c, m < 0 ? m : 200 + m, j), grid.x(c, m < 0 ? 200 + m : m, j));
    }
  }
}

TEST(HyperbolicMarch, GridsOfTheCasesAreUnfoldedAtSeveralResolutions) {
  for (const int j : {4, 8, 16, 32}) {
    const double h = 1.0 / (10 * j);
    const int around = static_cast<int>(2 * pi * 0.875 / h) + 1;
    for (const Side side : {Side::top, Side::bottom}) {
      const auto ellipse_grid =
          march(tilted_ellipse(), {.points = around, .lines = j == 4 ? 6 : 8, .curve = side, .spacing = h});
      EXPECT_GT(quality_of(ellipse_grid.x.view()).min_jacobian_ratio, 0.3);
      const int star_points = static_cast<int>(length_of(star()) / h) + 1;
      const auto star_grid =
          march(star(), {.points = star_points, .lines = 8, .curve = side, .spacing = std::min(h, 0.0125)});
      EXPECT_GT(quality_of(star_grid.x.view()).min_jacobian_ratio, 0.3);
    }
  }
}

TEST(HyperbolicMarch, BeamGridsAreUnfoldedAndTheirEndsStayOnTheWall) {
  for (const int j : {16, 32}) {
    const double h = 1.0 / (10 * j);
    const int along = static_cast<int>(length_of(beam_outline()) / h) + 1;
    const Marched gas = march(beam_outline(), beam_grid(along, 9, Side::bottom, h));
    const double depth = std::min(0.015, 3 * h);
    const Marched solid =
        march(beam_outline(), beam_grid(static_cast<int>(1.2 * along), 10, Side::top, depth / 9));
    for (const Marched* grid : {&gas, &solid}) {
      const auto view = grid->x.view();
      for (int line = 0; line < view.layout.n2; ++line) {
        EXPECT_EQ(view(1, 0, line), 0.0);
        EXPECT_EQ(view(1, view.layout.n1 - 1, line), 0.0);
      }
    }
    EXPECT_GT(quality_of(gas.x.view()).min_jacobian_ratio, 0.4);
    EXPECT_GT(quality_of(solid.x.view()).min_jacobian_ratio, 0.4);
    // The outline's left side has the gas on its left.
    EXPECT_LT(gas.x(0, along / 4, 8), -0.05 - 7 * h);
  }
}

TEST(HyperbolicMarch, LinesStayOffTheWallOverWhichTheirCurveLeans) {
  constexpr int points = 81, lines = 9;
  for (const double lean : {0.2, 0.4, 0.6}) {  // radians from the vertical
    std::vector<double> curve(std::size_t{2} * points);
    for (std::size_t k = 0; k < points; ++k) {
      curve[k] = 0.0125 * static_cast<double>(k) * std::sin(lean);
      curve[points + k] = 0.0125 * static_cast<double>(k) * std::cos(lean);
    }
    HyperbolicMarch marcher({.points = points,
                             .lines = lines,
                             .curve = Side::top,
                             .ends = Curve::open,
                             .spacing = 0.0125,
                             .walls = {Vec2(1, 0), std::nullopt},
                             .blend = 2 * lines});
    Field x(marcher.layout(), 2);
    marcher.march(curve, x.view(), 0);
    EXPECT_GT(cell_quality(x.view()), 0.85 * std::cos(lean)) << lean;  // the corner at the wall has cos(lean)
    EXPECT_GT(x(1, 1, 0), 0.5 * x(1, 1, lines - 1)) << lean;
  }
}

/// Inside of a wedge of 11 degrees on a wall, whose tip is the last point of the curve.
Field wedge_inside(bool flat) {
  constexpr int points = 131, lines = 7;
  std::vector<double> curve(2 * static_cast<std::size_t>(points));
  for (std::size_t k = 0; k < points; ++k) {
    const double s = 1 - static_cast<double>(k) / (points - 1);
    curve[k] = s;
    curve[points + k] = 0.2 * s;
  }
  HyperbolicGrid grid{.name = "wedge",
                      .points = points,
                      .lines = lines,
                      .curve = Side::bottom,
                      .ends = Curve::open,
                      .spacing = 2e-3,
                      .walls = {std::nullopt, Vec2(1, 0)}};
  grid.flat_ends = {false, flat};
  Field x(Layout(points, lines), 2);
  HyperbolicMarch(grid).march(curve, x.view(), 0);
  return x;
}

TEST(HyperbolicMarch, LinesStayParallelToACurveThatComesDownFlatOnItsWall) {
  const Field x = wedge_inside(true);
  const double slope = std::hypot(1, 0.2), way = 2e-3 * slope / 0.2;  // to the wall, for each line
  for (int j = 1; j < 7; ++j) {
    // The end goes as far as its neighbour does, which is 1/15 of the way on which the shift falls to zero from it.
    EXPECT_NEAR(x(0, 130, j), j * way, way * j / 15);
    EXPECT_NEAR(x(1, 130, j), 0, 1e-14);
    for (int i = 1; i < 130; ++i) {
      EXPECT_NEAR((0.2 * x(0, i, j) - x(1, i, j)) / slope, 2e-3 * j, 1e-4 * j) << i << " " << j;
    }
  }
  EXPECT_THROW(wedge_inside(false), Diverged);  // lines along normals run into the wall
}

TEST(CellQuality, IsOneOfRectanglesTheSineOfAParallelogramsAngleAndZeroWhereACellFolds) {
  const auto grid = [](double shear, double taper) {
    Field x(Layout(6, 5), 2);
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 6; ++i) {
        x(0, i, j) = 0.3 * i * (1 - taper * (j == 4 ? 1 : 0)) + shear * j;
        x(1, i, j) = j;
      }
    }
    return cell_quality(x.view());
  };
  EXPECT_NEAR(grid(0, 0), 1, 1e-15);
  EXPECT_NEAR(grid(1, 0), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(grid(0, 1), 0, 1e-15);
  EXPECT_LT(grid(0, 1.2), 0);
}

TEST(HyperbolicMarch, StraightCurveBetweenWallsGivesARectangularGrid) {
  std::vector<double> curve(22, 0.25);
  for (std::size_t k = 0; k < 11; ++k) curve[11 + k] = 0.1 * static_cast<double>(k);
  HyperbolicGrid description = beam_grid(11, 6, Side::top, 0.1);
  description.growth = 1.2;
  HyperbolicMarch marcher(description);
  Field x(marcher.layout(), 2);
  marcher.march(curve, x.view(), 0);
  EXPECT_NEAR(marcher.depth(), 0.1 * (std::pow(1.2, 5) - 1) / 0.2, 1e-15);
  for (int i = 0; i < 11; ++i) {
    EXPECT_NEAR(x(0, i, 0), 0.25 + marcher.depth(), 1e-14);
    EXPECT_NEAR(x(1, i, 2), 0.1 * i, 1e-14);
  }
}

TEST(HyperbolicMarch, GhostLinesContinueTheGridSmoothly) {
  const Marched grid =
      march(circle({0, 0}, 1), {.points = 129, .lines = 8, .curve = Side::top, .spacing = 0.05});
  for (int i = -2; i < 131; ++i) {
    // Lines of an annulus are nearly straight rays: the radius goes on in equal steps.
    for (int j = -2; j < 9; ++j) {
      const double step =
          std::hypot(grid.x(0, i, j), grid.x(1, i, j)) - std::hypot(grid.x(0, i, j + 1), grid.x(1, i, j + 1));
      EXPECT_NEAR(step, 0.05, 0.002);
    }
  }
}

TEST(HyperbolicMarch, GhostsOfALineThatBendsSharplyAtItsEndLeaveTheLastCellItsArea) {
  // The curve leaves its wall at 25 degrees and is upright after one point, as the side of a soft body at its foot.
  std::vector<double> curve(22);
  for (std::size_t k = 0; k < 11; ++k) {
    curve[k] = k == 0 ? 0 : 0.09 + 0.01 * std::min(3.0, static_cast<double>(k));
    curve[11 + k] = k == 0 ? 0 : 0.04 + 0.1 * static_cast<double>(k - 1);
  }
  HyperbolicMarch marcher(beam_grid(11, 6, Side::bottom, 0.02));
  Field x(marcher.layout(), 2);
  marcher.march(curve, x.view(), 0);
  const auto central = [&](int c) { return 0.5 * (x(c, 1, 0) - x(c, -1, 0)); };
  const double area = std::fabs(central(0) * 0 - central(1) * (x(0, 0, 1) - x(0, 0, 0)));
  const double cell = std::fabs(x(1, 1, 0) * (x(0, 0, 1) - x(0, 0, 0)));
  EXPECT_GT(area, 0.5 * cell);  // extrapolation of third order leaves less than nothing
  const double ghost = std::hypot(x(0, -1, 0), x(1, -1, 0)), last = std::hypot(x(0, 1, 0), x(1, 1, 0));
  EXPECT_NEAR(ghost / last, 1, largest_change_of_step);
}

/// Largest distance between the grid around a circle and that around one whose radius swings `waves` times by
/// `swing`. Eight lines, 0.05 apart.
double answer_to_a_wave(int points, int waves, double swing) {
  const HyperbolicGrid description{.points = points, .lines = 8, .curve = Side::top, .spacing = 0.05};
  const Marched round = march(circle({0, 0}, 1), description);
  std::vector<double> curve = round.curve;
  for (int k = 0; k < points; ++k) {
    const double r = 1 + swing * std::cos(2 * pi * waves * k / (points - 1));
    curve[static_cast<std::size_t>(k)] *= r;
    curve[static_cast<std::size_t>(points + k)] *= r;
  }
  Field x(round.x.layout(), 2);
  HyperbolicMarch(description).march(curve, x.view(), 0);
  double worst = 0;
  for (int j = 0; j < description.lines; ++j) {
    for (int i = 0; i < points; ++i)
      worst = std::max(worst, std::hypot(x(0, i, j) - round.x(0, i, j), x(1, i, j) - round.x(1, i, j)));
  }
  return worst;
}

TEST(HyperbolicMarch, DoesNotAmplifyWavesShorterThanTheDistanceOfTheLines) {
  constexpr double swing = 0.0005;
  for (const int finer : {1, 2, 4, 8}) {  // points than lines
    const int points = 126 * finer + 1;
    for (const int waves : {21, 42, 63, 126, 252}) {
      if (4 * waves > points) continue;
      EXPECT_LT(answer_to_a_wave(points, waves, swing), 4 * swing) << finer << " " << waves;
    }
  }
}

/// The outline of a flap, 30 x 1 with arcs of radius 0.4 at its tip, whose line turns by an angle within 10 of its height.
std::vector<double> bent_flap(int points, double angle) {
  const PlaneCurve straight =
      rounded_polygon({.corners = {{0.5, 0}, {0.5, 30}, {-0.5, 30}, {-0.5, 0}}, .radius = 0.4});
  std::vector<double> curve = points_on(straight, points);
  constexpr double place = 22, width = 5;
  const auto slope = [&](double s) { return 0.5 * angle * (1 + std::tanh((s - place) / width)); };
  for (std::size_t k = 0, n = curve.size() / 2; k < n; ++k) {
    const double across = curve[k], height = curve[n + k];
    double x = 0, y = 0;
    constexpr int parts = 300;
    for (int part = 0; part < parts; ++part) {
      const double turn = slope(height * (part + 0.5) / parts);
      x += std::sin(turn) * height / parts;
      y += std::cos(turn) * height / parts;
    }
    curve[k] = x + across * std::cos(slope(height));
    curve[n + k] = y - across * std::sin(slope(height));
  }
  return curve;
}

// Points are close for the sake of the tip, and beside its fan the outermost ones half as far apart: steps as long as
// the curve's points are apart amplified short waves there, and cells folded at an angle of 0.4.
TEST(HyperbolicMarch, LinesAroundARoundTipKeepTheirOrderWhenTheFlapBends) {
  HyperbolicGrid description = beam_grid(304, 18, Side::top, 0.38);
  description.blend = 2 * description.lines;
  HyperbolicMarch marching(description);
  Field x(marching.layout(), 2);
  for (const double angle : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    marching.march(bent_flap(description.points, angle), x.view(), angle);
    EXPECT_GT(cell_quality(x.view()), 0.5) << angle;
  }
}

/// Largest distance of a grid's points from the mirror images, in x = 0, of those that come from the other end of its
/// lines, in spacings.
double lopsidedness(ConstFieldView x, double spacing) {
  double worst = 0;
  const int last = x.layout.n1 - 1;
  for (int j = 0; j < x.layout.n2; ++j) {
    for (int i = 0; i <= last; ++i)
      worst = std::max(worst, std::hypot(x(0, i, j) + x(0, last - i, j), x(1, i, j) - x(1, last - i, j)));
  }
  return worst / spacing;
}

// The normal at the tip is upright but for round-off, whose sign once said on which side of the flap its line came to lie.
TEST(HyperbolicMarch, GridsAroundAFlapOnAWallAreAsSymmetricAsTheFlap) {
  constexpr double spacing = 0.02;
  const PlaneCurve flap =
      rounded_polygon({.corners = {{0.05, 0}, {0.05, 0.2}, {-0.05, 0.2}, {-0.05, 0}}, .radius = 0.03});
  for (const Side side : {Side::top, Side::bottom}) {
    for (const int points : {31, 32}) {
      const double nearer = side == Side::top ? 1 : 0.1;  // lines within the flap
      HyperbolicGrid description = beam_grid(points, 9, side, nearer * spacing);
      description.blend = 2 * description.lines;
      const Marched grid = march(flap, description);
      EXPECT_LT(lopsidedness(grid.x.view(), spacing), 1e-12) << points;
      EXPECT_GT(cell_quality(grid.x.view()), 0.3) << points;
    }
  }
}

TEST(HyperbolicMarch, NamesGridCellPlaceAndTimeOfAFold) {
  try {
    march(beam_outline(), beam_grid(200, 10, Side::top, 0.02), 1.5);
    FAIL() << "a grid deeper than the beam is thick went unnoticed";
  } catch (const Diverged& broke) {
    const std::string words = broke.what();
    EXPECT_NE(words.find("t = 1.5, grid \"beam\", point ("), std::string::npos) << words;
    EXPECT_NE(words.find("the cell from here on is folded"), std::string::npos);
    EXPECT_NE(words.find("holds sharper bends, a stiffer body bends less"), std::string::npos) << words;
    EXPECT_EQ(broke.place().grid, "beam");
  }
}

TEST(HyperbolicMarch, NamesACurveThatIsNoNumber) {
  HyperbolicMarch marcher({.points = 65, .lines = 6, .curve = Side::top, .spacing = 0.05});
  auto curve = points_on(circle({0, 0}, 1), 65);
  curve[17] = std::nan("");
  Field x(marcher.layout(), 2);
  EXPECT_THROW(marcher.march(curve, x.view(), 0), Diverged);
}

TEST(HyperbolicMarch, MistakesAreTheUsers) {
  EXPECT_THROW(HyperbolicMarch(HyperbolicGrid{.points = 4, .lines = 6, .spacing = 1}), UserMistake);
  EXPECT_THROW(HyperbolicMarch(HyperbolicGrid{.points = 40, .lines = 6, .spacing = 0}), UserMistake);
  EXPECT_THROW(HyperbolicMarch(HyperbolicGrid{.points = 40, .lines = 6, .curve = Side::left, .spacing = 1}),
               UserMistake);
  EXPECT_THROW(
      HyperbolicMarch(HyperbolicGrid{.points = 40, .lines = 6, .spacing = 1, .concave_smoothing = -1}),
      UserMistake);
}

}  // namespace
}  // namespace fsi::grid
