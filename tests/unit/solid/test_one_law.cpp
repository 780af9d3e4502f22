// The whole solver with one law: every kind of side, both kinds of grid and every limiter, by symmetries.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "solid_solver/boundary/every_boundary.hpp"
#include "solid_solver/neo_hookean_solver.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"

namespace fsi::solid {
namespace {
using Solver = SolidSolver<NeoHookean>;

constexpr int n = 13;
const NeoHookean law{.lambda = 1.1, .mu = 0.7};

/// The unit square, turned by an angle about the origin: a Cartesian grid at 0, a mapped one elsewhere.
grid::MovingGrid turned_square(const Mat2& turn) {
  return {{.name = "square",
           .n1 = n,
           .n2 = n,
           .mapping = [turn](double r, double s, double) -> Vec2 { return turn * Vec2(r, s); }},
          0};
}

Mat2 turn_by(double angle) {
  return Mat2{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
}

/// Sides of the square, and what is given there turned with it.
using Kinds = std::array<Condition, 4>;

/// State at the points after some steps from a velocity that varies over the body.
Field moved(const Mat2& turn, const Kinds& kinds, const SolidOptions& options) {
  Boundaries boundaries;
  for (std::size_t side = 0; side < 4; ++side) {
    boundaries[side].condition = kinds[side];
    if (kinds[side] == Traction::condition) {
      boundaries[side].vector = [turn](double x, double y, double t) -> Vec2 {
        const Vec2 at = turn.transpose() * Vec2(x, y);
        return turn * Vec2(-0.02 * at.y(), 0.01 + 0.05 * t * at.x());
      };
    }
  }
  Solver solver(turned_square(turn), law, options, boundaries, 0);
  solver.assign_initial_conditions(
      [](double, double, double) -> Vec2 {
        return {0, 0};
      },
      [turn](double x, double y, double) -> Vec2 {
        const Vec2 at = turn.transpose() * Vec2(x, y);
        const double bump = at.x() * (1 - at.x()) * at.y() * (1 - at.y());
        return turn * Vec2(bump * at.x(), -2 * bump * at.y());
      });
  double t = 0;
  solver.apply_solid_bcs(t);
  for (int k = 0; k < 8; ++k) {
    const double dt = 0.01;
    solver.advance_solid(t, dt);
    t += dt;
    solver.apply_solid_bcs(t);
  }
  const ConstFieldView state = solver.state();
  Field result(state.layout, plane::count);
  for (int k = 0; k < plane::count; ++k) {
    for (int row = 0; row < n; ++row) std::copy_n(state.row(k, row), n, result.view().row(k, row));
  }
  return result;
}

/// Largest difference between a field and another one turned back.
double difference(const Field& a, const Field& b, const Mat2& turn) {
  double most = 0;
  const Layout& layout = a.layout();
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const SolidState p = load(a.view(), layout.at(i, j)), q = load(b.view(), layout.at(i, j));
      const Mat2 P{{p.P.a11, p.P.a12}, {p.P.a21, p.P.a22}}, Q{{q.P.a11, q.P.a12}, {q.P.a21, q.P.a22}};
      most = std::max({most, (p.u - turn.transpose() * q.u).norm(), (p.v - turn.transpose() * q.v).norm(),
                       (P - turn.transpose() * Q * turn).norm()});
    }
  }
  return most;
}

constexpr SolidOptions damped = {.rho = 1.3,
                                 .tangential_stress = {.rate = 0.5, .scaled = 0.1},
                                 .displacement = {.rate = 0.5, .scaled = 0.1},
                                 .relaxation = {.rate = 0.5, .scaled = 0.1},
                                 .bulk_diffusion = 0.25};

class OneLaw : public testing::TestWithParam<Kinds> {};

TEST_P(OneLaw, Eq4ATurnedBodyMovesAsTheOneThatIsNotTurned) {
  const Field straight = moved(Mat2::Identity(), GetParam(), damped);
  for (const double angle : {0.6, 2.5, 4.0}) {
    const Mat2 turn = turn_by(angle);
    EXPECT_LT(difference(straight, moved(turn, GetParam(), damped), turn), 1e-12)
        << angle;  // of stresses of 0.1
  }
}

TEST_P(OneLaw, Eq4AQuarterTurnIsNotSeenByTheLimiterEither) {
  SolidOptions limited = damped;
  const Mat2 turn{{0, -1}, {1, 0}};
  for (const Limiter limiter : {Limiter::minmod, Limiter::mc}) {
    limited.limiter = limiter;
    const Field straight = moved(Mat2::Identity(), GetParam(), limited);
    EXPECT_LT(difference(straight, moved(turn, GetParam(), limited), turn), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(
    EveryKindOfSide, OneLaw,
    testing::Values(
        Kinds{Traction::condition, Traction::condition, Traction::condition, Traction::condition},
        Kinds{Displacement::condition, Traction::condition, SlipWall::condition, Traction::condition},
        Kinds{Interface::condition, Displacement::condition, Symmetry::condition, Interface::condition},
        Kinds{SlipWall::condition, Interface::condition, Displacement::condition, Symmetry::condition},
        Kinds{Periodic::condition, Periodic::condition, Displacement::condition, Traction::condition}),
    [](const auto& kinds) { return "Set" + std::to_string(kinds.index); });

TEST(BulkDiffusion, TakesEnergyOutOfTheShortestWavesOfABodyAndLeavesItsMomentum) {
  Boundaries boundaries;
  for (Boundary& boundary : boundaries) boundary.condition = Periodic::condition;
  const auto energy_after = [&](double diffusion) {
    Solver solver(test::unit_square(16), law, {.rho = 1, .bulk_diffusion = diffusion}, boundaries, 0);
    solver.assign_initial_conditions(
        [](double, double, double) -> Vec2 {
          return {0, 0};
        },
        [](double x, double y, double) -> Vec2 {
          const long k = std::lround(16 * x) + std::lround(16 * y);
          return {k % 2 == 0 ? 0.101 : 0.099, 0};
        });
    double t = 0;
    for (int k = 0; k < 5; ++k, t += 0.005) {
      solver.advance_solid(t, 0.005);
      solver.apply_solid_bcs(t + 0.005);
    }
    double mean = 0, square = 0;
    for (int j = 0; j < 16; ++j) {
      for (int i = 0; i < 16; ++i) {
        const double v = solver.state()(plane::v1, i, j);
        mean += v / 256, square += v * v / 256;
      }
    }
    EXPECT_NEAR(mean, 0.1, 1e-15);
    return square - mean * mean;
  };
  const double none = energy_after(0), some = energy_after(4);
  EXPECT_GT(none, 0);
  // The rate of decay of v is 8 times the coefficient: exp(-2 * 8 * 4 * 0.025) = 0.20 of the energy at most.
  EXPECT_LT(some, 0.3 * none);
}

}  // namespace
}  // namespace fsi::solid
