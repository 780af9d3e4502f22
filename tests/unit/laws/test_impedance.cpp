/// The acoustic and the impedance matrix of a boundary point, for every law.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "deformations.hpp"
#include "solid_solver/kernels/impedance.hpp"

namespace fsi::solid::testing {
namespace {

constexpr double rho = 1.3;

Mat2 matrix(const SymmetricTensor2& A) {
  return (Mat2() << A.a11, A.a12, A.a12, A.a22).finished();
}

template <class L>
class Impedance : public ::testing::Test {
 protected:
  const L law_ = typical<L>(1.7, 0.9);

  Mat2 P(const Mat2& F) const { return testing::matrix(law_.P(plain(F))); }
  Mat2 B(const Mat2& F, const Vec2& n) const { return matrix(acoustic_matrix(law_.K(plain(F)), n)); }
  Mat2 Z(const Mat2& F, const Vec2& n, double eta) const {
    return matrix(impedance_matrix(law_.K(plain(F)), n, rho, eta));
  }
  /// A few deformations at which every law is hyperbolic.
  std::vector<Mat2> moderate() const {
    const Mat2 a = (Mat2() << 1.1, 0.05, -0.1, 0.95).finished();
    const Mat2 b = rotation(0.4) * (Mat2() << 1.2, 0.1, 0.1, 1.05).finished();
    return {Mat2::Identity(), a, b};
  }
};

TYPED_TEST_SUITE(Impedance, EveryLawTested);

const Vec2 normals[] = {{1.0, 0.0}, {0.0, -1.0}, {0.6, 0.8}, {-0.28, 0.96}};

TYPED_TEST(Impedance, Eq16AcousticMatrixIsTheTractionOfAnAddedNormalGradient) {
  for (const Mat2& F : this->moderate()) {
    for (const Vec2& n : normals) {
      const Mat2 B = this->B(F, n);
      for (const Vec2& a : {Vec2(1.0, 0.0), Vec2(0.0, 1.0)}) {
        const Mat2 jump = step * a * n.transpose();
        const Vec2 ahead = this->P(F + jump).transpose() * n;
        const Vec2 behind = this->P(F - jump).transpose() * n;
        EXPECT_LE((B * a - (ahead - behind) / (2 * step)).norm(), difference_error);
      }
    }
  }
}

TYPED_TEST(Impedance, Eq16IsHyperbolicAtRestWithTheTwoElasticWaves) {
  for (const Vec2& n : normals) {
    const Mat2 B = this->B(Mat2::Identity(), n);
    const Eigen::SelfAdjointEigenSolver<Mat2> waves(B);
    EXPECT_NEAR(waves.eigenvalues()(0), this->law_.mu, 1e-14);
    EXPECT_NEAR(waves.eigenvalues()(1), this->law_.lambda + 2.0 * this->law_.mu, 1e-14);
    EXPECT_NEAR(std::abs(n.dot(waves.eigenvectors().col(1))), 1.0, 1e-14);  // the p-wave moves along n
  }
}

TYPED_TEST(Impedance, Eq23EachWaveSeesItsOwnImpedance) {
  const double eta = 0.8;
  for (const Mat2& F : this->moderate()) {
    for (const Vec2& n : normals) {
      const Eigen::SelfAdjointEigenSolver<Mat2> waves(this->B(F, n));
      const Mat2 Z = this->Z(F, n, eta);
      for (int j = 0; j < 2; ++j) {
        const Vec2 Y = waves.eigenvectors().col(j);
        const double c = std::sqrt(waves.eigenvalues()(j) / rho);
        EXPECT_LE((Z * Y - eta * rho * c * Y).norm(), 1e-13);
      }
    }
  }
}

TYPED_TEST(Impedance, TurnsWithTheBodyExactlyWhereTheLawIsObjective) {
  const Mat2 Q = rotation(1.2);
  double worst = 0;
  for (const Mat2& F : this->moderate()) {
    for (const Vec2& n : normals) {
      const Mat2 Z = this->Z(F, n, 0.9);
      worst = std::max(worst, (this->Z(Q * F, n, 0.9) - Q * Z * Q.transpose()).norm());
    }
  }
  EXPECT_EQ(TypeParam::objective, worst < 1e-13) << worst;
}

TEST(ImpedanceMatrix, IsNotANumberWhereTheSolidIsNoLongerHyperbolic) {
  const Stiffness soft{.k1111 = 1.0, .k1221 = -0.1};
  EXPECT_TRUE(std::isnan(impedance_matrix(soft, Vec2(1.0, 0.0), rho, 1.0).a11));
}

}  // namespace
}  // namespace fsi::solid::testing
