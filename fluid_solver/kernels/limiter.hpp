#pragma once
/// Slope limiters. One more limiter is one struct here, its name in `AnyLimiter` and in `Limiter`.
///
/// Each gives *half* the slope of a quantity over one cell from the differences a (to the neighbour before)
/// and b (to the neighbour after): the face values are q - half_slope
/// and q + half_slope. Selects only, no branches.

#include <variant>

namespace fsi::fluid {

inline double smaller(double a, double b) {
  return a < b ? a : b;
}
inline double larger(double a, double b) {
  return a > b ? a : b;
}

/// Centred slopes: second order everywhere, for smooth flow.
struct LimiterNone {
  static double half_slope(double a, double b) { return 0.25 * (a + b); }
};

/// The smaller of the two differences, zero at an extremum.
struct LimiterMinmod {
  static double half_slope(double a, double b) {
    return 0.5 * (larger(0.0, smaller(a, b)) + smaller(0.0, larger(a, b)));
  }
};

/// Monotonised central: centred where that lies within twice either difference.
struct LimiterMc {
  static double half_slope(double a, double b) {
    const double c = 0.25 * (a + b);
    return larger(0.0, smaller(c, smaller(a, b))) + smaller(0.0, larger(c, larger(a, b)));
  }
};

/// Harmonic mean of the differences, zero at an extremum.
struct LimiterVanLeer {
  static double half_slope(double a, double b) {
    const double product = a * b;
    const bool monotone = product > 0;
    return monotone ? product / (monotone ? a + b : 1.0) : 0.0;
  }
};

using AnyLimiter = std::variant<LimiterNone, LimiterMinmod, LimiterMc, LimiterVanLeer>;

}  // namespace fsi::fluid
