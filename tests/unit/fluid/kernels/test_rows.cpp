/// The row kernels one by one: limiters, metrics, faces, artificial
/// viscosity. Prediction and update: test_prediction.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "fluid_solver/kernels/viscous_rows.hpp"
#include "tests/unit/fluid/rows.hpp"

namespace fsi::fluid {
namespace {

using namespace test;

// --- limiters ---------------------------------------------------------------------------------------------

template <class Limiter>
class LimiterOfAnyKind : public testing::Test {};
using Limiters = testing::Types<LimiterNone, LimiterMinmod, LimiterMc, LimiterVanLeer>;
TYPED_TEST_SUITE(LimiterOfAnyKind, Limiters);

/// Pairs of differences of both signs and very different sizes.
std::vector<std::pair<double, double>> differences() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-3, 3), sign(-1, 1);
  std::vector<std::pair<double, double>> pairs;
  for (int k = 0; k < 200; ++k) {
    pairs.emplace_back(std::copysign(std::pow(10, exponent(random)), sign(random)),
                       std::copysign(std::pow(10, exponent(random)), sign(random)));
  }
  return pairs;
}

TYPED_TEST(LimiterOfAnyKind, KeepsStraightLinesAndTheSymmetriesOfTheLine) {
  for (const auto& [a, b] : differences()) {
    EXPECT_DOUBLE_EQ(TypeParam::half_slope(a, a), 0.5 * a);
    EXPECT_EQ(TypeParam::half_slope(b, a), TypeParam::half_slope(a, b));     // seen from the other end
    EXPECT_EQ(TypeParam::half_slope(-a, -b), -TypeParam::half_slope(a, b));  // upside down
  }
}

template <class Limiter>
void expect_monotone() {
  for (const auto& [a, b] : differences()) {
    const double half = Limiter::half_slope(a, b), least = std::min(std::fabs(a), std::fabs(b));
    if (a * b < 0) {
      EXPECT_EQ(half, 0) << "an extremum gets no slope";
    } else {
      EXPECT_GE(half * a, 0) << a << ", " << b;
      EXPECT_LE(std::fabs(half), least * (1 + 1e-15)) << "no face value beyond the neighbour's";
    }
  }
}

TEST(Limiters, OfTheMonotoneKindsMakeNoNewExtrema) {
  expect_monotone<LimiterMinmod>();
  expect_monotone<LimiterMc>();
  expect_monotone<LimiterVanLeer>();
}

TEST(Limiters, AreSharperInTheOrderMinmodVanLeerMc) {
  for (const auto& [a, b] : differences()) {
    if (a * b <= 0) continue;
    const double minmod = std::fabs(LimiterMinmod::half_slope(a, b)),
                 mc = std::fabs(LimiterMc::half_slope(a, b)),
                 van_leer = std::fabs(LimiterVanLeer::half_slope(a, b));
    EXPECT_LE(minmod, van_leer * (1 + 1e-15));
    EXPECT_LE(van_leer, mc * (1 + 1e-15));
    EXPECT_DOUBLE_EQ(minmod, 0.5 * std::min(std::fabs(a), std::fabs(b)));
  }
}

// --- metrics and faces ------------------------------------------------------------------------------------

TEST(Eq30Metrics, DifferentiateLinearFieldsExactlyOnAGridThatMoves) {
  const ShearedGrid grid;
  const Field old = grid.at(0), now = grid.at(dt);
  Scratch scratch;
  const MetricRow row = scratch.metric();
  metric_row(PointRows(old.view(), 3), PointRows(now.view(), 3), dt, row, {0, n1});
  const MappedMetric metric{row};
  const Vec2 g(1.3, -0.8), h(0.4, 2.1);  // gradients of two fields
  for (int i = 0; i < n1; ++i) {
    const double g_1 = g.dot(grid.along_r1), g_2 = g.dot(grid.along_r2);
    EXPECT_NEAR(metric.gradient1(i, g_1, g_2), dt * g.x(), 1e-15);
    EXPECT_NEAR(metric.gradient2(i, g_1, g_2), dt * g.y(), 1e-15);
    // div v for v = (g.x, h.x), and nothing is carried past a grid that goes with the gas
    EXPECT_NEAR(metric.divergence(i, g_1, h.dot(grid.along_r1), g_2, h.dot(grid.along_r2)),
                dt * (g.x() + h.y()), 1e-15);
    EXPECT_NEAR(metric.advect1(i, grid.velocity.x(), grid.velocity.y()), 0, 1e-15);
    EXPECT_NEAR(metric.advect2(i, grid.velocity.x(), grid.velocity.y()), 0, 1e-15);
    // v . grad f of a gas at rest, seen from the grid: -w . grad f
    EXPECT_NEAR(metric.advect1(i, 0, 0) * g_1 + metric.advect2(i, 0, 0) * g_2, -dt * g.dot(grid.velocity),
                1e-15);
    EXPECT_NEAR(metric.volume(i), grid.volume(), 1e-15);
  }
}

/// Faces around the points of row j and both volumes.
struct Cells {
  FaceRow along, lower, upper;
  double *V_old, *V;
  Cells(Scratch& scratch, const Field& old, const Field& now, int j)
      : along(scratch.faces()),
        lower(scratch.faces()),
        upper(scratch.faces()),
        V_old(scratch.row()),
        V(scratch.row()) {
    const CornerRow below = scratch.corners(), above = scratch.corners();
    for (const auto& [corners, row] : {std::pair{below, j - 1}, {above, j}}) {
      corner_row(PointRow(old.view(), row), PointRow(old.view(), row + 1), corners.x_old, corners.y_old,
                 {-1, n1});
      corner_row(PointRow(now.view(), row), PointRow(now.view(), row + 1), corners.x, corners.y, {-1, n1});
    }
    face_row_1(below, above, dt, along, {-1, n1});
    face_row_2(below, dt, lower, {0, n1});
    face_row_2(above, dt, upper, {0, n1});
    volume_row(below, above, V_old, V, {0, n1});
  }
};

TEST(Eq31Faces, OfAVolumeCloseAndSweepWhatItGrowsByOnAnyMovingGrid) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shake(-0.02, 0.02);
  const ShearedGrid grid;
  const auto shaken = [&](double t) {
    Field x = grid.at(t);
    for (double& value : x.values()) value += shake(random);
    return x;
  };
  const Field old = shaken(0), now = shaken(dt);
  Scratch scratch;
  const Cells c(scratch, old, now, 3);
  for (int i = 0; i < n1; ++i) {
    double sum_1 = 0, sum_2 = 0, swept = 0;
    const auto add = [&](const FaceRow& face, int k, double sign) {
      EXPECT_NEAR(std::hypot(face.n1[k], face.n2[k]), 1, 1e-15);
      sum_1 += sign * face.area[k] * face.n1[k];
      sum_2 += sign * face.area[k] * face.n2[k];
      swept += sign * face.area[k] * face.speed[k];  // area is dt times the face's
    };
    add(c.along, i, 1), add(c.along, i - 1, -1), add(c.upper, i, 1), add(c.lower, i, -1);
    EXPECT_NEAR(sum_1, 0, 1e-16);  // four numbers of size 0.006
    EXPECT_NEAR(sum_2, 0, 1e-16);
    EXPECT_NEAR(swept, c.V[i] - c.V_old[i], 1e-16);
    EXPECT_GT(c.V[i], 0);
  }
}

TEST(Eq31Faces, LookTowardsLargerIndicesAndGoWithTheGrid) {
  const ShearedGrid grid;
  const Field old = grid.at(0), now = grid.at(dt);
  Scratch scratch;
  const Cells c(scratch, old, now, 2);
  for (int i = 0; i < n1; ++i) {
    for (const auto& [face, along, across] : {std::tuple{c.along, grid.along_r2, grid.along_r1},
                                              std::tuple{c.upper, grid.along_r1, grid.along_r2}}) {
      const Vec2 n(face.n1[i], face.n2[i]);
      EXPECT_NEAR(n.dot(along), 0, 1e-15);
      EXPECT_GT(n.dot(across), 0);
      EXPECT_NEAR(face.area[i], dt * along.norm(), 1e-15);
      EXPECT_NEAR(face.speed[i], n.dot(grid.velocity), 1e-13);  // a difference of positions over dt
    }
    EXPECT_NEAR(c.V[i], grid.volume(), 1e-15);
  }
}

// --- artificial viscosity ---------------------------------------------------------------------------------

/// kappa along row 3 for the velocity field v = G x on a sheared grid at rest.
std::vector<double> kappa_of(const Mat2& G, Viscosity viscosity) {
  const ShearedGrid grid;
  const Field x = grid.at(0);
  Field q(Layout(n1, n2), 4);
  for (int j = -2; j < n2 + 2; ++j) {
    for (int i = -2; i < n1 + 2; ++i) {
      const Vec2 v = G * Vec2(x(0, i, j), x(1, i, j));
      q(0, i, j) = q(3, i, j) = 1;
      q(1, i, j) = v.x();
      q(2, i, j) = v.y();
    }
  }
  Scratch scratch;
  const MetricRow metric = scratch.metric();
  metric_row(PointRows(x.view(), 3), PointRows(x.view(), 3), dt, metric, {0, n1});
  double* kappa = scratch.row();
  viscosity_row(StateRows(q.view(), 3), MappedMetric{metric}, viscosity, dt, kappa, {0, n1});
  return {kappa, kappa + n1};
}

const double volume = ShearedGrid{}.volume();
const Mat2 turning{{0, -3}, {3, 0}}, shearing{{0, 2}, {0, 0}}, stretching{{1, 0}, {0, -1}};

TEST(ShockViscosity, IsOffInExpansionsAndInFlowThatKeepsItsVolume) {
  const Mat2 expansion = 0.7 * Mat2::Identity();
  for (const Mat2& G : {expansion, Mat2(expansion + shearing)}) {
    for (const double kappa : kappa_of(G, {.shock = 0.5})) EXPECT_EQ(kappa, 0);
  }
  for (const Mat2& G : {turning, shearing, stretching}) {
    for (const double kappa : kappa_of(G, {.shock = 0.5})) EXPECT_NEAR(kappa, 0, 1e-15 * volume);
  }
}

TEST(ShockViscosity, GrowsWithTheRateAtWhichTheGasIsCompressedAndNothingElse) {
  // In a step dt the volume V loses dt * rate of itself: that
  // much of it, times the coefficient, is exchanged.
  for (const double rate : {0.2, 1.0, 5.0}) {
    const Mat2 squeeze = -0.5 * rate * Mat2::Identity(), along_x{{-rate, 0}, {0, 0}},
               along_y{{0, 0}, {0, -rate}};
    for (const Mat2& G : {squeeze, along_x, along_y, Mat2(squeeze + turning), Mat2(squeeze + stretching)}) {
      for (const double kappa : kappa_of(G, {.shock = 0.5}))
        EXPECT_NEAR(kappa, 0.5 * dt * rate * volume, 1e-15);
    }
  }
}

TEST(LinearDiffusion, ActsWhereverTheGasGoes) {
  for (const Mat2& G : {Mat2(0.7 * Mat2::Identity()), turning, Mat2(-Mat2::Identity())}) {
    for (const double kappa : kappa_of(G, {.linear = 2})) EXPECT_NEAR(kappa, 2 * dt * volume, 1e-16);
  }
}

TEST(ViscousFlux, CarriesConservedQuantitiesFromWhereThereIsMore) {
  Scratch scratch;
  const auto row_of = [&](double value) {
    double* row = scratch.row();
    std::fill_n(row, n1, value);
    return row;
  };
  const ConservedRow much{row_of(3), row_of(2), row_of(-1), row_of(8)},
      little{row_of(1), row_of(2), row_of(1), row_of(5)};
  const double *some = row_of(0.1), *more = row_of(0.3);
  for (const auto& [before, after, sign] : {std::tuple{much, little, 1.0}, std::tuple{little, much, -1.0}}) {
    const FluxRow flux{row_of(0), row_of(0), row_of(0), row_of(0)};
    add_viscous_flux_row({before, after, some, more}, flux, {0, n1});
    for (int i = 0; i < n1; ++i) {
      EXPECT_NEAR(flux.mass[i], sign * 0.2 * 2, 1e-16);  // the mean of 0.1 and 0.3 times the difference
      EXPECT_NEAR(flux.momentum1[i], 0, 1e-16);
      EXPECT_NEAR(flux.momentum2[i], -sign * 0.2 * 2, 1e-16);
      EXPECT_NEAR(flux.energy[i], sign * 0.2 * 3, 1e-16);
    }
  }
}

}  // namespace
}  // namespace fsi::fluid
