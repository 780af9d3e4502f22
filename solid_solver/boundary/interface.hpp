#pragma once
/// What the solid shows of an interface, and what it is told. Arrays are component-major over the n points of
/// a side in the order of the grid index: component c of point k is at [c * n + k].

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/types.hpp"

namespace fsi::solid {

/// Predicted state of the interface points.
struct SolidInterface {
  std::vector<double> x;            ///< positions x_bar + u, 2 n
  std::vector<double> v;            ///< velocity, 2 n
  std::vector<double> w;            ///< traction eta n0^T P per unit current area, 2 n
  std::vector<double> Z;            ///< impedance matrix Z11, Z12, Z22, 3 n
  std::vector<std::uint8_t> fixed;  ///< how free the points are, n values of wire::Freedom
  std::vector<double> rows = {};    ///< work memory: F and the reference normals, 6 n
  double z_p = 0;  ///< rho c_p of the rest state, for the simplified projection [pressure/velocity]
};

/// Projected values of the interface points of one side.
struct InterfaceValues {
  Side side = Side::right;
  std::span<const double> n;    ///< unit normal, solid -> gas, 2 n
  std::span<const double> v_n;  ///< normal velocity, n
  std::span<const double> w_n;  ///< normal traction per unit current area, n
  int grid = 0;
  /// At its ends: the interface goes on round the corner, where `n` is that of the chord.
  std::array<bool, 2> goes_on{false, false};
};

}  // namespace fsi::solid
