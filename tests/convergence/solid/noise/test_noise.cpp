// Round-off does not grow: neither relaxation nor tangential dissipation
// makes waves unstable on cells of any aspect ratio.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>

#include "tests/convergence/solid/block_in_gas.hpp"
#include "tests/convergence/solid/noise_growth.hpp"

namespace fsi::solid {
namespace {

using test::NoiseCase;

constexpr Tensor2 at_rest = {1, 0, 0, 1}, stretched = {1.3, 0, 0, 1}, sheared = {1, 0.4, 0, 1};

template <class L>
class RoundOffNoise : public testing::Test {};
using Laws = testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(RoundOffNoise, Laws);

struct Betas {
  double P, u, r;
};

/// Those of the shipped cases, and ends of the range.
constexpr Betas betas[] = {{0.1, 0.1, 0.5}, {0.5, 0.5, 0.2}, {0, 0, 1}, {0.5, 1, 0.5}};

std::string name(const NoiseCase& noise) {
  return fmt::format("F = {}, {}, {}, {}, cells 1:{}, beta {}, {}, {}", noise.F.a11, noise.F.a12, noise.F.a21,
                     noise.F.a22, noise.aspect, noise.beta_P, noise.beta_u, noise.beta_r);
}

/// Ten thousand steps with each shape of cell and each set of betas, all sides held.
template <class L>
void expect_no_growth(const Tensor2& F) {
  for (const double aspect : {1.0, 4.0, 8.0}) {
    for (const Betas& beta : betas) {
      const NoiseCase noise = {
          .F = F, .aspect = aspect, .beta_P = beta.P, .beta_u = beta.u, .beta_r = beta.r};
      EXPECT_LT(test::growth_of_noise<L>(noise, 10000), 1.0) << name(noise);
    }
  }
}

TYPED_TEST(RoundOffNoise, DoesNotGrowAtRestEq37Eq41Eq45) {
  expect_no_growth<TypeParam>(at_rest);
}

TYPED_TEST(RoundOffNoise, DoesNotGrowInAStretchedBody) {
  expect_no_growth<TypeParam>(stretched);
}

TYPED_TEST(RoundOffNoise, DoesNotGrowInAShearedBody) {
  expect_no_growth<TypeParam>(sheared);
}

/// K is not positive there, and upwinding as in (36) alone would make a sawtooth of P grow by up to three quarters per step
/// (docs/theory_solid.md, *Solids under pressure*).
TYPED_TEST(RoundOffNoise, DoesNotGrowInABodyUnderPressureEq36) {
  for (const double aspect : {1.0, 4.0, 8.0}) {
    for (const Betas& beta : betas) {
      for (const Tensor2& F : {Tensor2{0.85, 0, 0, 0.85}, Tensor2{0.8, 0.1, 0, 1}}) {
        const NoiseCase noise = {
            .F = F, .aspect = aspect, .beta_P = beta.P, .beta_u = beta.u, .beta_r = beta.r};
        EXPECT_LT(test::growth_of_noise<TypeParam>(noise, 3000), 1.0) << name(noise);
      }
    }
  }
}

/// A third of a radian from point to point along the inner side: what (40) leaves of a linear displacement has the gradient of u, which at
/// loaded sides is that of the ghost points of (43).
TYPED_TEST(RoundOffNoise, DoesNotGrowWhereGridLinesBendEq40Eq43) {
  for (const double aspect : {0.125, 1.0, 4.0}) {
    for (const bool free : {false, true}) {
      for (const Betas& beta : {Betas{0.5, 0.5, 0.2}, Betas{0.5, 1, 0.5}}) {
        const NoiseCase noise = {.aspect = aspect,
                                 .beta_P = beta.P,
                                 .beta_u = beta.u,
                                 .beta_r = beta.r,
                                 .loaded = {false, free, free, free},
                                 .bend = 4};
        EXPECT_LT(test::growth_of_noise<TypeParam>(noise, 5000), 1.0)
            << name(noise) << (free ? ", free" : "");
      }
    }
  }
}

/// Half of its area and less is left.
TEST(RoundOffNoiseUnderPressure, DoesNotGrowInABodySqueezedFar) {
  for (const Betas& beta : betas) {
    for (const auto& [lambda, F] : {std::pair(1.0, Tensor2{0.65, 0, 0, 0.65}),
                                    {1.0, {0.4, 0, 0, 1}},
                                    {4.0, {0.74, 0, 0, 0.74}},
                                    {4.0, {0.52, 0, 0, 1}},
                                    {49.0, {0.92, 0, 0, 0.92}}}) {
      const NoiseCase noise = {
          .F = F, .lambda = lambda, .beta_P = beta.P, .beta_u = beta.u, .beta_r = beta.r};
      EXPECT_LT(test::growth_of_noise<NeoHookean>(noise, 3000), 1.0) << name(noise) << ", lambda " << lambda;
    }
  }
}

/// Where waves are coupled far beyond what so little relaxation could outweigh: 49 mu at 0.98 is under a pressure of 2 mu.
TEST(RoundOffNoiseUnderPressure, DoesNotGrowInANearlyIncompressibleBodyWithALittleRelaxation) {
  for (const double lambda : {49.0, 200.0}) {
    const NoiseCase noise = {
        .F = {0.98, 0, 0, 0.98}, .lambda = lambda, .beta_P = 0.5, .beta_u = 0.5, .beta_r = 0.05};
    EXPECT_LT(test::growth_of_noise<NeoHookean>(noise, 3000), 1.0) << lambda;
  }
}

/// A free body that a light gas squeezes: what a load makes beside a side and what it makes inside must cancel, or sides ripple.
TEST(RoundOffNoiseUnderPressure, DoesNotGrowInABlockThatALightGasSqueezesEq43) {
  for (const auto& [aspect, lambda, f] : {std::tuple(1.0, 1.0, 0.75),
                                          {1.0, 4.0, 0.85},
                                          {1.0, 9.0, 0.9},
                                          {1.0, 49.0, 0.95},
                                          {2.0, 1.0, 0.8},
                                          {2.0, 4.0, 0.9},
                                          {2.0, 9.0, 0.95},
                                          {0.5, 4.0, 0.9}}) {
    for (const double z_f : {2e-3, 0.1}) {
      for (const Limiter limiter : {Limiter::none, Limiter::mc}) {
        const NoiseCase noise = {.F = {f, 0, 0, f},
                                 .lambda = lambda,
                                 .aspect = aspect,
                                 .beta_P = 0.5,
                                 .beta_u = 0.5,
                                 .beta_r = 0.2};
        const test::Surroundings gas = {.z_f = z_f, .limiter = limiter};
        EXPECT_LT(test::growth_of_noise_in_gas<NeoHookean>(noise, gas, 1500), 1.0)
            << name(noise) << ", lambda " << lambda << ", z_f " << z_f;
      }
    }
  }
}

/// Deep cells, whose traction would decay along the side from waves that hardly know the depth.
TEST(RoundOffNoiseUnderPressure, DoesNotGrowInABlockOfDeepCellsThatALightGasSqueezes) {
  for (const auto& [lambda, f] : {std::pair(1.0, 0.85), {4.0, 0.9}, {9.0, 0.95}}) {
    const NoiseCase noise = {
        .F = {f, 0, 0, f}, .lambda = lambda, .aspect = 4, .beta_P = 0.5, .beta_u = 0.5, .beta_r = 0.2};
    EXPECT_LT(test::growth_of_noise_in_gas<NeoHookean>(noise, {.limiter = Limiter::mc}, 1500), 1.0) << lambda;
  }
}

/// Without relaxation only the dissipation of the tangential stress makes the noise of P that no wave carries decay,
/// and slowly: what is left of it stands beside the corners, and hardly moves.
TYPED_TEST(RoundOffNoise, DoesNotGrowBesideGivenDisplacementWithoutRelaxationEq18Eq39) {
  for (const double aspect : {1.0, 4.0, 8.0}) {
    for (const Betas& beta : {Betas{0.5, 0.5, 0}, Betas{1, 1, 0}}) {
      for (const Tensor2& F : {at_rest, stretched, sheared}) {
        const NoiseCase noise = {
            .F = F, .aspect = aspect, .beta_P = beta.P, .beta_u = beta.u, .beta_r = beta.r};
        EXPECT_LT(test::growth_of_noise<TypeParam>(noise, 10000), 1.0) << name(noise);
      }
    }
  }
}

/// On flat and on deep cells: there (41) with differences unlike those of (43) shakes the side.
TYPED_TEST(RoundOffNoise, DoesNotGrowBesideLoadedSidesEq41Eq43) {
  for (const double aspect : {0.125, 1.0, 4.0, 8.0}) {
    for (const Betas& beta : betas) {
      const NoiseCase noise = {.aspect = aspect,
                               .beta_P = beta.P,
                               .beta_u = beta.u,
                               .beta_r = beta.r,
                               .loaded = {false, true, true, true}};
      EXPECT_LT(test::growth_of_noise<TypeParam>(noise, 10000), 1.0) << name(noise);
    }
  }
}

/// On deep cells too, where the ghost displacement of (43) is mostly a difference along the side.
TYPED_TEST(RoundOffNoise, DoesNotGrowOfDisplacementDissipationBesideLoadedSidesEq40) {
  for (const Betas& beta : {Betas{0.1, 0.1, 0}, Betas{0.5, 0.5, 0}, Betas{0.5, 1, 0}}) {
    const NoiseCase noise = {.aspect = 8,
                             .beta_P = beta.P,
                             .beta_u = beta.u,
                             .beta_r = beta.r,
                             .loaded = {false, true, true, true}};
    EXPECT_LT(test::growth_of_noise<TypeParam>(noise, 10000), 1.0) << name(noise);
  }
}

}  // namespace
}  // namespace fsi::solid
