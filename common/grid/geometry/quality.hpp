#pragma once
/// How good the cells of a grid are.

#include <optional>
#include <string>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/geometry/interface_geometry.hpp"

namespace fsi::grid {

struct GridQuality {
  double min_jacobian = 0;        ///< smallest corner area of a cell; negative where folded
  double min_jacobian_ratio = 0;  ///< smallest ratio of a cell's smallest to its largest corner area [-]
  double max_skew = 0;            ///< largest |cos| of a corner's angle: 0 is orthogonal [-]
  double max_aspect = 0;          ///< largest ratio of the lengths of the edges that meet at a corner [-]
};

/// Over all cells; x: planes x1, x2.
GridQuality quality_of(ConstFieldView x);

/// One number for a watcher: the smallest ratio of a corner's area to that of the rectangle with the cell's
/// mean sides. 1 where all cells are rectangles, 0 where one is about to fold, negative where one is folded.
double cell_quality(ConstFieldView x);

/// @throws NumbersBroke naming grid, cell, position, t and the corner area of the first folded cell
void check_cells(ConstFieldView x, const std::string& name, double t);

/// Where a grid cannot hold a convex corner of its curve: behind the curve, where its ghost lines continue
/// it, lines converge by as much as they fan out before it.
struct CrowdedCorner {
  int point = 0;       ///< of the curve
  double spacing = 0;  ///< between the curve and the next line that it would hold
  Vec2 x = Vec2::Zero();
};

/// The most crowded point of the curve on side `curve` (bottom or top) at which the line half-way to the
/// first ghost line is shorter than a tenth of the curve, or runs backwards; the fluxes through it would.
std::optional<CrowdedCorner> crowded_corner(ConstFieldView x, Side curve);

}  // namespace fsi::grid
