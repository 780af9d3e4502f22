#pragma once
/// Natural logarithm without branches, so that a loop over points that needs ln J still vectorises (the C
/// library's std::log is an opaque call and stops the vectoriser).

#include <bit>
#include <cstdint>
#include <limits>

namespace fsi::solid {

/// ln x for positive normal x; not-a-number for x <= 0 and for
/// not-a-number. Error below 2 units in the last place.
///
/// x = 2^k m with sqrt(1/2) <= m < sqrt(2), and ln m = 2 artanh s with s = (m - 1) / (m + 1), |s| < 0.172:
/// eleven terms of the power series of artanh leave less than 1e-18.
/// Near x = 1 (k = 0) the result keeps full relative accuracy.
[[gnu::always_inline]] inline double logarithm(double x) {
  constexpr std::uint64_t bits_of_sqrt_half = 0x3fe6a09e667f3bcd;
  constexpr std::uint64_t mantissa = 0x000fffffffffffff;
  constexpr std::uint64_t bits_of_2_to_52 = 0x4330000000000000;
  constexpr std::uint64_t bias = 1024;  // keeps the exponent positive while it is turned into a double
  constexpr double ln2_high = 0x1.62e42fefa3800p-1;  // 42 bits: k * ln2_high is exact
  constexpr double ln2_low = 0x1.ef35793c76730p-45;

  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t shifted = bits - bits_of_sqrt_half + (bias << 52);
  const auto k = std::bit_cast<double>(bits_of_2_to_52 | (shifted >> 52)) - (0x1.0p52 + double(bias));
  const auto m = std::bit_cast<double>((shifted & mantissa) + bits_of_sqrt_half);
  const double f = m - 1.0;
  const double s = f / (2.0 + f);
  const double s2 = s * s;
  double tail = 1.0 / 23;
  tail = tail * s2 + 1.0 / 21;
  tail = tail * s2 + 1.0 / 19;
  tail = tail * s2 + 1.0 / 17;
  tail = tail * s2 + 1.0 / 15;
  tail = tail * s2 + 1.0 / 13;
  tail = tail * s2 + 1.0 / 11;
  tail = tail * s2 + 1.0 / 9;
  tail = tail * s2 + 1.0 / 7;
  tail = tail * s2 + 1.0 / 5;
  tail = tail * s2 + 1.0 / 3;
  // 2 s = f - s f, so that ln m = f - s (f - 2 s^2 tail): the leading term carries no rounding error.
  const double log_m = f - s * (f - 2.0 * s2 * tail);
  const double result = k * ln2_high + (log_m + k * ln2_low);
  return x > 0.0 ? result : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace fsi::solid
