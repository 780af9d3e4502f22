#pragma once
/// What the gas is told of an interface. Arrays are component-major over the n points of a side in the order of the grid index:
/// component c of point k is at [c * n + k].

#include <span>

#include "common/core/types.hpp"

namespace fsi::fluid {

/// Projected values of the interface points of one side.
struct InterfaceValues {
  Side side = Side::left;
  std::span<const double> n;    ///< unit normal from the solid into the gas, 2 n
  std::span<const double> v_n;  ///< v_n^I, n
  std::span<const double> w_n;  ///< w_n^I = p_e - p^I, n
  std::span<const double> v;    ///< velocity of the wall points, 2 n
  std::span<const double> a;    ///< acceleration of the wall points, 2 n; empty: not known yet
  int grid = 0;                 ///< component grid it belongs to
};

}  // namespace fsi::fluid
