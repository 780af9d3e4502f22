/// Density and pressure stay positive whatever meets, and nothing is lost by it.

#include <gtest/gtest.h>

#include <random>

#include "fluid_solver/kernels/riemann/riemann_split.hpp"
#include "fluid_solver/positivity.hpp"
#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

constexpr int n = 33;

/// Every point another gas: densities and pressures over four decades, streams of up to Mach 400.
StateField wild(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> decades(-4, 0), velocity(-4, 4);
  std::vector<State> states;
  for (int k = 0; k < n * n; ++k) {
    states.push_back({.rho = std::pow(10, decades(random)),
                      .v1 = velocity(random),
                      .v2 = velocity(random),
                      .p = std::pow(10, decades(random))});
  }
  return [states](double x, double y, double) {
    const auto index = [](double place) {
      const int k = static_cast<int>(std::floor(place * (n - 1) + 0.5));
      return static_cast<std::size_t>(((k % (n - 1)) + n - 1) % (n - 1));
    };
    return states[index(y) * n + index(x)];
  };
}

/// A box whose opposite sides are the same, at rest or with inner lines that swing.
grid::GridDescription box(bool moving) {
  grid::GridDescription description =
      moving ? test::wavy(n, n, {0, 0}, {1, 1}) : test::rectangle(n, n, {0, 0}, {1, 1});
  description.periodic1 = description.periodic2 = true;
  return description;
}

struct Choice {
  bool moving;
  Riemann riemann;
  Limiter limiter;
};

class WildGas : public ::testing::TestWithParam<Choice> {};

TEST_P(WildGas, StaysPositiveAndKeepsMassMomentumAndEnergy) {
  const auto [moving, riemann, limiter] = GetParam();
  const std::array<Boundary, 4> around{Periodic{}, Periodic{}, Periodic{}, Periodic{}};
  GasSolver gas = test::solver(box(moving), {.riemann = riemann, .limiter = limiter}, around, wild(7));
  test::apply(gas, 0, {});
  const Totals before = gas.totals();
  double t = 0;
  for (int step = 0; step < 60; ++step) {
    const double dt = gas.compute_time_step().dt;
    t += dt;
    gas.move_grids(t, dt);
    gas.advance_fluid(t, dt);
    test::apply(gas, t, {});
  }
  const Health health = gas.health();
  EXPECT_GT(health.min_rho, 0);
  EXPECT_GT(health.min_p, 0);
  EXPECT_EQ(health.floors, 0U);
  EXPECT_GT(health.positive_fluxes, 0U);
  EXPECT_NEAR(gas.totals().mass, before.mass, 1e-13);
  EXPECT_NEAR(gas.totals().momentum1, before.momentum1, 1e-12);
  EXPECT_NEAR(gas.totals().momentum2, before.momentum2, 1e-12);
  EXPECT_NEAR(gas.totals().energy, before.energy, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(OfAllSchemes, WildGas,
                         ::testing::Values(Choice{false, Riemann::roe, Limiter::minmod},
                                           Choice{false, Riemann::hllc, Limiter::none},
                                           Choice{true, Riemann::roe, Limiter::none},
                                           Choice{true, Riemann::hllc, Limiter::mc}));

TEST(PositiveFluxes, AreNotNeededInASmoothFlow) {
  GasSolver gas = test::solver(test::wavy(31, 31, {-3, -3}, {3, 3}), {.limiter = Limiter::none},
                               {Dirichlet{test::Vortex{}}, Dirichlet{test::Vortex{}},
                                Dirichlet{test::Vortex{}}, Dirichlet{test::Vortex{}}},
                               test::Vortex{});
  test::run(gas, 0.3);
  EXPECT_EQ(gas.health().positive_fluxes, 0U);
}

TEST(SplitFlux, IsTheFluxOfOneStateAndTakesFromEachSideWhatItsOwnFastestWaveCarries) {
  const RiemannSplit solve{1.4};
  const FaceState q{0.7, 0.3, -0.4, 1.1}, r{0.2, -1.3, 0.5, 2.0};
  for (const double g_n : {-0.8, 0.0, 1.7}) {
    const double E = q.p / 0.4 + 0.5 * q.rho * (q.u * q.u + q.v * q.v), w = q.u - g_n;
    const FaceFlux same = solve(q, q, g_n);
    EXPECT_NEAR(same.mass, q.rho * w, 1e-15);
    EXPECT_NEAR(same.normal, q.rho * w * q.u + q.p, 1e-14);
    EXPECT_NEAR(same.tangential, q.rho * w * q.v, 1e-15);
    EXPECT_NEAR(same.energy, E * w + q.p * q.u, 1e-14);
    const double fastest_q = std::fabs(w) + std::sqrt(1.4 * q.p / q.rho),
                 fastest_r = std::fabs(r.u - g_n) + std::sqrt(1.4 * r.p / r.rho);
    const FaceFlux both = solve(q, r, g_n), back = solve(r, q, g_n);
    EXPECT_NEAR(both.mass + back.mass, q.rho * w + r.rho * (r.u - g_n), 1e-14);
    EXPECT_NEAR(both.mass - back.mass, fastest_q * q.rho - fastest_r * r.rho, 1e-14);
  }
}

/// A point between donors over a jump, where the parabola through them is negative.
TEST(PositiveValues, APointThatInterpolatesBelowZeroGetsItsSmallestDonor) {
  const Layout shape(5, 5);
  Field target(shape, 4), donor(shape, 4);
  for (int plane = 0; plane < 4; ++plane) {
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 5; ++i) donor(plane, i, j) = i < 2 ? 10.0 : i == 2 ? 0.2 : 0.1;
    }
  }
  grid::InterpolationList list;
  list.target_grid = 0;
  list.donor_grid = 1;
  for (const double r : {1.5, 0.5}) {
    list.append(shape.at(r > 1 ? 1 : 2, 2), shape.at(1, 1), {.grid = 1, .i = 1, .j = 1, .r = r, .s = 1});
  }
  const std::array<FieldView, 2> fields{target.view(), donor.view()};
  grid::apply(list, fields);
  EXPECT_LT(target(0, 1, 2), 0);
  const double sound = target(0, 2, 2);
  EXPECT_GT(sound, 0);
  const double velocity = target(1, 1, 2);
  EXPECT_EQ(keep_positive(list, fields, RankRows{}), 1U);
  EXPECT_EQ(target(0, 1, 2), 0.1);
  EXPECT_EQ(target(3, 1, 2), 0.1);
  EXPECT_EQ(target(1, 1, 2), velocity);
  EXPECT_EQ(target(0, 2, 2), sound);
}

}  // namespace
}  // namespace fsi::fluid
