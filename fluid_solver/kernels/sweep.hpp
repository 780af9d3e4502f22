#pragma once
/// One step of the unsplit MUSCL-Hancock scheme on one component grid, streamed row by row through a few rows
/// of scratch memory.
///
///     predict row r -> fluxes between rows r - 1 and r -> update row r - 1 -> fluxes along row r
///
/// One Riemann problem per face and step.

#include <array>
#include <compare>
#include <optional>
#include <span>
#include <vector>

#include "fluid_solver/kernels/face_fluxes.hpp"
#include "fluid_solver/kernels/limiter.hpp"
#include "fluid_solver/kernels/riemann/every_riemann.hpp"
#include "fluid_solver/kernels/rows.hpp"
#include "fluid_solver/kernels/sweep_runs.hpp"
#include "fluid_solver/kernels/viscous_rows.hpp"
#include "fluid_solver/kernels/workspace.hpp"

namespace fsi::fluid {

/// Equal spacings of a Cartesian grid at rest.
struct Spacing {
  double dx, dy;  ///< [length]
};

/// A grid during one step: vertices before and after, or just two spacings.
struct StepGrid {
  ConstFieldView x_old, x;
  std::optional<Spacing> cartesian;
};

/// What the kernels need to know of the gas and the scheme.
struct Scheme {
  double gamma = 1.4;  ///< [-]
  double p_floor = 0;  ///< [pressure]
  AnyRiemann riemann;
  AnyLimiter limiter;
  Viscosity viscosity;
};

/// Rows of scratch memory a sweep needs.
inline constexpr int sweep_rows = 68;

/// A point of the grid; row by row.
struct PointIndex {
  int i, j;
  friend bool operator==(const PointIndex&, const PointIndex&) = default;
  friend std::strong_ordering operator<=>(const PointIndex& a, const PointIndex& b) {
    return a.j != b.j ? a.j <=> b.j : a.i <=> b.i;
  }
};

/// What a step carried through the faces half a cell, or some lines more, inside the sides left, right, bottom, top,
/// towards higher indices, as it changed the points beside them: mass, momentum (2), energy of each of the n points
/// of a side, component-major; per volume of a cell on a Cartesian grid. Empty spans: not wanted.
using EdgeFluxes = std::array<std::span<double>, 4>;

/// What a sweep writes besides the new state.
struct SweepOutput {
  Workspace& work;              ///< scratch, sweep_rows rows
  std::span<double> row_rates;  ///< n2: largest wave rate of the inner points of each row, for the next time
                                ///< step; without viscosity only; empty: not wanted
  std::vector<PointIndex>& fallbacks;  ///< points advanced with first-order states are added
  EdgeFluxes edges = {};               ///< written where a point beside the face is advanced
  FaceFluxes* noted = nullptr;         ///< faces whose fluxes are kept; null: none
  int edge_lines = 0;                  ///< so many lines lie between a side's line and the faces of `edges`
};

/// What is advanced: the points of the runs, boundary points included, from q (with the points around them
/// and ghosts) to q_new by dt.
struct SweepTask {
  ConstFieldView q;
  FieldView q_new;
  const StepGrid& grid;
  const SweepRuns& runs;
  double dt;                                 ///< [time]
  std::span<const PointIndex> guarded = {};  ///< sorted: points with first-order positive fluxes on all faces
  const FaceFluxes* imposed = nullptr;       ///< faces whose fluxes are given; null: none
};

/// @returns the number of thin points, see update_row
double sweep(const SweepTask& task, const Scheme& scheme, const SweepOutput& output);

}  // namespace fsi::fluid
