/// What tells the laws apart: one property by which each can be recognised.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "deformations.hpp"
#include "solid_solver/kernels/impedance.hpp"
#include "solid_solver/laws/gent.hpp"
#include "solid_solver/laws/linear_elastic.hpp"
#include "solid_solver/laws/mooney_rivlin.hpp"
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

/// Largest difference of P and K between two laws at a deformation.
template <class A, class B>
double difference_of_laws(const A& a, const B& b, const Mat2& F) {
  double worst = (matrix(a.P(plain(F))) - matrix(b.P(plain(F)))).norm();
  const Stiffness K = a.K(plain(F)), other = b.K(plain(F));
  for (int n = 0; n < 16; ++n) {
    const auto at = [n](const Stiffness& S) { return entry(S, n / 8, n / 4 % 2, n / 2 % 2, n % 2); };
    worst = std::max(worst, std::abs(at(K) - at(other)));
  }
  return worst;
}

TEST(MooneyRivlinLaw, IsTheNeoHookeanOneWithoutItsSecondConstant) {
  const NeoHookean neo{.lambda = lambda, .mu = mu};
  const MooneyRivlin law{.lambda = lambda, .mu = mu}, other{.lambda = lambda, .mu = mu, .c01 = 0.3};
  for (const Mat2& F : deformations()) {
    EXPECT_LE(difference_of_laws(law, neo, F), 1e-14) << F;
    if (std::abs(F.determinant() - 1) > 0.1) {
      EXPECT_GE(difference_of_laws(other, neo, F), 1e-3) << F;
    }
  }
}

/// With C33 = 1 the invariants are those of the whole C, so its energy can be written with them.
TEST(MooneyRivlinLaw, EnergyIsThatOfItsInvariantsInSpace) {
  const double c01 = 0.3, c10 = mu / 2 - c01;
  const MooneyRivlin law{.lambda = lambda, .mu = mu, .c01 = c01};
  for (const Mat2& F : deformations()) {
    Eigen::Matrix3d C = Eigen::Matrix3d::Identity();
    C.topLeftCorner<2, 2>() = F.transpose() * F;
    const double I1 = C.trace(), I2 = 0.5 * (I1 * I1 - (C * C).trace()),
                 log_J = 0.5 * std::log(C.determinant());
    const double shape = c10 * (I1 - 3) + c01 * (I2 - 3);
    const double area = -(2 * c10 + 4 * c01) * log_J + 0.5 * (lambda - 4 * c01) * log_J * log_J;
    EXPECT_NEAR(law.psi(plain(F)), shape + area, 1e-13);
  }
}

/// An incompressible Mooney-Rivlin block in plane strain is a neo-Hookean one: P = mu (F^T - p F^-1).
TEST(MooneyRivlinLaw, KeepsTheShearStressOfANeoHookeanSolidWhereAreasDoNotChange) {
  const MooneyRivlin law{.lambda = 100 * mu, .mu = mu, .c01 = 0.25 * mu};
  for (const double shear : {0.1, 1.0, 5.0}) {
    const Mat2 F = (Mat2() << 1.0, shear, 0.0, 1.0).finished();
    const Mat2 sigma = F * matrix(law.P(plain(F)));
    EXPECT_NEAR(sigma(0, 1), mu * shear, 1e-12);
    EXPECT_NEAR(sigma(0, 0) - sigma(1, 1), mu * shear * shear, 1e-12);  // Rivlin's universal relation
  }
}

TEST(GentLaw, TendsToTheNeoHookeanOneAsItsLockingGoesToInfinity) {
  const NeoHookean neo{.lambda = lambda, .mu = mu};
  const auto distance = [&](const Mat2& F, double J_m) {
    return difference_of_laws(Gent{.lambda = lambda, .mu = mu, .J_m = J_m}, neo, F);
  };
  for (const Mat2& F : deformations()) {
    if ((F.transpose() * F - Mat2::Identity()).norm() < 1e-12) continue;  // there they are one at once
    EXPECT_NEAR(distance(F, 1e4) / distance(F, 2e4), 2, 1e-3);
    EXPECT_LE(distance(F, 1e12), 1e-10);
  }
}

/// Shear of J_m = 4 locks at an angle of arctan 2: I1 - 3 is the square of the shear.
TEST(GentLaw, GrowsWithoutBoundUpToItsLockingStretchAndEndsThere) {
  const Gent law{.lambda = lambda, .mu = mu, .J_m = 4};
  const auto at = [](double shear) -> Tensor2 { return {1.0, shear, 0.0, 1.0}; };
  double psi = law.psi(at(2 - 1e-2)), stress = law.P(at(2 - 1e-2)).a21;
  for (const double rest : {1e-4, 1e-6}) {
    const Tensor2 F = at(2 - rest);
    EXPECT_NEAR(law.P(F).a21 / stress, 100, 1);  // as one over the distance
    EXPECT_GT(law.psi(F), psi + 1);
    psi = law.psi(F), stress = law.P(F).a21;
  }
  for (const double beyond : {2.0, 2.1, 50.0}) {
    EXPECT_TRUE(std::isnan(law.psi(at(beyond))));
    EXPECT_TRUE(std::isnan(law.P(at(beyond)).a21));
    EXPECT_TRUE(std::isnan(law.K(at(beyond)).k1221));
  }
  EXPECT_TRUE(std::isnan(law.P({-0.5, 0.0, 0.0, 1.0}).a11));
}

/// The stiffening acts along the stretch: waves stay real all the way, and become fast.
TEST(GentLaw, IsHyperbolicUpToItsLockingStretch) {
  const Gent law{.lambda = lambda, .mu = mu, .J_m = 4};
  for (const double shear : {0.0, 1.0, 1.9, 1.999}) {
    const Stiffness K = law.K({1.0, shear, 0.0, 1.0});
    for (const double angle : {0.0, 0.4, 0.9, 1.57, 2.2, 2.9}) {
      const SymmetricTensor2 B = acoustic_matrix(K, {std::cos(angle), std::sin(angle)});
      EXPECT_GT(B.a11, 0);
      EXPECT_GT(B.a11 * B.a22 - B.a12 * B.a12, 0);
    }
  }
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
