#pragma once
/// Boundary points and ghost lines of one component grid.
///
/// Boundary points lie on the boundary and have been advanced like all others; here they get what the
/// boundary knows better. Two ghost lines follow, then the corners:
///
///     g g g   g: ghosts. Mirror sides (symmetry, periodic) copy whole lines, the ghosts of the other sides
///     g o o   included; where two other sides meet, the corner is extrapolated.
///     g o o

#include <span>

#include "common/core/types.hpp"
#include "fluid_solver/boundary/side_points.hpp"
#include "fluid_solver/component.hpp"
#include "fluid_solver/gas_options.hpp"

namespace fsi::fluid {

/// What the boundary conditions need to know besides the component.
struct BoundaryTask {
  double t = 0;  ///< [time]
  const GasOptions& options;
  std::span<const InterfaceValues> interfaces;  ///< of this grid
};

/// Boundary points at time t; of several grids, all get theirs before values are interpolated.
/// @throws Diverged where an interface pressure is not positive
void set_boundary_points(Component& component, const BoundaryTask& task);

/// The last row of a grid that is periodic across its rows is the first one again, once more: its owner may not
/// have had that one before it was brought.
void close_periods(Component& component);

/// Ghosts and corners at time t.
void set_ghosts(Component& component, const BoundaryTask& task);

/// Ghosts of the mirror sides only: after initial data were given everywhere, at t.
void mirror_ghosts(Component& component, double t);

}  // namespace fsi::fluid
