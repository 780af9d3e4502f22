/// Half a step of prediction and the update from fluxes, by what the gas must do whatever the grid does.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include "tests/unit/fluid/rows.hpp"

namespace fsi::fluid {
namespace {

using namespace test;

/// Gas with a linear density, velocity and pressure on the sheared grid: q = q_0 + gradient . x.
struct LinearGas {
  double rho_0 = 1.2, p_0 = 0.9;
  Vec2 v_0{0.4, -0.3}, rho_x{0.05, -0.08}, p_x{0.03, 0.02};
  Mat2 v_x{{0.02, -0.05}, {0.04, 0.03}};

  Field on(const Field& x) const {
    Field q(Layout(n1, n2), 4);
    for (int j = -2; j < n2 + 2; ++j) {
      for (int i = -2; i < n1 + 2; ++i) {
        const Vec2 at(x(0, i, j), x(1, i, j)), v = v_0 + v_x * at;
        q(0, i, j) = rho_0 + rho_x.dot(at);
        q(1, i, j) = v.x();
        q(2, i, j) = v.y();
        q(3, i, j) = p_0 + p_x.dot(at);
      }
    }
    return q;
  }
};

/// Predicted states of row 3 at the four faces, and their means: the centre at half time.
struct Prediction {
  Scratch scratch;
  PredictedRows rows;
  explicit Prediction(const LinearGas& gas, const ShearedGrid& grid)
      : rows{state(), state(), state(), state(), scratch.row()} {
    const Field old = grid.at(0), now = grid.at(dt), q = gas.on(old);
    const MetricRow metric = scratch.metric();
    metric_row(PointRows(old.view(), 3), PointRows(now.view(), 3), dt, metric, {0, n1});
    predict_row<LimiterMinmod>(StateRows(q.view(), 3), MappedMetric{metric}, 1.4, rows, {0, n1});
  }
  StateRow<double> state() { return {scratch.row(), scratch.row(), scratch.row(), scratch.row()}; }
  std::array<double, 4> centre(int i) const {
    const auto mean = [&](double* StateRow<double>::*c) {
      return 0.25 * ((rows.left.*c)[i] + (rows.right.*c)[i] + (rows.lower.*c)[i] + (rows.upper.*c)[i]);
    };
    return {mean(&StateRow<double>::rho), mean(&StateRow<double>::v1), mean(&StateRow<double>::v2),
            mean(&StateRow<double>::p)};
  }
};

TEST(Eq1Prediction, PointsThatGoWithTheGasSeeItsVolumeEntropyAndForces) {
  // A grid that moves with the gas at point i: there only compression
  // and the gradient of p act (Lagrange's view).
  for (const int i : {2, 5}) {
    LinearGas gas;
    ShearedGrid grid;
    const Vec2 at = i * grid.along_r1 + 3 * grid.along_r2;
    grid.velocity = gas.v_0 + gas.v_x * at;
    const double rho = gas.rho_0 + gas.rho_x.dot(at), p = gas.p_0 + gas.p_x.dot(at);
    const Prediction half(gas, grid);
    const auto [rho_h, v1_h, v2_h, p_h] = half.centre(i);
    const double divergence = gas.v_x.trace();
    EXPECT_NEAR(rho_h / rho, 1 - 0.5 * dt * divergence, 1e-14);                   // mass
    EXPECT_NEAR((p_h - p) / (rho_h - rho), 1.4 * p / rho, 1e-10);                 // entropy: dp = a^2 drho
    EXPECT_NEAR(v1_h - grid.velocity.x(), -0.5 * dt * gas.p_x.x() / rho, 1e-15);  // Newton
    EXPECT_NEAR(v2_h - grid.velocity.y(), -0.5 * dt * gas.p_x.y() / rho, 1e-15);
    EXPECT_EQ(half.rows.first_order[i], 0);
  }
}

TEST(Eq1Prediction, IsTheSameAtAPlaceWhateverTheVelocityOfTheGrid) {
  // The point of a grid that moves away sees the field where it is then: q + (w dt / 2) . grad q.
  const LinearGas gas;
  ShearedGrid grid;
  grid.velocity = Vec2::Zero();
  const Prediction rest(gas, grid);
  const Vec2 w(0.8, -0.5);
  grid.velocity = w;
  const Prediction moving(gas, grid);
  const Vec2 way = 0.5 * dt * w, change = gas.v_x * way;
  for (int i = 0; i < n1; ++i) {
    const auto a = rest.centre(i), b = moving.centre(i);
    EXPECT_NEAR(b[0] - a[0], gas.rho_x.dot(way), 1e-15);
    EXPECT_NEAR(b[1] - a[1], change.x(), 1e-15);
    EXPECT_NEAR(b[2] - a[2], change.y(), 1e-15);
    EXPECT_NEAR(b[3] - a[3], gas.p_x.dot(way), 1e-15);
  }
}

TEST(Eq1Prediction, GoesOutToTheFacesAlongTheGridsDirections) {
  const LinearGas gas;
  const ShearedGrid grid;
  const Prediction half(gas, grid);
  const Vec2 to_right = 0.5 * grid.along_r1, to_upper = 0.5 * grid.along_r2;
  for (int i = 0; i < n1; ++i) {
    const double centre = half.centre(i)[3];
    EXPECT_NEAR(half.rows.right.p[i] - centre, gas.p_x.dot(to_right), 1e-15);
    EXPECT_NEAR(half.rows.left.p[i] - centre, -gas.p_x.dot(to_right), 1e-15);
    EXPECT_NEAR(half.rows.upper.rho[i] - half.rows.lower.rho[i], 2 * gas.rho_x.dot(to_upper), 1e-15);
  }
}

TEST(Eq31Update, WhatLeavesOnePointEntersTheNextAndNothingIsLost) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> amount(0.9, 1.1), small(-0.01, 0.01);
  Scratch scratch;
  const auto row_of = [&](std::uniform_real_distribution<double>& numbers) {
    double* row = scratch.row();
    for (int i = -1; i < n1; ++i) row[i] = numbers(random);
    return row;
  };
  const StateRow<double> old{row_of(amount), row_of(small), row_of(small), row_of(amount)};
  const auto flux_of = [&] { return FluxRow{row_of(small), row_of(small), row_of(small), row_of(small)}; };
  const FluxRow along = flux_of(), lower = flux_of(), upper = flux_of();
  const double *V_old = row_of(amount), *V = row_of(amount);
  const StateRow<double> next{scratch.row(), scratch.row(), scratch.row(), scratch.row()};
  const double thin = update_row<true>(old, {along, lower, upper}, {V_old, V}, {1.4, 0}, next, {0, n1});
  EXPECT_EQ(thin, 0);
  const auto energy = [](const StateRow<double>& q, int i) {
    return q.p[i] / 0.4 + 0.5 * q.rho[i] * (q.v1[i] * q.v1[i] + q.v2[i] * q.v2[i]);
  };
  std::array<double, 4> gained{}, crossed{};
  for (int i = 0; i < n1; ++i) {
    const std::array<double, 4> before{old.rho[i], old.rho[i] * old.v1[i], old.rho[i] * old.v2[i],
                                       energy(old, i)},
        after{next.rho[i], next.rho[i] * next.v1[i], next.rho[i] * next.v2[i], energy(next, i)};
    const std::array<double, 4> up{upper.mass[i], upper.momentum1[i], upper.momentum2[i], upper.energy[i]},
        from_below{lower.mass[i], lower.momentum1[i], lower.momentum2[i], lower.energy[i]};
    for (std::size_t k = 0; k < 4; ++k) {
      gained[k] += V[i] * after[k] - V_old[i] * before[k];
      crossed[k] += from_below[k] - up[k];
    }
  }
  // Of the faces along the row only the first and the last count.
  const std::array<double, 4> in{along.mass[-1], along.momentum1[-1], along.momentum2[-1], along.energy[-1]},
      out{along.mass[n1 - 1], along.momentum1[n1 - 1], along.momentum2[n1 - 1], along.energy[n1 - 1]};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(gained[k], crossed[k] + in[k] - out[k], 1e-14) << k;
}

}  // namespace
}  // namespace fsi::fluid
