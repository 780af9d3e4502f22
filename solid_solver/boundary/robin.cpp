#include "solid_solver/boundary/robin.hpp"

#include <cstddef>

#include "common/interface/riemann.hpp"
#include "common/wire/messages.hpp"

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
                                 const SolidInterface& predicted) {
  const std::size_t n = gas.z_f.size();
  const std::vector<double>&v = predicted.v, &w = predicted.w, &Z = predicted.Z;
  const std::vector<double> weights = lagrange_weights(gas.t, now);
  ClosedInterface closed{std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t k = 0; k < n; ++k) {
    double r = 0;
    for (std::size_t level = 0; level < weights.size(); ++level) r += weights[level] * gas.r[level * n + k];
    Matrix<2> Z_k;
    Z_k << Z[k], Z[n + k], Z[n + k], Z[2 * n + k];
    const SolidPoint<2> solid{.v = {v[k], v[n + k]}, .w = {w[k], w[n + k]}, .Z = Z_k};
    const Vector<2> normal_k(normal[k], normal[n + k]);
    const NormalSide gas_side{.z = gas.z_f[k], .v_n = 0, .w_n = r};
    const NormalState state = predicted.fixed[k] == wire::Freedom::fixed
                                  ? at_wall(normal_k.dot(solid.v), gas_side)
                                  : between(normal_side(solid, normal_k), gas_side);
    closed.v_n[k] = state.v_n;
    closed.w_n[k] = state.w_n;
  }
  return closed;
}

}  // namespace fsi::solid
