/// What every constitutive law must do, whatever it is. The
/// list of laws is made when the build is configured.

#include <gtest/gtest.h>

#include <algorithm>

#include "deformations.hpp"

namespace fsi::solid::testing {
namespace {

template <class L>
class EveryLaw : public ::testing::Test {
 protected:
  const L law_ = typical<L>(1.7, 0.9);

  double psi(const Mat2& F) const { return law_.psi(plain(F)); }
  Mat2 P(const Mat2& F) const { return matrix(law_.P(plain(F))); }
  Stiffness K(const Mat2& F) const { return law_.K(plain(F)); }
};

TYPED_TEST_SUITE(EveryLaw, EveryLawTested);

TYPED_TEST(EveryLaw, Eq7StressIsTheGradientOfTheEnergy) {
  for (const Mat2& F : deformations()) {
    const Mat2 P = this->P(F);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        const double slope = difference([&](const Mat2& G) { return this->psi(G); }, F, j, i, step);
        EXPECT_NEAR(P(i, j), slope, difference_error) << "F =\n" << F << "\nentry " << i << j;
      }
    }
  }
}

TYPED_TEST(EveryLaw, Eq5StiffnessIsTheGradientOfTheStressInAllSixteenEntries) {
  for (const Mat2& F : deformations()) {
    const Stiffness K = this->K(F);
    for (int k = 0; k < 2; ++k) {
      for (int l = 0; l < 2; ++l) {
        const Mat2 slope = difference([&](const Mat2& G) { return this->P(G); }, F, k, l, step);
        for (int i = 0; i < 2; ++i) {
          for (int j = 0; j < 2; ++j) {
            EXPECT_NEAR(entry(K, i, j, k, l), slope(i, j), difference_error)
                << "F =\n"
                << F << "\nentry " << i << j << k << l;
          }
        }
      }
    }
  }
}

TYPED_TEST(EveryLaw, Eq8StressDifferencesHaveTheMajorSymmetryOfASecondDerivative) {
  for (const Mat2& F : deformations()) {
    const auto slope = [&](int i, int j, int k, int l) {
      const Mat2 D = difference([&](const Mat2& G) { return this->P(G); }, F, k, l, step);
      return D(i, j);
    };
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        for (int k = 0; k < 2; ++k) {
          for (int l = 0; l < 2; ++l) EXPECT_NEAR(slope(i, j, k, l), slope(l, k, j, i), difference_error);
        }
      }
    }
  }
}

TYPED_TEST(EveryLaw, RestStateIsFreeOfStressAndEnergy) {
  EXPECT_EQ(this->psi(Mat2::Identity()), 0.0);
  EXPECT_EQ(this->P(Mat2::Identity()).norm(), 0.0);
}

TYPED_TEST(EveryLaw, Eq11IsTheLimitOfSmallStrainToSecondOrder) {
  const Mat2 H = (Mat2() << 0.6, -0.8, 0.3, -0.5).finished();
  const double lambda = this->law_.lambda;
  const double mu = this->law_.mu;
  const auto distance = [&](double size) {
    const Mat2 E = 0.5 * size * (H + H.transpose());
    const Mat2 linear = lambda * E.trace() * Mat2::Identity() + 2.0 * mu * E;
    const Mat2 P = this->P(Mat2::Identity() + size * H);
    return (P - linear).norm();
  };
  const double coarse = distance(1e-3);
  const double fine = distance(5e-4);
  EXPECT_LE(coarse, 1e-5);
  // A quarter up to the next term of the series, relative size 1e-3; both are zero for the linear law itself.
  EXPECT_NEAR(fine, 0.25 * coarse, 5e-3 * coarse + 1e-15);
}

TYPED_TEST(EveryLaw, Eq7ARigidTurnGoesUnnoticedExactlyWhereTheLawIsObjective) {
  double difference_of_energy = 0;
  double difference_of_stress = 0;
  double asymmetry = 0;  // of the Cauchy stress F P / J: a torque on a point
  for (const Mat2& F : deformations()) {
    const Mat2 P = this->P(F);
    const Mat2 sigma = F * P / F.determinant();
    asymmetry = std::max(asymmetry, std::abs(sigma(0, 1) - sigma(1, 0)));
    for (const double angle : {0.3, 1.9, -2.7}) {
      const Mat2 Q = rotation(angle);
      const Mat2 turned = this->P(Q * F);
      difference_of_energy = std::max(difference_of_energy, std::abs(this->psi(Q * F) - this->psi(F)));
      difference_of_stress = std::max(difference_of_stress, (turned - P * Q.transpose()).norm());
    }
  }
  const double rounding = 1e-13;  // a few operations on numbers of order one
  EXPECT_EQ(TypeParam::objective, difference_of_energy < rounding) << difference_of_energy;
  EXPECT_EQ(TypeParam::objective, difference_of_stress < rounding) << difference_of_stress;
  EXPECT_EQ(TypeParam::objective, asymmetry < rounding) << asymmetry;
}

TYPED_TEST(EveryLaw, EnergyIsPositiveNearRestExceptForRigidMotion) {
  for (const Mat2& F : deformations()) {
    const Mat2 close = Mat2::Identity() + 0.1 * (F - Mat2::Identity());
    if ((close.transpose() * close - Mat2::Identity()).norm() < 1e-2) continue;
    EXPECT_GT(this->psi(close), 0.0);
  }
}

}  // namespace
}  // namespace fsi::solid::testing
