// Dissipation and relaxation terms, each alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solid_solver/boundary/ghost_lines.hpp"
#include "solid_solver/kernels/sweep/dissipation.hpp"
#include "solid_solver/laws/neo_hookean.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"

namespace fsi::solid {
namespace {

TEST(Eq38Dissipation, HasNormOneAndIgnoresCubics) {
  EXPECT_DOUBLE_EQ(fourth_difference(1, -1, 1, -1, 1), 1.0);
  const auto cubic = [](double x) { return 2 - x + 3 * x * x - 0.5 * x * x * x; };
  EXPECT_NEAR(fourth_difference(cubic(-2), cubic(-1), cubic(0), cubic(1), cubic(2)), 0, 1e-14);
}

/// Displacement, velocity and stress that vary along one direction only, in a sawtooth.
Field sawtooth_along(int direction, const Layout& layout) {
  Field q(layout, plane::count);
  for (int j = -2; j < layout.n2 + 2; ++j) {
    for (int i = -2; i < layout.n1 + 2; ++i) {
      const double s = (direction == 0 ? i : j) % 2 == 0 ? 1.0 : -1.0;
      store(q.view(), layout.at(i, j),
            {.u = Vec2(s, 2 * s), .v = Vec2(-s, 3 * s), .P = {s, 2 * s, 3 * s, 4 * s}});
    }
  }
  return q;
}

class Eq39Dissipation : public testing::TestWithParam<int> {};

TEST_P(Eq39Dissipation, LeavesTheTractionOnTheFacesAloneAndDampsTheRestByHalfOfBeta) {
  const int direction = GetParam();
  const grid::MovingGrid grid = test::skewed_grid(12);
  const ReferenceMetrics metrics(grid.x());
  const Field q = sawtooth_along(direction, grid.layout());
  Field next(grid.layout(), plane::count);
  for (int j = 0; j < 13; ++j) {
    add_tangential_stress_dissipation<MappedRow>(q.view(), next.view(), metrics, 0.5, {j, 0, 13});
    for (int i = 0; i < 13; ++i) {
      const PointMetrics at = metrics.at(i, j);
      const Vec2 n = (direction == 0 ? at.r1 : at.r2).normalized(), t(-n.y(), n.x());
      const Tensor2 change = load(next.view(), grid.layout().at(i, j)).P,
                    P = load(q.view(), grid.layout().at(i, j)).P;
      // n^T P belongs to waves along that direction; t^T P is damped by beta / 2 = 0.25 of its sawtooth.
      // Round-off of P = 4.
      EXPECT_NEAR(n.x() * change.a11 + n.y() * change.a21, 0, 1e-15 * 20);
      EXPECT_NEAR(n.x() * change.a12 + n.y() * change.a22, 0, 1e-15 * 20);
      EXPECT_NEAR(t.x() * change.a11 + t.y() * change.a21, -0.25 * (t.x() * P.a11 + t.y() * P.a21), 1e-14);
      EXPECT_NEAR(t.x() * change.a12 + t.y() * change.a22, -0.25 * (t.x() * P.a12 + t.y() * P.a22), 1e-14);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothHalves, Eq39Dissipation, testing::Values(0, 1),
                         [](const auto& direction) { return direction.param == 0 ? "AlongR1" : "AlongR2"; });

TEST(Eq40Dissipation, DampsASawtoothOfTheDisplacementAlongEitherDirection) {
  const auto check = [&]<class Gradient>(const grid::MovingGrid& grid) {
    const ReferenceMetrics metrics(grid.x());
    const Gradient gradient(grid.x(), metrics, 4);
    for (const int direction : {0, 1}) {
      const Field q = sawtooth_along(direction, grid.layout());
      Field next(grid.layout(), plane::count);
      add_displacement_dissipation(q.view(), next.view(), gradient, 0.5, {4, 0, 13});
      for (int i = 0; i < 13; ++i) {
        EXPECT_DOUBLE_EQ(next(plane::u1, i, 4),
                         -0.25 * q(plane::u1, i, 4));  // half of beta: one of two directions
        EXPECT_DOUBLE_EQ(next(plane::u2, i, 4), -0.25 * q(plane::u2, i, 4));
        EXPECT_EQ(next(plane::P11, i, 4), 0);
      }
    }
  };
  check.operator()<CartesianGradient4>(test::unit_square(12));
  check.operator()<MappedGradient4>(test::skewed_grid(12));  // a sawtooth has no central differences
}

/// Paper eq. (40) as it is added while a step is made, and in a pass of its own, at all points: largest of a component.
struct DisplacementDissipation {
  double at_once = 0, alone = 0;
};
template <class Row, class Gradient>
DisplacementDissipation of_displacement(const grid::MovingGrid& grid, const Field& q) {
  const ReferenceMetrics metrics(grid.x());
  const Layout& layout = grid.layout();
  Field next(layout, plane::count);
  DisplacementDissipation most;
  for (int j = 0; j < layout.n2; ++j) {
    const Gradient gradient(grid.x(), metrics, j);
    add_displacement_dissipation(q.view(), next.view(), gradient, 0.5, {j, 0, layout.n1});
    const AllDissipation all(q.view(), Row(metrics, j), gradient, NeoHookean{.lambda = 1, .mu = 1},
                             {.P = 0.5, .u = 0.5, .r = 0.5}, j);
    for (int i = 0; i < layout.n1; ++i) {
      const Vec2 alone = load(next.view(), layout.at(i, j)).u;
      const auto at_once = all.at(i);
      EXPECT_NEAR(-alone.x(), at_once.u1,
                  1e-17);  // the same to the bit, as far as compilers put products together alike
      EXPECT_NEAR(-alone.y(), at_once.u2, 1e-17);
      most.alone = std::max({most.alone, std::abs(alone.x()), std::abs(alone.y())});
      most.at_once = std::max({most.at_once, std::abs(at_once.u1), std::abs(at_once.u2)});
    }
  }
  return most;
}

/// u = (F - 1) x everywhere.
Field linear_displacement(const grid::MovingGrid& grid, const Tensor2& F) {
  const Layout& layout = grid.layout();
  Field q(layout, plane::count);
  for (int j = -2; j < layout.n2 + 2; ++j) {
    for (int i = -2; i < layout.n1 + 2; ++i) {
      const double x = grid.x()(0, i, j), y = grid.x()(1, i, j);
      store(q.view(), layout.at(i, j),
            {.u = {(F.a11 - 1) * x + F.a12 * y, F.a21 * x + (F.a22 - 1) * y}, .v = Vec2::Zero(), .P = {}});
    }
  }
  return q;
}

TEST(Eq40Dissipation, LeavesALinearDisplacementAloneHoweverGridLinesBend) {
  const grid::MovingGrid fan = test::grid_of(test::fan, 8);
  const double angle = 40 * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  for (const Tensor2& F : {Tensor2{c, -s, s, c}, Tensor2{1.3, 0.4, -0.2, 0.8}}) {
    const Field q = linear_displacement(fan, F);
    const DisplacementDissipation most = of_displacement<MappedRow, MappedGradient4>(fan, q);
    EXPECT_LT(most.at_once, 1e-15);
    EXPECT_LT(most.alone, 1e-15);
    // Without the positions' own differences it would not.
    EXPECT_GT((of_displacement<MappedRow, CartesianGradient4>(fan, q).alone), 1e-4);
  }
}

TEST(Eq40Dissipation, IsThatOfThePaperOnACartesianGrid) {
  const grid::MovingGrid square = test::unit_square(12);
  const ReferenceMetrics metrics(square.x());
  Field q(square.layout(), plane::count), next(square.layout(), plane::count);
  for (int j = -2; j < 15; ++j) {
    for (int i = -2; i < 15; ++i) {
      q(plane::u1, i, j) = std::sin(1.3 * i + 0.4 * j * j);
      q(plane::u2, i, j) = std::cos(0.7 * i * j - 0.2 * i);
    }
  }
  add_displacement_dissipation(q.view(), next.view(), CartesianGradient4(square.x(), metrics, 5), 0.5,
                               {5, 0, 13});
  for (const int k : {plane::u1, plane::u2}) {
    const WideRow u(q.view(), k, 5);
    for (int i = 0; i < 13; ++i) EXPECT_EQ(next(k, i, 5), -0.25 * (u.fourth(i).x + u.fourth(i).y));
  }
}

TEST(Eq41Relaxation, PullsTheStressOntoTheLaw) {
  const grid::MovingGrid grid = test::skewed_grid(12);
  const ReferenceMetrics metrics(grid.x());
  const NeoHookean law{.lambda = 1.2, .mu = 0.8};
  Field q(grid.layout(), plane::count), next(grid.layout(), plane::count);
  const Tensor2 F = {1.1, 0.2, -0.1, 0.95}, wrong = {0.3, -0.2, 0.5, 0.1};
  for (int j = -2; j < 15; ++j) {
    for (int i = -2; i < 15; ++i) {
      const double x = grid.x()(0, i, j), y = grid.x()(1, i, j);
      const SolidState s = {
          .u = {(F.a11 - 1) * x + F.a12 * y, F.a21 * x + (F.a22 - 1) * y}, .v = Vec2::Zero(), .P = wrong};
      store(q.view(), grid.layout().at(i, j), s);
      store(next.view(), grid.layout().at(i, j), s);
    }
  }
  const Tensor2 right = law.P(F);
  const MappedGradient4 gradient(grid.x(), metrics, 6);
  add_relaxation(q.view(), next.view(), gradient, law, 1.0, {6, 0, 13});
  for (int i = 0; i < 13; ++i) {
    EXPECT_NEAR(next(plane::P11, i, 6), right.a11, 1e-12);  // differences of u amplify round-off by 1/h
    EXPECT_NEAR(next(plane::P12, i, 6), right.a12, 1e-12);
    EXPECT_NEAR(next(plane::P21, i, 6), right.a21, 1e-12);
    EXPECT_NEAR(next(plane::P22, i, 6), right.a22, 1e-12);
  }
}

TEST(BulkDiffusion, LeavesLinearFieldsAlone) {
  const Layout layout(8, 8);
  Field q(layout, plane::count), next(layout, plane::count);
  for (int j = -2; j < 10; ++j) {
    for (int i = -2; i < 10; ++i) q(plane::v1, i, j) = 3 + 2 * i - 5 * j;
  }
  add_bulk_diffusion(q.view(), next.view(), 0.1, {3, 0, 8});
  for (int i = 0; i < 8; ++i) EXPECT_EQ(next(plane::v1, i, 3), 0);
}

/// Largest ratio of what is left of a sawtooth of v or P after
/// a step of bulk diffusion, over all interior points.
double left_of(const Field& q, double factor) {
  const Layout& layout = q.layout();
  Field next(layout, plane::count);
  std::ranges::copy(q.values(), next.values().begin());
  for (int j = 0; j < layout.n2; ++j) add_bulk_diffusion(q.view(), next.view(), factor, {j, 0, layout.n1});
  double most = 0;
  for (int k = plane::v1; k <= plane::P22; ++k) {
    for (int j = 0; j < layout.n2; ++j) {
      for (int i = 0; i < layout.n1; ++i) most = std::max(most, next(k, i, j) / q(k, i, j));
    }
  }
  return most;
}

TEST(BulkDiffusion, DampsASawtoothAlongEitherDirectionAndCancelsItAtAQuarter) {
  for (const int direction : {0, 1}) {
    const Field q = sawtooth_along(direction, Layout(8, 8));
    EXPECT_NEAR(left_of(q, 0.01), 1 - 4 * 0.01, 1e-15);  // the undivided second difference of +-1 is -+4
    EXPECT_NEAR(left_of(q, 0.25), 0, 1e-15);
  }
}

TEST(BulkDiffusion, MovesValuesWithoutMakingOrLosingAny) {
  const Layout layout(9, 9);
  Field q(layout, plane::count), next(layout, plane::count);
  q(plane::P12, 4, 4) = 1;
  for (int j = 0; j < 9; ++j) add_bulk_diffusion(q.view(), next.view(), 0.1, {j, 0, 9});
  EXPECT_DOUBLE_EQ(next(plane::P12, 4, 4), -0.4);
  for (const auto& [i, j] : {std::pair{3, 4}, {5, 4}, {4, 3}, {4, 5}})
    EXPECT_DOUBLE_EQ(next(plane::P12, i, j), 0.1);
  double sum = 0, others = 0;
  for (int k = 0; k < plane::count; ++k) {
    for (int j = 0; j < 9; ++j) {
      for (int i = 0; i < 9; ++i) (k == plane::P12 ? sum : others) += next(k, i, j);
    }
  }
  EXPECT_NEAR(sum, 0, 1e-15);
  EXPECT_EQ(others, 0);
}

TEST(BulkDiffusion, LeavesTheDisplacementAlone) {
  const Field q = sawtooth_along(0, Layout(8, 8));
  Field next(q.layout(), plane::count);
  for (int j = 0; j < 8; ++j) add_bulk_diffusion(q.view(), next.view(), 0.1, {j, 0, 8});
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(next(plane::u1, i, 3), 0);
    EXPECT_EQ(next(plane::u2, i, 3), 0);
  }
}

}  // namespace
}  // namespace fsi::solid
