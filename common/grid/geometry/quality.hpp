#pragma once
/// How good the cells of a grid are.

#include <optional>
#include <span>
#include <string>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/geometry/interface_geometry.hpp"

namespace fsi::grid {

struct GridQuality {
  double min_jacobian = 0;        ///< smallest corner area of a cell; negative where folded [area]
  double min_jacobian_ratio = 0;  ///< smallest ratio of a cell's smallest to its largest corner area [-]
  double max_skew = 0;            ///< largest |cos| of a corner's angle: 0 is orthogonal [-]
  double max_aspect = 0;          ///< largest ratio of the lengths of the edges that meet at a corner [-]
};

/// Over all cells; x: planes x1, x2.
GridQuality quality_of(ConstFieldView x);

/// One number for a watcher: the smallest ratio of a corner's area to that of the rectangle with the cell's
/// mean sides. 1 where all cells are rectangles, 0 where one is about to fold, negative where one is folded.
double cell_quality(ConstFieldView x);

/// @throws Diverged naming grid, cell, position, t and the corner area of the first folded cell
void check_cells(ConstFieldView x, const std::string& name, double t);

/// Where a grid cannot hold a convex corner or bend of its curve: behind the curve, where its ghost lines
/// continue it, lines converge by as much as they fan out before it. The share of the curve that is left of a
/// line half-way to the first ghost line falls from 1 in proportion to the distance of the lines; at 1/2 the
/// first ghost line has shrunk to nothing, and beyond it runs backwards.
struct CrowdedCorner {
  int point = 0;       ///< of the curve
  double spacing = 0;  ///< between the curve and the next line that it would hold [length]
  double part = 0;     ///< the same over the present one [-]: less than 1 where it is too crowded
  Vec2 x = Vec2::Zero();
};

/// What must be left [-]: of any curve, for fluxes go through it; and where a curve turns, at a sharp corner or over
/// several points, whose ghosts would change places otherwise: there the gas grows out of bounds with a half or
/// less, and a body that yields to it earlier. A margin for bodies that bend is included.
inline constexpr double least_share = 0.1, least_share_of_turns = 0.55;
/// At sharp corners of elastic bodies: with 0.6 a shock makes the gas at the corner grow out of bounds within some
/// hundred steps, with 0.65 it does not (docs/theory_grids.md, "Corners").
inline constexpr double least_share_of_elastic_corners = 0.7;

/// The most crowded point of the curve on side `curve` (bottom or top) at which less than least_share is left.
std::optional<CrowdedCorner> crowded_corner(ConstFieldView x, Side curve);

/// The most crowded point of all that are not next to a corner, crowded or not; nothing where no line gets
/// shorter.
std::optional<CrowdedCorner> most_crowded_bend(ConstFieldView x, Side curve, std::span<const int> corners);

/// The most crowded one of the corners and the points next to them, where `least` must be left.
std::optional<CrowdedCorner> most_crowded_corner(ConstFieldView x, Side curve, std::span<const int> corners,
                                                 double least);

/// Where lines leave a curve so slantingly, as at a wall that it meets at a flat angle, that a ghost point
/// lies beside another point of the curve than its own.
struct SlantedLine {
  int point = 0;     ///< of the curve
  double slant = 0;  ///< of the way to the next line, what goes along the curve, in points of it [-]
  Vec2 x = Vec2::Zero();
};

/// From there on the pressure behind a wall, continued along the slanted line, feeds the noise before it.
inline constexpr double largest_slant = 2;  ///< [-]

/// The most slanted line from the curve on side `curve` (bottom or top).
SlantedLine most_slanted_line(ConstFieldView x, Side curve);

}  // namespace fsi::grid
