#pragma once
/// Closure of the interface during the substeps of a multirate step: the gas is known by its outgoing
/// characteristic only, w_n + z_f v_n = r(t), the solid by its own relations, paper eq. (23).

#include <span>
#include <vector>

#include "solid_solver/boundary/interface.hpp"

namespace fsi::solid {

/// r_k of the gas at the newest times t_k (newest first), n values each.
struct RobinData {
  std::span<const double> z_f;  ///< gas impedance, n
  std::span<const double> t;    ///< 1 to 3 times
  std::span<const double> r;    ///< levels * n
};

/// Normal velocity and traction of one interface, n values each.
struct ClosedInterface {
  std::vector<double> v_n, w_n;
};

/// Weights of the Lagrange polynomial through the times `t` (1 to 3 of them), evaluated at `now`.
std::vector<double> lagrange_weights(std::span<const double> t, double now);

/// Solves the gas relation together with the solid's for v_n and w_n with zero tangential traction; points
/// whose motion is given keep it. `normal` points from the solid into the gas (2 n).
ClosedInterface close_with_robin(const RobinData& gas, double now, std::span<const double> normal,
                                 const SolidInterface& predicted);

}  // namespace fsi::solid
