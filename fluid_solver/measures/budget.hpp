#pragma once
/// What comes into the gas over its boundary, and by how much its totals change otherwise.
///
///     o   |   o       o       o      o points, | faces of the points' control volumes
///     side  ^ counted here
///
/// A side through which gas passes has boundary points whose state is given, or comes from beyond, whatever
/// the scheme put there: nothing is conserved in their control volumes, and the state at the side says
/// little of what passed. So the balance is that of the gas up to half a cell before such a side, with the
/// fluxes through these faces that the scheme itself applied: on one grid it is closed to round-off. Of a background
/// with levels it is half a cell of the coarsest one; what lies there of each level counts. At walls
/// and mirrors the balance goes to the side, where their pressure acts; at interfaces the projected one.
/// Interpolation between overlapping grids conserves nothing: what is left in a case with bodies is that, and
/// the quadrature along the bodies. It falls with the mesh.

#include <array>
#include <span>

#include "common/core/time/time_integral.hpp"
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

/// A gas between the sides of its background, a rectangle at rest, and the solids in it.
class Budget {
 public:
  /// From now on the solver notes what its steps carry through the faces before the sides.
  explicit Budget(GasSolver& solver);

  /// Boundary and interfaces after a step of size dt; dt = 0 at the start.
  void add(const GasSolver& solver, std::span<const InterfaceLoad> interfaces, double dt);
  /// Totals now less those at the start and what came in since; no angular momentum.
  Totals defect(const GasSolver& solver) const;

  /// What came in so far, for a restart.
  void archive(Archive& archive);

 private:
  std::array<bool, 4> open_{};  ///< sides that let gas pass
  Totals initial_;
  TimeIntegral<4> pushed_;           ///< mass, momentum, energy by walls and interfaces
  std::array<double, 4> crossed_{};  ///< the same with the gas

  /// Points along a side of the background or of one of its levels.
  struct Along {
    Side side;
    int grid, n;
    int lines;  ///< beside an open side that are left out
  };
  void add_crossed(const GasSolver& solver, const Along& along);
  double end_weight(const Along& along, int k) const;
  void add_wall(const GasSolver& solver, const Along& along, std::array<double, 4>& rates) const;
};

}  // namespace fsi::fluid
