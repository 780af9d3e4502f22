#pragma once
/// The second-order backward difference formula with variable steps, for solids that integrate implicitly.

namespace fsi {

/// Weights of  dt q'(t^{n+1}) = leading q^{n+1} - now q^n + before q^{n-1}.
struct BackwardDifference {
  double leading = 1, now = 1, before = 0;  ///< [-]

  /// now q^n - before q^{n-1}: what the past contributes, numbers or vectors.
  template <class Value>
  auto history(const Value& q, const Value& q_before) const {
    return now * q - before * q_before;
  }
};

/// For a step dt after one of dt_before; dt_before = 0, at the first step: backward Euler. The formula damps
/// what is infinitely fast, so that bodies without mass are as stable as heavy ones; the trapezoidal rule
/// would let their load change sign at every step for ever.
constexpr BackwardDifference backward_difference(double dt, double dt_before) {
  const double r = dt_before > 0 ? dt / dt_before : 0;
  return {.leading = (1 + 2 * r) / (1 + r), .now = 1 + r, .before = r * r / (1 + r)};
}

}  // namespace fsi
