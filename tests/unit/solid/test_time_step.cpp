// The time step sits on the boundary of the stability ellipse.

#include <gtest/gtest.h>

#include <complex>

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

}  // namespace
}  // namespace fsi::solid
