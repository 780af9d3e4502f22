#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "common/core/failure.hpp"
#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "tests/unit/grid/overlap_checks.hpp"

namespace fsi::grid {
namespace {

using std::numbers::pi;

/// A closed body that wanders, turns and deforms at random, with a grid marched from it.
class Wanderer {
 public:
  struct Range {
    Vec2 centre = Vec2::Zero();
    double half_width = 0.3;  ///< of the square in which the centre stays
    double radius = 0.7;
  };

  Wanderer(std::string name, int points, int lines, double spacing, const Range& range, unsigned seed)
      : march_({.name = std::move(name),
                .points = points,
                .lines = lines,
                .curve = Side::top,
                .spacing = spacing}),
        x_(march_.layout(), 2),
        x_old_(march_.layout(), 2),
        range_(range),
        random_(seed) {
    place();
  }

  /// At most `step` per unit of each parameter.
  void move(double step) {
    std::swap(x_, x_old_);
    for (std::size_t k = 0; k < speed_.size(); ++k) {
      speed_[k] = std::clamp(speed_[k] + 0.3 * uniform(), -1.0, 1.0);
      state_[k] += step * speed_[k];
      const double limit = k < 2 ? range_.half_width : k == 2 ? 1e9 : 0.1;
      if (std::abs(state_[k]) > limit) {
        state_[k] = std::copysign(limit, state_[k]);
        speed_[k] = -speed_[k];
      }
    }
    place();
  }

  BodyFittedGrid body() const {
    const HyperbolicGrid& grid = march_.grid();
    return {.name = grid.name, .n1 = grid.points, .n2 = grid.lines, .curve = grid.curve};
  }
  GridPositions positions() const { return {x_.view(), x_old_.view()}; }
  Region region() const { return region_of(x_.view(), march_.grid().lines - 1); }

 private:
  HyperbolicMarch march_;
  Field x_, x_old_;
  Range range_;
  std::mt19937_64 random_;
  std::array<double, 6> state_{}, speed_{};  ///< centre, angle, and three modes of the radius

  double uniform() { return 2 * static_cast<double>(random_() >> 11) * 0x1.0p-53 - 1; }

  void place() {
    const int n = march_.grid().points;
    std::vector<double> curve(2 * static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * pi * (k % (n - 1)) / (n - 1);
      const double r = range_.radius * (1 + state_[3] * std::cos(2 * angle) +
                                        state_[4] * std::sin(3 * angle) + state_[5] * std::cos(angle + 1));
      curve[static_cast<std::size_t>(k)] = range_.centre[0] + state_[0] + r * std::cos(angle + state_[2]);
      curve[static_cast<std::size_t>(n + k)] = range_.centre[1] + state_[1] + r * std::sin(angle + state_[2]);
    }
    march_.march(curve, x_.view(), 0);
  }
};

CartesianGrid square(double half, double h) {
  const int n = static_cast<int>(std::lround(2 * half / h)) + 1;
  return {.n1 = n, .n2 = n, .x_a = -half, .x_b = half, .y_a = -half, .y_b = half};
}

void expect_same(const CompositeGrid& a, const CompositeGrid& b) {
  for (int g = 0; g < a.grids(); ++g) {
    EXPECT_EQ(a.discretised(g), b.discretised(g));
    EXPECT_EQ(a.valid(g), b.valid(g));
  }
  EXPECT_TRUE(std::ranges::equal(a.interpolation(), b.interpolation()));
}

/// Fills old values of a linear function and checks that exposed points get theirs.
void expect_exposed_values(const CompositeGrid& grids, const Kinds& before,
                           std::span<const GridPositions> x) {
  const auto linear = [](const Vec2& p) { return 1 + 2 * p[0] - 3 * p[1]; };
  const auto place = [&](int g, int i, int j) {
    if (g == 0) return grids.background().point(i, j);
    const ConstFieldView old = x[static_cast<std::size_t>(g) - 1].x_old;
    return Vec2(old(0, i, j), old(1, i, j));
  };
  std::vector<Field> fields;
  std::vector<FieldView> views;
  for (int g = 0; g < grids.grids(); ++g) {
    const Layout shape = grids.layout(g);
    fields.emplace_back(shape, 1);
    for (std::size_t k = 0; k < shape.points(); ++k) {
      const int i = static_cast<int>(k) % shape.n1, j = static_cast<int>(k) / shape.n1;
      const bool had = before[static_cast<std::size_t>(g)][k] != PointKind::unused;
      fields.back()(0, i, j) = had ? linear(place(g, i, j)) : std::nan("");
    }
    views.push_back(fields.back().view());
  }
  grids.fill_exposed(views);
  double worst = 0;
  for (int g = 0; g < grids.grids(); ++g) {
    for (int j = 0; j < grids.layout(g).n2; ++j) {
      for (const Interval& run : grids.valid(g).row(j)) {
        for (int i = run.begin; i < run.end; ++i) {
          const double error = std::abs(views[static_cast<std::size_t>(g)](0, i, j) - linear(place(g, i, j)));
          if (!(error <= worst) && !std::isnan(worst)) worst = error;  // NaN stays
        }
      }
    }
  }
  EXPECT_LT(worst, 1e-12);  // extrapolation by two lines magnifies round-off
}

TEST(CompositeMotion, ThousandRandomMotionsKeepEveryInvariant) {
  const double h = 0.08;
  Wanderer ring("ring", 61, 8, h, {}, 1);
  CompositeGrid grids(square(2, h), {ring.body()});
  const ConstFieldView start[] = {ring.positions().x};
  grids.connect(start, 0);
  Kinds before = kinds_of(grids);
  std::size_t exposed = 0, extrapolated = 0;
  for (int step = 1; step <= 1000 && !::testing::Test::HasFailure(); ++step) {
    ring.move(0.25 * h);
    const GridPositions x[] = {ring.positions()};
    grids.update(x, step);
    const ConstFieldView now[] = {x[0].x}, old[] = {x[0].x_old};
    OverlapChecker checker(grids, {ring.region()});
    checker.check(now);
    checker.check_exposed(before, old);
    CompositeGrid fresh(square(2, h), {ring.body()});
    fresh.connect(now, step);
    expect_same(grids, fresh);
    if (step % 10 == 0) expect_exposed_values(grids, before, x);
    exposed += grids.counts().exposed;
    extrapolated += grids.counts().extrapolated;
    before = checker.kinds();
  }
  EXPECT_GT(exposed, 1000U);
  EXPECT_GT(extrapolated, 0U);
}

TEST(CompositeMotion, ThousandMotionsWithTrimmedLinesExposeNothingWithoutAValue) {
  const double h = 0.08;
  Wanderer ring("ring", 61, 12, h, {.centre = Vec2::Zero(), .half_width = 0.1, .radius = 0.7}, 5);
  CompositeGrid grids(square(2, h), {ring.body()}, {.trim = true});
  const ConstFieldView start[] = {ring.positions().x};
  grids.connect(start, 0);
  Kinds before = kinds_of(grids);
  for (int step = 1; step <= 1000 && !::testing::Test::HasFailure(); ++step) {
    ring.move(0.25 * h);
    const GridPositions x[] = {ring.positions()};
    grids.update(x, step);
    const ConstFieldView old[] = {x[0].x_old};
    OverlapChecker checker(grids, {ring.region()});
    checker.check_exposed(before, old);
    expect_exposed_values(grids, before, x);
    before = checker.kinds();
  }
}

TEST(CompositeMotion, BodiesPulledThroughEachOthersGridsConnectOrSayWhatFailed) {
  const double h = 0.07;
  Wanderer a("a", 45, 9, h, {.centre = {-0.65, 0.1}, .half_width = 0.25, .radius = 0.5}, 2);
  Wanderer b("b", 45, 9, h, {.centre = {0.65, -0.1}, .half_width = 0.25, .radius = 0.5}, 3);
  CompositeGrid grids(square(1.82, h), {a.body(), b.body()});
  bool connected = false;
  int successes = 0, cut = 0;
  Kinds before;
  for (int step = 0; step < 1000 && !::testing::Test::HasFailure(); ++step) {
    a.move(0.25 * h);
    b.move(0.25 * h);
    const GridPositions x[] = {a.positions(), b.positions()};
    const ConstFieldView now[] = {x[0].x, x[1].x}, old[] = {x[0].x_old, x[1].x_old};
    try {
      const bool has_past = connected;
      connected = false;
      if (has_past) {
        grids.update(x, step);
      } else {
        grids.connect(now, step);
      }
      connected = true;
      OverlapChecker checker(grids, {a.region(), b.region()});
      checker.check(now);
      if (has_past) checker.check_exposed(before, old);
      before = checker.kinds();
      ++successes;
      cut += std::ranges::count(before[1], PointKind::unused) > 0 ? 1 : 0;
    } catch (const Diverged& broke) {
      const std::string words = broke.what();
      // Bodies come too close, even into each other; points
      // uncovered by a small motion always have old values.
      EXPECT_EQ(words.find("uncovered"), std::string::npos) << words;
      EXPECT_NE(words.find("point ("), std::string::npos) << words;
      EXPECT_NE(words.find("such points)"), std::string::npos) << words;
    }
  }
  EXPECT_GT(successes, 500);
  EXPECT_GT(cut, 50);  // not all of it was easy
}

TEST(CompositeMotion, JumpOfSeveralCellsIsANamedError) {
  const double h = 0.05;
  Wanderer ring("ring", 91, 8, h, {}, 4);
  CompositeGrid grids(square(2, h), {ring.body()});
  const ConstFieldView start[] = {ring.positions().x};
  grids.connect(start, 0);
  for (int k = 0; k < 12; ++k) ring.move(0.5 * h);
  Field x_old(ring.positions().x.layout, 2);
  for (int j = -2; j < 10; ++j) {
    for (int i = -2; i < 93; ++i) {
      x_old(0, i, j) = ring.positions().x(0, i, j) - 0.3;
      x_old(1, i, j) = ring.positions().x(1, i, j);
    }
  }
  const ConstFieldView shifted[] = {x_old.view()};
  grids.connect(shifted, 0);
  const GridPositions jump[] = {{ring.positions().x, x_old.view()}};
  try {
    grids.update(jump, 0.5);
    FAIL() << "a jump of six cells went unnoticed";
  } catch (const Diverged& broke) {
    EXPECT_NE(std::string(broke.what()).find("uncovered by a motion of more than a cell"), std::string::npos)
        << broke.what();
  }
}

}  // namespace
}  // namespace fsi::grid
