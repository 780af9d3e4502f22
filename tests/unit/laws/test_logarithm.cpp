/// The logarithm that vectorises is as good as the C library's.

#include <gtest/gtest.h>

#include <cmath>

#include "solid_solver/laws/logarithm.hpp"

namespace fsi::solid {
namespace {

TEST(Logarithm, AgreesWithTheLibraryToTwoUnitsInTheLastPlace) {
  for (int k = 1; k < 400000; ++k) {
    const double x = 1e-5 * k;
    const double reference = std::log(x);
    ASSERT_NEAR(logarithm(x), reference, 2.0 * 2.3e-16 * std::abs(reference)) << "x = " << x;
  }
}

TEST(Logarithm, KeepsRelativeAccuracyNextToOne) {
  EXPECT_EQ(logarithm(1.0), 0.0);
  for (double h = 1e-2; h > 1e-15; h *= 0.37) {
    const double above = 1.0 + h;
    const double below = 1.0 - h;
    EXPECT_NEAR(logarithm(above), std::log(above), 5e-16 * h);
    EXPECT_NEAR(logarithm(below), std::log(below), 5e-16 * h);
  }
}

TEST(Logarithm, CoversTheWholeRangeOfNumbers) {
  for (const double x :
       {2.3e-308, 1e-100, 0.70710678118654746, 0.70710678118654757, 1.4142135623730949, 1e100, 1.7e308}) {
    EXPECT_NEAR(logarithm(x), std::log(x), 4.5e-16 * std::abs(std::log(x)));
  }
}

TEST(Logarithm, IsNotANumberOutsideItsDomain) {
  EXPECT_TRUE(std::isnan(logarithm(0.0)));
  EXPECT_TRUE(std::isnan(logarithm(-1.0)));
  EXPECT_TRUE(std::isnan(logarithm(std::nan(""))));
}

}  // namespace
}  // namespace fsi::solid
