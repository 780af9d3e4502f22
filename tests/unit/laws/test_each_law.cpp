/// What tells the laws apart: one property by which each can be recognised.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "deformations.hpp"
#include "solid_solver/laws/linear_elastic.hpp"
#include "solid_solver/laws/neo_hookean.hpp"
#include "solid_solver/laws/saint_venant_kirchhoff.hpp"

namespace fsi::solid::testing {
namespace {

constexpr double lambda = 1.7;
constexpr double mu = 0.9;

/// The symmetric F whose Green strain is E: F = sqrt(I + 2 E).
Mat2 stretch_of(const Mat2& E) {
  const Mat2 C = Mat2::Identity() + 2.0 * E;
  return Eigen::SelfAdjointEigenSolver<Mat2>(C).operatorSqrt();
}

TEST(Eq9SaintVenantKirchhoff, SecondStressGrowsInProportionToTheGreenStrain) {
  const SaintVenantKirchhoff law{.lambda = lambda, .mu = mu};
  const Mat2 E = (Mat2() << 0.12, -0.07, -0.07, -0.15).finished();
  const auto second_stress = [&](double size) {
    const Mat2 F = rotation(0.8) * stretch_of(size * E);
    return Mat2(matrix(law.P(plain(F))) * F.transpose().inverse());
  };
  const Mat2 S = second_stress(1.0);
  EXPECT_LE((second_stress(2.0) - 2.0 * S).norm(), 1e-14);
  EXPECT_LE((second_stress(-1.5) + 1.5 * S).norm(), 1e-14);
}

TEST(Eq9SaintVenantKirchhoff, PureStrainOfOneSignHasTheUniaxialModuli) {
  const SaintVenantKirchhoff law{.lambda = lambda, .mu = mu};
  const Mat2 E = (Mat2() << 0.5, 0.0, 0.0, 0.0).finished();
  const Mat2 F = stretch_of(E);
  const Mat2 S = matrix(law.P(plain(F))) * F.transpose().inverse();
  EXPECT_NEAR(S(0, 0), 0.5 * (lambda + 2.0 * mu), 1e-14);
  EXPECT_NEAR(S(1, 1), 0.5 * lambda, 1e-14);
}

TEST(Eq10NeoHookean, ShearStressIsProportionalToAnySimpleShear) {
  const NeoHookean law{.lambda = lambda, .mu = mu};
  for (const double shear : {0.1, 1.0, 5.0}) {
    const Mat2 F = (Mat2() << 1.0, shear, 0.0, 1.0).finished();
    const Mat2 sigma = F * matrix(law.P(plain(F)));  // J = 1
    EXPECT_NEAR(sigma(0, 1), mu * shear, 1e-13);
    EXPECT_NEAR(sigma(0, 0) - sigma(1, 1), mu * shear * shear, 1e-13);  // Rivlin's universal relation
  }
}

TEST(Eq10NeoHookean, NeedsUnboundedEnergyToBeSqueezedToNothing) {
  const NeoHookean law{.lambda = lambda, .mu = mu};
  double before = law.psi({0.5, 0.0, 0.0, 1.0});
  for (const double stretch : {1e-2, 1e-4, 1e-8, 1e-16}) {
    const double psi = law.psi({stretch, 0.0, 0.0, 1.0});
    EXPECT_GT(psi, before + 1.0);
    before = psi;
  }
}

TEST(Eq10NeoHookean, GivesNoNumberForAnInvertedElement) {
  const NeoHookean law{.lambda = lambda, .mu = mu};
  EXPECT_TRUE(std::isnan(law.P({-0.5, 0.0, 0.0, 1.0}).a11));
  EXPECT_TRUE(std::isnan(law.K({0.0, 0.0, 0.0, 1.0}).k1111));
}

TEST(Eq11LinearElastic, StressesOfTwoDisplacementsAdd) {
  const LinearElastic law{.lambda = lambda, .mu = mu};
  const Mat2 A = (Mat2() << 0.4, -0.9, 0.2, 0.3).finished();
  const Mat2 B = (Mat2() << -0.1, 0.5, 0.7, -0.6).finished();
  const auto P = [&](const Mat2& H) { return matrix(law.P(plain(Mat2::Identity() + H))); };
  EXPECT_LE((P(A + B) - P(A) - P(B)).norm(), 1e-15);
}

TEST(Eq11LinearElastic, AnInfinitesimalRotationIsFreeOfStress) {
  const LinearElastic law{.lambda = lambda, .mu = mu};
  const Mat2 W = (Mat2() << 0.0, -0.3, 0.3, 0.0).finished();
  EXPECT_EQ(matrix(law.P(plain(Mat2::Identity() + W))).norm(), 0.0);
}

}  // namespace
}  // namespace fsi::solid::testing
