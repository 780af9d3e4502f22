// Upwinding of the stress where K is positive and where it is not.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>

#include "common/grid/moving_grid.hpp"
#include "solid_solver/boundary/ghost_lines.hpp"
#include "solid_solver/boundary/traction_ghost.hpp"
#include "solid_solver/kernels/sweep/godunov_sweep.hpp"
#include "solid_solver/laws/neo_hookean.hpp"

namespace fsi::solid {
namespace {

const NeoHookean compressible{.lambda = 1.2, .mu = 0.8};
constexpr int last_point = 8;

/// K on all velocity gradients (dv1/dx1, dv2/dx1, dv1/dx2, dv2/dx2).
Eigen::Matrix4d whole(const Stiffness& K) {
  Eigen::Matrix4d m;
  m << K.k1111, K.k1121, K.k1112, K.k1122,  //
      K.k1121, K.k1221, K.k2121, K.k1222,   //
      K.k1112, K.k2121, K.k2112, K.k2122,   //
      K.k1122, K.k1222, K.k2122, K.k2222;
  return m;
}

/// a K b.
Tensor2 mixed(const Eigen::Matrix4d& K, const Vec2& a, const Vec2& b) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (Eigen::Index k = 0; k < 2; ++k)
    for (Eigen::Index l = 0; l < 2; ++l) sum += a[k] * b[l] * K.block<2, 2>(2 * k, 2 * l);
  return {sum(0, 0), sum(0, 1), sum(1, 0), sum(1, 1)};
}

double coupling(const Eigen::Matrix4d& K, const Vec2& a, const Vec2& b) {
  const Tensor2 A = mixed(K, a, a), B = mixed(K, b, b);
  return wave_coupling({A.a11, A.a12, A.a22}, {B.a11, B.a12, B.a22}, mixed(K, a, b));
}

TEST(WaveCoupling, IsBeyondOneWhereKIsNotPositiveWhateverTheGridEq5) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> some(-0.35, 0.35);
  int positive = 0, tried = 0;
  for (int k = 0; k < 1000; ++k) {
    const Tensor2 F = {1 + some(random), some(random), some(random), 1 + some(random)};
    const Eigen::Matrix4d K = whole(compressible.K(F));
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(K).eigenvalues().minCoeff();
    if (std::abs(least) < 1e-6) continue;
    ++tried;
    positive += least > 0 ? 1 : 0;
    for (const auto& [a, b] : {std::pair(Vec2(1, 0), Vec2(0, 1)), {Vec2(2, 0.3), Vec2(-0.4, 0.5)}})
      EXPECT_EQ(coupling(K, a, b) < 1, least > 0) << F.a11 << ' ' << F.a12 << ' ' << F.a21 << ' ' << F.a22;
  }
  EXPECT_GT(positive, tried / 5);
  EXPECT_LT(positive, tried / 5 * 4);
}

TEST(WaveCoupling, IsOneAtRestAndOfARotatedBody) {
  for (const double angle : {0.0, 0.7, 2.0}) {
    const double c = std::cos(angle), s = std::sin(angle);
    EXPECT_NEAR(coupling(whole(compressible.K({c, -s, s, c})), {1, 0}, {0.2, 1}), 1, 1e-12);
  }
}

TEST(WaveCoupling, IsFoundToBeBeyondALimitWithoutItself) {
  const Eigen::Matrix4d K = whole(compressible.K({0.8, 0.1, -0.05, 0.9}));
  const Vec2 a(1, 0.1), b(-0.2, 0.7);
  const Tensor2 A = mixed(K, a, a), B = mixed(K, b, b), N = mixed(K, a, b);
  const double exact = coupling(K, a, b);
  EXPECT_GT(exact, 1.2);
  for (const double limit : {1.0, 1.1, 0.999 * exact, 1.001 * exact, 2 * exact}) {
    EXPECT_EQ(couples_beyond(limit, {A.a11, A.a12, A.a22}, {B.a11, B.a12, B.a22}, N), exact > limit) << limit;
  }
}

TEST(WaveCoupling, ANumberThatIsNoneLeavesUpwindingAlone) {
  EXPECT_EQ(upwind_share(std::nan(""), 1.1), 1);
  EXPECT_EQ(upwind_share(1.1, 1.1), 1);
  EXPECT_LT(upwind_share(1.2, 1.1), 1);
  EXPECT_FALSE(couples_beyond(1.1, {std::nan(""), 0, 1}, {1, 0, 1}, {0, 0.5, 0.5, 0}));
}

/// One step of a square of cells that is strained by F, with `added` to the state at each point.
template <class Added>
Field step(const Tensor2& F, bool softened, double limit, const Added& added, double dt = 0.03,
           const std::array<bool, 4>& loaded = {}) {
  const grid::MovingGrid grid({.name = "block",
                               .n1 = last_point + 1,
                               .n2 = last_point + 1,
                               .mapping = [](double r, double s, double) -> Vec2 {
                                 return {r + 0.1 * s, s};
                               }},
                              0);
  const ReferenceMetrics metrics(grid.x());
  const SolidPoints points(grid.layout());
  Field q(grid.layout(), plane::count), next(grid.layout(), plane::count), work(sweep_work, 1);
  const Tensor2 P = compressible.P(F);
  for (int j = -2; j <= last_point + 2; ++j) {
    for (int i = -2; i <= last_point + 2; ++i) {
      const double x = grid.x()(0, i, j), y = grid.x()(1, i, j);
      SolidState s = {
          .u = {(F.a11 - 1) * x + F.a12 * y, F.a21 * x + (F.a22 - 1) * y}, .v = Vec2::Zero(), .P = P};
      added(i, j, Vec2(x, y), s);
      store(q.view(), grid.layout().at(i, j), s);
    }
  }
  const SweepData data{.points = &points,
                       .q = q.view(),
                       .next = next.view(),
                       .force = {},
                       .work = work.view(),
                       .rho = 1.7,
                       .dt = dt,
                       .coupling_limit = limit,
                       .softened = softened,
                       .loaded = loaded};
  GodunovSweep<NeoHookean, MappedRow, Limiter::none>(data, metrics, compressible).run();
  return next;
}

constexpr Tensor2 pressed = {0.7, 0, 0, 0.75}, pulled = {1.2, 0.1, 0, 1.1};

/// Of the stress from that of the strained body.
double largest_deviation(const Field& q, const Tensor2& F) {
  const Tensor2 P = compressible.P(F);
  double largest = 0;
  for (int j = 0; j <= last_point; ++j) {
    for (int i = 0; i <= last_point; ++i) {
      const SolidState s = load(q.view(), q.layout().at(i, j));
      for (const double d : {s.P.a11 - P.a11, s.P.a12 - P.a12, s.P.a21 - P.a21, s.P.a22 - P.a22})
        largest = std::max(largest, std::abs(d));
    }
  }
  return largest;
}

/// Of a stress that no displacement has, as of a rotation.
TEST(Eq36StressUpwinding, MakesASawtoothDecayUnderPressureWhereItWouldGrow) {
  constexpr double size = 1e-6;
  const auto sawtooth = [](int i, int j, const Vec2&, SolidState& s) {
    const double sign = ((i + j) & 1) == 0 ? size : -size;
    s.P.a12 += sign, s.P.a21 -= sign;
  };
  EXPECT_GT(largest_deviation(step(pressed, false, 1, sawtooth), pressed), 1.05 * size);
  EXPECT_LT(largest_deviation(step(pressed, true, 1, sawtooth), pressed), 0.95 * size);
  for (const auto k : {&Tensor2::a11, &Tensor2::a12, &Tensor2::a21, &Tensor2::a22}) {
    for (const auto& [along, across] : {std::pair(1, 0), {0, 1}, {1, 1}}) {
      const auto one = [=](int i, int j, const Vec2&, SolidState& s) {
        s.P.*k += ((along * i + across * j) & 1) == 0 ? size : -size;
      };
      EXPECT_LT(largest_deviation(step(pressed, true, 1, one), pressed), 0.95 * size) << along << across;
    }
  }
}

/// A uniform strain rate and a uniform gradient of the stress leave no jumps at faces.
TEST(Eq36StressUpwinding, ChangesNothingInALinearFieldUnderPressure) {
  const auto linear = [](int, int, const Vec2& x, SolidState& s) {
    s.v = {0.1 * x.x() - 0.2 * x.y(), 0.3 * x.y()};
    s.P.a11 += 0.2 * x.x(), s.P.a12 -= 0.1 * x.y(), s.P.a21 += 0.3 * x.x() + 0.1 * x.y(), s.P.a22 += 0.1;
  };
  const Field one = step(pressed, false, 1, linear), other = step(pressed, true, 1, linear);
  for (int k = 0; k < plane::count; ++k)
    for (int j = 0; j <= last_point; ++j)
      for (int i = 0; i <= last_point; ++i) EXPECT_NEAR(one.view()(k, i, j), other.view()(k, i, j), 1e-13);
}

/// The decay of a load's traction would be a push that no wave makes.
TEST(Eq36StressUpwinding, TakesNothingOfItsDecayFromTheTractionsOfLoadedSides) {
  const auto rough = [](int i, int j, const Vec2&, SolidState& s) {
    s.P.a11 += 0.01 * std::sin(7.0 * i * j + i), s.P.a12 += 0.01 * std::cos(3.0 * i + 5.0 * j);
    s.P.a21 += 0.01 * std::sin(4.0 * i - 9.0 * j), s.P.a22 += 0.01 * std::cos(8.0 * i * j);
  };
  // Normals and tangents of the lines of `step`.
  const Vec2 n1 = Vec2(1, -0.1).normalized(), n2(0, 1);
  for (int side = 0; side < 4; ++side) {
    std::array<bool, 4> loaded = {};
    loaded[static_cast<std::size_t>(side)] = true;
    const Vec2 n0 = side < 2 ? n1 : n2, t0(-n0.y(), n0.x());
    // The limit leaves no upwinding, and in so short a step, from rest, K grad v does next to nothing.
    constexpr double dt = 1e-4, no_upwinding = 1e-9;
    const Field with = step(pressed, true, no_upwinding, rough, dt),
                without = step(pressed, true, no_upwinding, rough, dt, loaded);
    double spared_by_it = 0, left = 0;
    for (int j = 0; j <= last_point; ++j) {
      for (int i = 0; i <= last_point; ++i) {
        const bool on_it = (side == 0 && i == 0) || (side == 1 && i == last_point) || (side == 2 && j == 0) ||
                           (side == 3 && j == last_point);
        const std::ptrdiff_t at = with.layout().at(i, j);
        const Tensor2 spared = minus(load(without.view(), at).P, load(with.view(), at).P);
        EXPECT_NEAR(traction_of(spared, t0).norm(), 0, 1e-14);
        if (!on_it) {
          EXPECT_EQ(traction_of(spared, n0).norm(), 0);
          continue;
        }
        SolidState before = {.u = Vec2::Zero(), .v = Vec2::Zero(), .P = compressible.P(pressed)};
        rough(i, j, Vec2::Zero(), before);
        spared_by_it += traction_of(spared, n0).norm();
        left += traction_of(minus(load(without.view(), at).P, before.P), n0).norm();
      }
    }
    EXPECT_GT(spared_by_it, 1e-6);
    EXPECT_LT(left, 0.01 * spared_by_it);
  }
}

TEST(Eq36StressUpwinding, ChangesNothingToTheBitWhereKIsPositive) {
  const auto rough = [](int i, int j, const Vec2&, SolidState& s) {
    s.v = {0.01 * std::sin(9.1 * i + 2.3 * j), 0.01 * std::cos(5.7 * i - 8.3 * j)};
    s.P.a12 += 0.01 * std::sin(7.0 * i * j);
  };
  const Field one = step(pulled, false, 1.1, rough), other = step(pulled, true, 1.1, rough);
  for (int k = 0; k < plane::count; ++k)
    for (int j = 0; j <= last_point; ++j)
      for (int i = 0; i <= last_point; ++i) EXPECT_EQ(one.view()(k, i, j), other.view()(k, i, j));
}

}  // namespace
}  // namespace fsi::solid
