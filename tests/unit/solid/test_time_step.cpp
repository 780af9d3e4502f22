// The time step sits on the boundary of the stability ellipse.

#include <gtest/gtest.h>

#include <complex>

#include "solid_solver/kernels/impedance.hpp"
#include "solid_solver/kernels/sweep/sweep_rows.hpp"
#include "solid_solver/laws/linear_elastic.hpp"
#include "solid_solver/laws/neo_hookean.hpp"
#include "solid_solver/laws/saint_venant_kirchhoff.hpp"
#include "solid_solver/time_step.hpp"

namespace fsi::solid {
namespace {

TEST(Eq45TimeStep, ReachesTheEllipseExactly) {
  for (const double beta : {0.0, 0.3, 1.5}) {
    for (const double real : {0.0, -2.0, -40.0}) {
      const TimeSteppingEigenvalue lambda = {.real = real, .imaginary = 25.0, .beta = beta};
      const double dt = largest_time_step(lambda);
      const std::complex<double> z(real * dt - beta, lambda.imaginary * dt);
      EXPECT_GT(dt, 0);
      EXPECT_NEAR(std::norm(std::complex<double>(z.real() / 2, z.imag())), 1.0,
                  1e-13);  // round-off of a square root
    }
  }
}

TEST(Eq45TimeStep, IsTheCourantLimitWithoutDissipation) {
  EXPECT_DOUBLE_EQ(largest_time_step({.real = 0, .imaginary = 40, .beta = 0}), 1.0 / 40);
}

TEST(Eq45TimeStep, IsZeroWhenDissipationAloneIsUnstable) {
  EXPECT_EQ(largest_time_step({.real = 0, .imaginary = 1, .beta = 2}), 0);
}

TEST(Eq44Eigenvalue, EveryRateAndEveryScaledPartShortensTheStep) {
  const double free = largest_time_step(time_stepping_eigenvalue(10, {}));
  for (const SolidOptions& options :
       {SolidOptions{.tangential_stress = {.rate = 3}}, SolidOptions{.tangential_stress = {.scaled = 0.5}},
        SolidOptions{.displacement = {.rate = 3}}, SolidOptions{.displacement = {.scaled = 0.5}},
        SolidOptions{.relaxation = {.rate = 3}}, SolidOptions{.relaxation = {.scaled = 0.5}},
        SolidOptions{.bulk_diffusion = 1}}) {
    const TimeSteppingEigenvalue lambda = time_stepping_eigenvalue(10, options);
    EXPECT_LE(lambda.real, 0);
    EXPECT_LT(largest_time_step(lambda), free);
  }
}

/// The largest eigenvalue of the upwinding of the stress by power iteration of sum K Z^-1 n^T |grad r|, with
/// Z by its own definition, Z^2 = A.
template <class L>
double upwind_rate(const L& law, const Tensor2& F, double r1, double r2) {
  const Stiffness K = law.K(F);
  const SymmetricTensor2 Z1 = impedance_matrix(K, Vec2(1, 0), 1, 1),
                         Z2 = impedance_matrix(K, Vec2(0, 1), 1, 1);
  const auto solve = [](const SymmetricTensor2& Z, double f1, double f2) -> Vec2 {
    const double det = Z.a11 * Z.a22 - Z.a12 * Z.a12;
    return {(Z.a22 * f1 - Z.a12 * f2) / det, (Z.a11 * f2 - Z.a12 * f1) / det};
  };
  Tensor2 P = {1, 0.3, 0.2, -0.6};
  double rate = 0;
  for (int iteration = 0; iteration < 2000; ++iteration) {
    const Vec2 v1 = r1 * solve(Z1, P.a11, P.a12), v2 = r2 * solve(Z2, P.a21, P.a22);
    const Tensor2 next = contract(K, {v1.x(), v2.x(), v1.y(), v2.y()});
    rate = std::sqrt((next.a11 * next.a11 + next.a12 * next.a12 + next.a21 * next.a21 + next.a22 * next.a22) /
                     (P.a11 * P.a11 + P.a12 * P.a12 + P.a21 * P.a21 + P.a22 * P.a22));
    P = {next.a11 / rate, next.a12 / rate, next.a21 / rate, next.a22 / rate};
  }
  return rate;
}

template <class L>
class Eq45DecayStep : public testing::Test {};
using Laws = testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(Eq45DecayStep, Laws);

TYPED_TEST(Eq45DecayStep, BoundsTheUpwindingOfTheStressFromAboveAndWithinAQuarter) {
  const TypeParam law{.lambda = 1, .mu = 1};
  for (const Tensor2& F : {Tensor2{1, 0, 0, 1}, Tensor2{1.3, 0, 0, 1}, Tensor2{1, 0.4, 0, 1}}) {
    for (const double aspect : {0.125, 1.0, 4.0, 64.0}) {
      const Stiffness K = law.K(F);
      const SymmetricTensor2 A1 = {K.k1111, K.k1121, K.k1221},
                             A2 = {aspect * aspect * K.k2112, aspect * aspect * K.k2122,
                                   aspect * aspect * K.k2222};
      const Tensor2 N = {aspect * K.k1112, aspect * K.k1122, aspect * K.k2121, aspect * K.k1222};
      const Pair phi1 = wave_eigenvalues(A1), phi2 = wave_eigenvalues(A2);
      const double a = std::sqrt(phi1.x), b = std::sqrt(phi2.x);
      const double bound = 0.5 * (a + b + std::sqrt((a - b) * (a - b) + 4 * shared_upwinding(A1, A2, N)));
      const double exact = upwind_rate(law, F, 1, aspect);
      EXPECT_GE(bound, exact * (1 - 1e-12)) << aspect;
      EXPECT_LE(bound, 1.26 * exact) << aspect;
    }
  }
}

TEST(Eq45DecayStepLimit, LeavesASawtoothTheAmplificationMinusOne) {
  const SolidOptions options = {.tangential_stress = {.rate = 2, .scaled = 0.4},
                                .relaxation = {.rate = 3, .scaled = 0.5},
                                .bulk_diffusion = 0.25};
  const double dt = largest_decay_step({.velocity = 20, .stress = 18}, options);
  const double decay =
      2 * 18 * dt + options.relaxation.at(dt) + 0.5 * options.tangential_stress.at(dt) + 8 * 0.25 * dt;
  EXPECT_NEAR(1 - decay, -1, 1e-14);
  EXPECT_DOUBLE_EQ(largest_decay_step({.velocity = 20, .stress = 18}, {}), 1.0 / 20);
}

}  // namespace
}  // namespace fsi::solid
