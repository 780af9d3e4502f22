// Boundaries of a solid as far as they need no law: sides, ghost points, given motion, tractions, what they remember.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "solid_solver/boundary/conditions/ghost_frame.hpp"
#include "solid_solver/boundary/conditions/given_motion.hpp"
#include "solid_solver/boundary/conditions/loaded_dissipation.hpp"
#include "solid_solver/boundary/conditions/tractions.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
#include "solid_solver/boundary/ghost_lines.hpp"
#include "solid_solver/boundary/traction_ghost.hpp"
#include "solid_solver/kernels/sweep/dissipation.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"

namespace fsi::solid {
namespace {

Boundaries of_conditions(const std::array<Condition, 4>& conditions) {
  Boundaries boundaries;
  for (std::size_t side = 0; side < 4; ++side) boundaries[side].condition = conditions[side];
  return boundaries;
}

/// The sides of a grid without any solver around them.
struct Body {
  grid::MovingGrid grid;
  ReferenceMetrics metrics{grid.x()};
  SolidPoints points{grid.layout()};
  Sides sides;
  ChosenValues chosen{grid.x(), 1.0};
  SideMemory memory{sides};
  Field q{grid.layout(), plane::count};

  Body(grid::MovingGrid of, const Boundaries& boundaries)
      : grid(std::move(of)),
        sides({.name = "body", .x = grid.x(), .metrics = &metrics, .points = &points}, boundaries,
              Limiter::none) {}

  /// Everywhere, ghost points included.
  template <class State>
  void assign(const State& state) {
    const Layout layout = grid.layout();
    for (int j = -2; j < layout.n2 + 2; ++j) {
      for (int i = -2; i < layout.n1 + 2; ++i)
        store(q.view(), layout.at(i, j), state(grid.x()(0, i, j), grid.x()(1, i, j)));
    }
  }
  SolidState at(Side side, int k, int m = 0) { return load(q.view(), sides.line(side).at(k, m)); }
};

/// No two points have the same.
SolidState various(double x, double y) {
  const double s = std::sin(7 * x + 3 * y), c = std::cos(5 * x - 2 * y);
  return {.u = Vec2(s, c), .v = Vec2(c * s, s - 2 * c), .P = {s + c, 2 * s, 3 * c, s * s}};
}

TEST(Sides, EndWhereTheirNeighboursDo) {
  const Body body(test::unit_square(6), {});
  for (const Side side : all_sides) {
    for (const int k : {0, body.sides.line(side).n - 1}) {
      const SidePoint other = body.sides.around_corner(side, k),
                      back = body.sides.around_corner(other.side, other.k);
      EXPECT_EQ(body.sides.line(side).at(k, 0), body.sides.line(other.side).at(other.k, 0));
      EXPECT_EQ(back.side, side);
      EXPECT_EQ(back.k, k);
    }
  }
}

TEST(Sides, HaveMirrorImagesWhereTheGridHas) {
  const Boundaries walls =
      of_conditions({Symmetry::condition, Symmetry::condition, Symmetry::condition, Symmetry::condition});
  const Body square(test::unit_square(6), walls), skewed(test::skewed_grid(6), walls);
  EXPECT_EQ(square.sides.condition(Side::left), Symmetry::condition);
  EXPECT_EQ(skewed.sides.condition(Side::left), SlipWall::condition);
}

TEST(Sides, OfARankAreThoseInItsRows) {
  Body body(test::unit_square(6), {});
  body.sides.take_rows({.all = false, .own = {2, 4}, .halos = {{1, 5}}});
  EXPECT_EQ(body.sides.points(Side::left).size(), 4U);
  EXPECT_TRUE(body.sides.present(Side::left) && body.sides.points(Side::top).empty());
  EXPECT_FALSE(body.sides.present(Side::top));
  EXPECT_TRUE(body.sides.advanced(Side::right, 1) && !body.sides.owns(Side::right, 1));
}

TEST(SideMemory, PutTogetherFromTheRowsOfRanksIsTheWhole) {
  Body body(test::unit_square(6), {});
  double count = 0;
  for (const Side side : all_sides) {
    for (int k = 0; k < 7; ++k) {
      count += 6;
      body.memory.T(side, k) = {count, count + 1};
      body.memory.T_rate(side, k) = {count + 2, count + 3};
      body.memory.v_change(side, k) = {count + 4, count + 5};
    }
  }
  SideMemory whole(body.sides);
  for (const grid::RowRange rows : {grid::RowRange{0, 3}, grid::RowRange{3, 7}}) {
    const std::vector<double> part = body.memory.scattered(body.sides, rows);
    EXPECT_TRUE(whole.gather_scattered(body.sides, rows, part).empty());
  }
  for (const Side side : all_sides) {
    for (int k = 0; k < 7; ++k) {
      EXPECT_EQ(whole.T(side, k), body.memory.T(side, k));
      EXPECT_EQ(whole.T_rate(side, k), body.memory.T_rate(side, k));
      EXPECT_EQ(whole.v_change(side, k), body.memory.v_change(side, k));
    }
  }
}

TEST(GivenMotion, LeavesNothingAlongTheNormalOfAWallAndRemembersWhatItTook) {
  Body body(test::skewed_grid(6), of_conditions({SlipWall::condition, {}, {}, {}}));
  body.assign(various);
  const Field before = body.q.clone();
  GivenMotion(body.sides, body.chosen).set(body.q.view(), 0, {}, body.memory);
  for (int k = 0; k < 7; ++k) {
    const Vec2 n = body.sides.at(Side::left, k).n0;
    const SolidState now = body.at(Side::left, k),
                     then = load(before.view(), body.sides.line(Side::left).at(k, 0));
    // Round-off of numbers of size 3.
    EXPECT_NEAR(n.dot(now.u), 0, 1e-15);
    EXPECT_NEAR(n.dot(now.v), 0, 2e-15);
    EXPECT_NEAR((then.v + body.memory.v_change(Side::left, k) - now.v).norm(), 0, 2e-15);
    const Vec2 along(-n.y(), n.x());
    EXPECT_NEAR(along.dot(now.u - then.u), 0, 1e-15);
  }
}

TEST(GivenMotion, OfASideIsThatOfItsFunctionsAndOfItsCorners) {
  Boundaries boundaries = of_conditions({Displacement::condition, {}, {}, {}});
  boundaries[0].vector = [](double /*x*/, double y, double t) { return Vec2(y * t, 2); };
  boundaries[0].velocity = [](double /*x*/, double y, double /*t*/) { return Vec2(y, 0); };
  Body body(test::unit_square(6), boundaries);
  GivenMotion(body.sides, body.chosen).set(body.q.view(), 3, {}, body.memory);
  EXPECT_EQ(body.at(Side::left, 6).u, Vec2(3, 2));
  EXPECT_EQ(body.at(Side::left, 6).v, Vec2(1, 0));
  const auto corner = given_motion(body.sides, Side::top, 0, 3);
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->u, Vec2(3, 2));
  EXPECT_FALSE(given_motion(body.sides, Side::top, 1, 3) || given_motion(body.sides, Side::top, 6, 3));
}

/// Of a motion that has values from 0 to 1 alone.
VectorFunction from_0_to_1(const std::function<Vec2(double)>& motion) {
  return [motion](double /*x*/, double /*y*/, double t) -> Vec2 {
    return t < 0 || t > 1 ? Vec2::Constant(std::numeric_limits<double>::quiet_NaN()) : motion(t);
  };
}

TEST(RateOfAFormula, IsThatOfAPolynomialWhereThisHasNoValueBeforeOrAfter) {
  const VectorFunction rate = rate_of(from_0_to_1([](double t) -> Vec2 {
                                        return {3 * t, 1 - 2 * t + t * t * t * t};
                                      }),
                                      1.0);
  for (const double t : {0.0, 5e-4, 1e-3, 0.5, 0.999, 1.0}) {
    // Round-off of numbers of size 1, of which sums are divided by 1e-3.
    EXPECT_NEAR((rate(0, 0, t) - Vec2(3, -2 + 4 * t * t * t)).norm(), 0, 1e-11) << t;
  }
}

TEST(RateOfAFormula, HasTheErrorOfCentralDifferencesWhereTheseHaveAllValues) {
  const double h = 0.02;  // their error is h^4 / 30 of the fifth derivative, that of one-sided ones h^4 / 5
  const VectorFunction rate = rate_of(from_0_to_1([](double t) -> Vec2 {
                                        return {std::sin(t), 0};
                                      }),
                                      1e3 * h);
  EXPECT_LT(std::abs(rate(0, 0, 0.5).x() - std::cos(0.5)), h * h * h * h / 25);
  EXPECT_LT(std::abs(rate(0, 0, 0).x() - 1), h * h * h * h / 4);
}

TEST(Tractions, HaveARateWhereTheirFormulaHasNoValueBeforeOrAfter) {
  Boundaries boundaries;
  boundaries[3].vector = from_0_to_1([](double t) -> Vec2 { return {1 + t, 2 * t * t}; });
  for (const double t : {0.0, 0.25, 1.0}) {
    Body body(test::unit_square(6), boundaries);
    body.assign([](double, double) { return SolidState{}; });
    Tractions(body.sides, body.chosen, 1.0).find(body.q.view(), Side::top, t, body.memory);
    for (int k = 0; k < 7; ++k)
      EXPECT_NEAR((body.memory.T_rate(Side::top, k) - Vec2(1, 4 * t)).norm(), 0, 1e-11) << t;
  }
}

TEST(Eq42Traction, OfAStretchedSideIsThatOfItsPresentLength) {
  Boundaries boundaries;
  boundaries[3].vector = [](double /*x*/, double /*y*/, double t) { return Vec2(1 + t, -2); };
  for (const LoadConfiguration load : {LoadConfiguration::current, LoadConfiguration::reference}) {
    boundaries[3].load = load;
    Body body(test::unit_square(6), boundaries);
    body.assign([](double x, double y) {
      return SolidState{.u = Vec2(0.25 * x, y), .v = Vec2(0.5 * x, -y), .P = {}};
    });
    Tractions(body.sides, body.chosen, 1.0).find(body.q.view(), Side::top, 0, body.memory);
    const bool present = load == LoadConfiguration::current;
    const double stretch = present ? 1.25 : 1.0, growth = present ? 0.5 : 0.0;
    for (int k = 0; k < 7; ++k) {
      EXPECT_NEAR((body.memory.T(Side::top, k) - stretch * Vec2(1, -2)).norm(), 0, 1e-14);
      // The rate of tau is a difference over 1e-3: round-off of numbers of size 1 divided by that.
      EXPECT_NEAR((body.memory.T_rate(Side::top, k) - stretch * Vec2(1, 0) - growth * Vec2(1, -2)).norm(), 0,
                  1e-11);
    }
  }
}

TEST(Tractions, AreThoseOfTheStressWhereTheyAreKnownAndWithoutShearAtWalls) {
  Body body(test::skewed_grid(6), of_conditions({SlipWall::condition, Traction::condition, {}, {}}));
  body.assign(various);
  const Tractions tractions(body.sides, body.chosen, 1.0);
  for (int k = 0; k < 7; ++k) body.memory.T(Side::right, k) = {k, -2};
  for (const Side side : {Side::left, Side::right})
    tractions.set_normal_stress(body.q.view(), side, 0, body.memory);
  for (int k = 0; k < 7; ++k) {
    const SideMetrics &wall = body.sides.at(Side::left, k), &loaded = body.sides.at(Side::right, k);
    EXPECT_NEAR(wall.t0.dot(traction_of(body.at(Side::left, k).P, wall.n0)), 0, 2e-15);
    EXPECT_NEAR((traction_of(body.at(Side::right, k).P, loaded.n0) - Vec2(k, -2)).norm(), 0, 5e-15);
  }
}

TEST(GhostFrame, IsWhatTheSidesSayOfIt) {
  Boundaries boundaries =
      of_conditions({Periodic::condition, Periodic::condition, Dirichlet::condition, no_condition});
  boundaries[2].state = [](double x, double y, double t) { return various(x + t, y); };
  Body body(test::unit_square(6), boundaries);
  body.assign(various);
  const SolidState kept = body.at(Side::top, 3, -1);
  const GhostFrame frame(body.sides, body.chosen);
  frame.fill_line(body.q.view(), 0.5, {.m = -1});
  EXPECT_EQ(body.at(Side::top, 3, -1).u, kept.u);
  EXPECT_EQ(body.at(Side::left, 3, -1).P.a12, body.at(Side::right, 3, 1).P.a12);
  const Vec2 below = body.sides.position(body.sides.line(Side::bottom).at(3, -1));
  EXPECT_EQ(body.at(Side::bottom, 3, -1).v, various(below.x() + 0.5, below.y()).v);
}

/// The displacement's change by paper eq. (40) with beta^u = 0.5 at all points, and what loaded sides take back of it.
template <class Gradient>
Field displacement_dissipation(Body& body, bool corrected) {
  const Layout& layout = body.grid.layout();
  Field next(layout, plane::count);
  for (int j = 0; j < layout.n2; ++j) {
    add_displacement_dissipation(body.q.view(), next.view(), Gradient(body.grid.x(), body.metrics, j), 0.5,
                                 {j, 0, layout.n1});
  }
  if (corrected) correct_displacement_dissipation(body.sides, body.q.view(), next.view(), 0.5);
  return next;
}

double largest(const Field& next) {
  double most = 0;
  for (const double value : next.values()) most = std::max(most, std::abs(value));
  return most;
}

TEST(Eq40Eq43LoadedDissipation, LeavesABodyAloneThatHasTurnedOrIsStrainedOnAGridThatBends) {
  const double angle = 40 * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  for (const Tensor2& F : {Tensor2{c, -s, s, c}, Tensor2{1.3, 0.4, -0.2, 0.8}}) {
    Body body(test::grid_of(test::fan, 8), {});  // loads on all sides
    body.assign([&](double x, double y) {
      return SolidState{
          .u = {(F.a11 - 1) * x + F.a12 * y, F.a21 * x + (F.a22 - 1) * y}, .v = Vec2::Zero(), .P = {}};
    });
    EXPECT_LT(squareness(body.sides.at(Side::bottom, 4)), 0.6);  // lines beside the sides are corrected too
    EXPECT_LT(largest(displacement_dissipation<MappedGradient4>(body, false)), 1e-15);
    EXPECT_LT(largest(displacement_dissipation<MappedGradient4>(body, true)), 1e-15);
  }
}

TEST(Eq40Eq43LoadedDissipation, TakesBackWhatWentAcrossASideAndNoMore) {
  Body body(test::grid_of(test::fan, 8),
            of_conditions({no_condition, no_condition, Traction::condition, Traction::condition}));
  const int n = body.grid.layout().n2;
  for (const bool across : {true, false}) {
    // A sawtooth of u, which central differences do not see, across the loaded sides or along them.
    for (int j = -2; j < n + 2; ++j) {
      for (int i = -2; i < n + 2; ++i) body.q(plane::u1, i, j) = (across ? j : i) % 2 == 0 ? 1 : -1;
    }
    const Field next = displacement_dissipation<MappedGradient4>(body, true);
    for (const int j : {0, n - 1}) {
      for (int i = 0; i < n; ++i)
        EXPECT_DOUBLE_EQ(next(plane::u1, i, j), across ? 0 : -0.25 * body.q(plane::u1, i, j));
    }
  }
}

TEST(Eq40Eq43LoadedDissipation, GivesTheNextLineAnExtrapolatedGhostPointAsFarAsCellsAreNotSquare) {
  const auto flat = [](double r, double s) -> Vec2 { return {r, 0.5 * s}; };
  Body body(test::grid_of(flat, 8),
            of_conditions({no_condition, no_condition, Traction::condition, no_condition}));
  body.assign(various);
  const Field without = displacement_dissipation<CartesianGradient4>(body, false),
              with = displacement_dissipation<CartesianGradient4>(body, true);
  const double share = 0.25 * (1 - 1.5 / 16) / 16;  // cells of 1:2
  for (int k = 0; k < 9; ++k) {
    const auto u = [&](int m) { return body.at(Side::bottom, k, m).u; };
    const std::ptrdiff_t next_line = body.sides.line(Side::bottom).at(k, 1);
    const Vec2 back = load(with.view(), next_line).u - load(without.view(), next_line).u;
    EXPECT_NEAR((back - share * (u(-1) - (u(2) + 3 * (u(0) - u(1))))).norm(), 0, 1e-16) << k;
  }
}

/// Beyond the first of four values of f at 0, 1, 2, 3.
template <class F>
double beyond(const F& f, Limiter limiter) {
  return extrapolated(f(0.0), f(1.0), f(2.0), f(3.0), limiter);
}

TEST(Extrapolation, ContinuesConstantsLinesAndParabolasWhereverTheirTopIs) {
  for (const Limiter limiter : {Limiter::none, Limiter::mc, Limiter::minmod}) {
    const auto constant = [](double) { return 0.1; };
    EXPECT_EQ(beyond(constant, limiter), 0.1);
    for (const double top : {-3.0, 0.5, 1.0, 1.7, 2.0, 2.3, 8.0}) {
      const auto parabola = [top](double x) { return 7 - 3 * (x - top) * (x - top); };
      EXPECT_NEAR(beyond(parabola, limiter), parabola(-1), 1e-13) << top;
    }
    const auto line = [](double x) { return 5 - 2 * x; };
    EXPECT_NEAR(beyond(line, limiter), line(-1), 1e-13);
  }
}

TEST(Extrapolation, IsConstantBesideAJumpWithALimiter) {
  for (const double place : {0.5, 1.5}) {
    const auto jump = [place](double x) { return x < place ? 3.0 : 1.0; };
    EXPECT_EQ(beyond(jump, Limiter::mc), 3);
    EXPECT_NE(beyond(jump, Limiter::none), 3);
  }
  const auto sawtooth = [](double x) { return std::cos(3.14159265358979 * x); };
  EXPECT_NEAR(beyond(sawtooth, Limiter::mc), 1, 1e-12);
}

}  // namespace
}  // namespace fsi::solid
