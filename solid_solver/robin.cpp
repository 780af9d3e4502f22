#include "solid_solver/robin.hpp"

#include <cstddef>

namespace fsi::solid {

std::vector<double> lagrange_weights(std::span<const double> t, double now) {
  std::vector<double> weights(t.size(), 1.0);
  for (std::size_t k = 0; k < t.size(); ++k) {
    for (std::size_t l = 0; l < t.size(); ++l) {
      if (l != k) weights[k] *= (now - t[l]) / (t[k] - t[l]);
    }
  }
  return weights;
}

ClosedInterface close_with_robin(const RobinData& gas, double now, std::span<const double> normal,
                                 std::span<const double> v, std::span<const double> w,
                                 std::span<const double> Z) {
  const std::size_t n = gas.z_f.size();
  const std::vector<double> weights = lagrange_weights(gas.t, now);
  ClosedInterface closed{std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t k = 0; k < n; ++k) {
    double r = 0;
    for (std::size_t level = 0; level < weights.size(); ++level) r += weights[level] * gas.r[level * n + k];
    const double n1 = normal[k], n2 = normal[n + k];
    const double det = Z[k] * Z[2 * n + k] - Z[n + k] * Z[n + k];
    // m = Z^-1 n, so that 1/z_hat = n.m and n^T Z^-1 w = m.w
    const double m1 = (Z[2 * n + k] * n1 - Z[n + k] * n2) / det;
    const double m2 = (Z[k] * n2 - Z[n + k] * n1) / det;
    const double z_hat = 1 / (n1 * m1 + n2 * m2);
    const double outgoing = n1 * v[k] + n2 * v[n + k] - (m1 * w[k] + m2 * w[n + k]);
    closed.v_n[k] = (z_hat * outgoing + r) / (z_hat + gas.z_f[k]);
    closed.w_n[k] = r - gas.z_f[k] * closed.v_n[k];
  }
  return closed;
}

}  // namespace fsi::solid
