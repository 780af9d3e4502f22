/// Grids marched into concave places, where lines converge.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "common/core/failure.hpp"
#include "common/grid/geometry/quality.hpp"
#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/shapes/circle.hpp"
#include "tests/unit/grid/marched.hpp"
#include "tests/unit/grid/shapes_of_cases.hpp"

namespace fsi::grid {
namespace {

using std::numbers::pi;

/// One wave of length 1 between two walls, its trough concave for a grid above it.
PlaneCurve wave(double amplitude) {
  return {.ends = Curve::open,
          .position = [=](double s) { return Vec2(s, amplitude * std::cos(2 * pi * s)); },
          .slope = [=](double s) { return Vec2(1, -2 * pi * amplitude * std::sin(2 * pi * s)); }};
}

/// A straight line with a notch whose sides fall by `degrees`; the corner's radius is about 0.04.
PlaneCurve notch(double degrees) {
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  return smoothed_polygon({.corners = {{-c, s}, {0, 0}, {c, s}}, .sharpness = 50});
}

PlaneCurve slender_ellipse(double axes) {
  return ellipse({.a = 1, .b = 1 / axes});
}

/// Five arms with valleys between them.
PlaneCurve clover(double swing) {
  const auto r = [=](double s) { return 1 + swing * std::cos(10 * pi * s); };
  const auto dr = [=](double s) { return -10 * pi * swing * std::sin(10 * pi * s); };
  const auto along = [](double s) { return Vec2(std::cos(2 * pi * s), std::sin(2 * pi * s)); };
  const auto across = [](double s) { return Vec2(-std::sin(2 * pi * s), std::cos(2 * pi * s)); };
  return {.position = [=](double s) { return Vec2(r(s) * along(s)); },
          .slope = [=](double s) { return Vec2(dr(s) * along(s) + 2 * pi * r(s) * across(s)); }};
}

/// Points and lines 0.16 / (lines - 1) apart; the wave's grid ends on the walls x = 0 and x = 1.
HyperbolicGrid deep_grid(const PlaneCurve& shape, int lines, Side side, double concave_smoothing) {
  const double spacing = 0.16 / (lines - 1);
  HyperbolicGrid grid{.name = "deep",
                      .points = static_cast<int>(length_of(shape) / spacing) + 1,
                      .lines = lines,
                      .curve = side,
                      .ends = shape.ends,
                      .spacing = spacing,
                      .concave_smoothing = concave_smoothing};
  if (shape.ends == Curve::open && std::abs(shape.position(1)[0] - 1) < 1e-9) {
    grid.walls = {Vec2(0, 1), Vec2(0, 1)};
    grid.blend = 2 * lines;
  }
  return grid;
}

/// Quality of the worst cell, 0 where one is folded.
double worst_cell(const PlaneCurve& shape, const HyperbolicGrid& grid) {
  try {
    return cell_quality(march(shape, grid).x.view());
  } catch (const Diverged&) {
    return 0;
  }
}

struct Family {
  const char* name;
  std::function<PlaneCurve(double)> shape;
  Side side;
  double from, by;  ///< parameters to try
  double gain;      ///< of the largest parameter, at least
};

/// The largest parameter up to which all grids are unfolded.
double largest_unfolded(const Family& family, int lines, double concave_smoothing) {
  double p = family.from;
  for (; p < 100 * family.by; p += family.by) {
    const PlaneCurve shape = family.shape(p);
    if (!(worst_cell(shape, deep_grid(shape, lines, family.side, concave_smoothing)) > 0)) break;
  }
  return p - family.by;
}

TEST(ConcaveSmoothing, GridsReachFarDeeperIntoConcavePlaces) {
  const Family families[] = {
      {"wave, amplitude", wave, Side::bottom, 0.1, 0.02, 3},
      {"notch, degrees", notch, Side::bottom, 10, 2, 2},
      {"inside of an ellipse, ratio of axes", slender_ellipse, Side::bottom, 1.2, 0.1, 1.5},
      {"clover, swing", clover, Side::top, 0.1, 0.02, 2.4},
  };
  for (const Family& family : families) {
    for (const int lines : {9, 17}) {
      const double plain = largest_unfolded(family, lines, 0), smoothed = largest_unfolded(family, lines, 1);
      EXPECT_GT(smoothed, family.gain * plain) << family.name << ", " << lines << " lines";
    }
  }
}

TEST(ConcaveSmoothing, LeavesGridsToTheBitWhereTheCurveIsConvexStraightOrGentle) {
  struct {
    PlaneCurve shape;
    Side side;
  } const cases[] = {{circle({0, 0}, 0.05), Side::top},  // convex, however sharp
                     {circle({0, 0}, 0.25), Side::bottom},
                     {slender_ellipse(1.4), Side::bottom},
                     {wave(0), Side::bottom},
                     {wave(0.1), Side::bottom},
                     {beam_outline(), Side::bottom}};
  for (const auto& [shape, side] : cases) {
    const Marched plain = march(shape, deep_grid(shape, 9, side, 0));
    const Marched smoothed = march(shape, deep_grid(shape, 9, side, 1));
    EXPECT_TRUE(std::ranges::equal(plain.x.values(), smoothed.x.values()));
  }
}

TEST(ConcaveSmoothing, FlattensAValleyByAsMuchWhateverTheNumberOfLines) {
  const auto rise = [](int lines) {  // of the valley's bottom to the last line
    const PlaneCurve shape = wave(0.3);
    HyperbolicGrid grid = deep_grid(shape, lines, Side::bottom, 1);
    grid.points += grid.points % 2 == 0 ? 1 : 0;
    grid.smoothing = 0;
    const Marched marched = march(shape, grid);
    return marched.x(1, grid.points / 2, lines - 1) + 0.3;
  };
  const double coarse = rise(9), fine = rise(17), finest = rise(33);
  EXPECT_GT(finest, 1.2 * 0.16);  // faster there than elsewhere
  EXPECT_LT(std::abs(finest - fine), 0.05 * finest);
  EXPECT_LT(std::abs(finest - fine), 0.7 * std::abs(fine - coarse));
}

TEST(ConcaveSmoothing, GridsMoveWithoutJumpsAsACurveGrowsConcave) {
  // Second differences over steps of the amplitude: as the
  // step where a velocity jumps, as its square where not.
  const auto roughest = [](int steps) {
    HyperbolicGrid grid = deep_grid(wave(0.2), 9, Side::bottom, 1);
    grid.smoothing = grid.end_smoothing = 0;  // follows the smaller of two distances, which does jump
    HyperbolicMarch marcher(grid);
    Field x[3] = {Field(marcher.layout(), 2), Field(marcher.layout(), 2), Field(marcher.layout(), 2)};
    double worst = 0;
    for (int k = 0; k <= steps; ++k) {
      std::swap(x[0], x[1]);
      std::swap(x[1], x[2]);
      marcher.march(points_on(wave(0.08 + 0.22 * k / steps), grid.points), x[2].view(), 0);
      if (k < 2) continue;
      for (std::size_t i = 0; i < x[2].values().size(); ++i) {
        worst = std::max(worst, std::abs(x[2].values()[i] - 2 * x[1].values()[i] + x[0].values()[i]));
      }
    }
    return worst;
  };
  EXPECT_LT(roughest(400), roughest(200) / 3);
}

}  // namespace
}  // namespace fsi::grid
