#pragma once
/// What comes into the gas over its boundary, and by how much its totals change otherwise. The scheme
/// conserves mass, momentum and energy on each grid, but interpolation between overlapping grids does not:
/// what is left is an error of second order, to be looked at.

#include <span>

#include "common/core/time_integral.hpp"
#include "fluid_solver/gas_solver.hpp"

namespace fsi::fluid {

/// An interface as the projection left it, n points.
struct InterfaceLoad {
  Side side = Side::top;
  int grid = 0;
  std::span<const double> n;    ///< unit normals into the gas, 2 n
  std::span<const double> v_n;  ///< normal velocity, n
  std::span<const double> w_n;  ///< p_e - p, n
};

/// A gas between the sides of its background, which rests, and the solids in it.
class Budget {
 public:
  explicit Budget(const GasSolver& solver) : initial_(solver.totals()) {}

  /// Boundary and interfaces after a step of size dt; dt = 0 at the start.
  void add(const GasSolver& solver, std::span<const InterfaceLoad> interfaces, double dt);
  /// Totals now less those at the start and what came in since; no angular momentum.
  Totals defect(const GasSolver& solver) const;

  /// What came in so far, for a restart.
  void archive(Archive& archive) { inflow_.archive(archive); }

 private:
  Totals initial_;
  TimeIntegral<4> inflow_;  ///< mass, momentum, energy
};

}  // namespace fsi::fluid
