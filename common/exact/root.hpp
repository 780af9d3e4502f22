#pragma once
/// Root of a smooth function to machine precision.

#include <cmath>
#include <limits>

namespace fsi::exact {

/// Root of `f` between `a` and `b`, where f(a) and f(b) have opposite signs (or one is zero): Newton steps,
/// and a bisection wherever Newton would leave the bracket or gains
/// too little. `f` returns the pair (value, derivative).
template <class Function>
double root_between(Function f, double a, double b, double guess) {
  const bool rising = f(b).first > 0;
  double x = guess > std::fmin(a, b) && guess < std::fmax(a, b) ? guess : 0.5 * (a + b);
  double last_move = std::fabs(b - a);
  for (int k = 0; k < 200; ++k) {
    const auto [value, slope] = f(x);
    if (value == 0) return x;
    ((value > 0) == rising ? b : a) = x;
    double next = x - value / slope;
    const bool inside = next > std::fmin(a, b) && next < std::fmax(a, b);
    if (!inside || std::fabs(next - x) > 0.5 * last_move) next = 0.5 * (a + b);
    last_move = std::fabs(next - x);
    if (last_move <= 0.5 * std::numeric_limits<double>::epsilon() * std::fabs(x)) return next;
    x = next;
  }
  return x;
}

}  // namespace fsi::exact
