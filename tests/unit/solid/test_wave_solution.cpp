// The Riemann problem of a face against the relations it comes from.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "solid_solver/kernels/riemann.hpp"

namespace fsi::solid {
namespace {

const SymmetricTensor2 rho_A = {.a11 = 3.1, .a12 = 0.7, .a22 = 1.2};
const FaceState left = {.v1 = 0.3, .v2 = -0.2, .f1 = 1.1, .f2 = 0.4};
const FaceState right = {.v1 = -0.1, .v2 = 0.5, .f1 = 0.2, .f2 = -0.6};

Vec2 velocity(const FaceState& s) {
  return {s.v1, s.v2};
}
Vec2 force(const FaceState& s) {
  return {s.f1, s.f2};
}

TEST(Eq34FaceProblem, LiesOnTheCharacteristicsOfBothSidesEq18) {
  const FaceState face = riemann_solution(rho_A, left, right);
  const Eigen::SelfAdjointEigenSolver<Mat2> waves(
      (Mat2() << rho_A.a11, rho_A.a12, rho_A.a12, rho_A.a22).finished());
  for (int j = 0; j < 2; ++j) {
    const Vec2 y = waves.eigenvectors().col(j);
    const double z = std::sqrt(waves.eigenvalues()[j]);
    // From the left at speed +c, from the right at speed -c; differences are round-off of a few operations.
    EXPECT_NEAR(y.dot(force(face) + z * velocity(face)), y.dot(force(right) + z * velocity(right)), 1e-14);
    EXPECT_NEAR(y.dot(force(face) - z * velocity(face)), y.dot(force(left) - z * velocity(left)), 1e-14);
  }
}

TEST(Eq34FaceProblem, KeepsEqualStates) {
  const FaceState face = riemann_solution(rho_A, left, left);
  EXPECT_EQ(velocity(face), velocity(left));
  EXPECT_EQ(force(face), force(left));
}

TEST(Eq34FaceProblem, DoesNotKnowLeftFromRightEq35) {
  // Mirrored: sides exchanged, velocities reversed, forces kept.
  const auto mirrored = [](const FaceState& s) { return FaceState{-s.v1, -s.v2, s.f1, s.f2}; };
  const FaceState face = riemann_solution(rho_A, left, right);
  const FaceState image = riemann_solution(rho_A, mirrored(right), mirrored(left));
  EXPECT_DOUBLE_EQ(image.v1, -face.v1);
  EXPECT_DOUBLE_EQ(image.v2, -face.v2);
  EXPECT_DOUBLE_EQ(image.f1, face.f1);
  EXPECT_DOUBLE_EQ(image.f2, face.f2);
}

}  // namespace
}  // namespace fsi::solid
