#include "solid_solver/boundary/robin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fsi::solid {
namespace {

TEST(RobinClosure, ExtrapolatesPolynomialsOfItsDegreeExactly) {
  const std::vector<double> t{1.0, 0.8, 0.5};
  const auto weights = lagrange_weights(t, 1.37);
  for (const int degree : {0, 1, 2}) {
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k) value += weights[k] * std::pow(t[k], degree);
    EXPECT_NEAR(value, std::pow(1.37, degree), 1e-13);
  }
}

// One point with an oblique normal and an anisotropic impedance.
class RobinPoint : public testing::Test {
 protected:
  const std::vector<double> normal{0.6, 0.8}, v{0.3, -0.1}, w{0.05, 0.02}, Z{2.0, 0.5, 1.2}, z_f{0.7}, t{0.0},
      r{0.11};
  ClosedInterface closed_with(std::uint8_t fixed) const {
    return close_with_robin({.z_f = z_f, .t = t, .r = r}, 0.0, normal,
                            {.x = {0, 0}, .v = v, .w = w, .Z = Z, .fixed = {fixed}, .z_p = 1});
  }
  const ClosedInterface closed = closed_with(0);
};

TEST_F(RobinPoint, LiesOnTheGasCharacteristic) {
  EXPECT_NEAR(closed.w_n[0] + z_f[0] * closed.v_n[0], r[0], 1e-15);
}

TEST_F(RobinPoint, KeepsAGivenMotion) {
  const ClosedInterface clamped = closed_with(1);
  EXPECT_EQ(clamped.v_n[0], normal[0] * v[0] + normal[1] * v[1]);
  EXPECT_NEAR(clamped.w_n[0] + z_f[0] * clamped.v_n[0], r[0], 1e-15);
}

TEST_F(RobinPoint, Eq23IsSatisfiedWithNoTangentialTraction) {
  // Some velocity with the closed normal component satisfies
  // w_n n - Z v = w0 - Z v0: solve for it and look at n.v.
  const double b1 = w[0] - (Z[0] * v[0] + Z[1] * v[1]) - closed.w_n[0] * normal[0];
  const double b2 = w[1] - (Z[1] * v[0] + Z[2] * v[1]) - closed.w_n[0] * normal[1];
  const double det = Z[0] * Z[2] - Z[1] * Z[1];
  const double v1 = -(Z[2] * b1 - Z[1] * b2) / det;
  const double v2 = -(Z[0] * b2 - Z[1] * b1) / det;
  EXPECT_NEAR(normal[0] * v1 + normal[1] * v2, closed.v_n[0], 1e-14);
}

}  // namespace
}  // namespace fsi::solid
