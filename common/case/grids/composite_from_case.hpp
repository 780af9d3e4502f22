#pragma once
/// The component grids of a case as those of common/grid.

#include <vector>

#include "common/case/case.hpp"
#include "common/grid/moving_grid.hpp"
#include "common/grid/overlap/composite_grid.hpp"

namespace fsi {

/// A rectangle as the background of body-fitted grids.
grid::CartesianGrid background_of(const GridSpec& spec);

/// A body-fitted grid, marched from its curve or mapped. It does not follow commands.
grid::GridDescription grid_of(const BodyFittedSpec& spec);

/// What the overlap needs to know of body-fitted grids.
std::vector<grid::BodyFittedGrid> bodies_of(const std::vector<BodyFittedSpec>& specs);

/// Depth of so many lines for each unit of their first distance.
double depth_of(int lines, double growth);
/// From the curve to the last line.
double depth_of(const BodyFittedSpec& spec);
/// Lines, at least five, that are so deep.
int lines_to(double depth, double spacing, double growth);
/// A grid with lines so close, and as many more as keep its depth where they do not fold, that the bends of its
/// curve hold them (grid::most_crowded_bend), and its flat ends on walls (grid::most_slanted_line): tried. The
/// same grid where it holds already, or nothing is known of it.
BodyFittedSpec with_sound_lines(const BodyFittedSpec& spec);

/// The grids of all curves at t = 0, with the room they leave each other.
/// @throws Diverged for folds
std::vector<grid::MovingGrid> grids_at_start(const std::vector<BodyFittedSpec>& specs);

/// Marches the grids from their curves and connects them with the background at t = 0, to see whether that
/// can be done. @throws Diverged for folds, curves nearer to each other than is computed, points without
/// donors, and where points that interpolate from each other amplify errors more than is sound
void connect_once(const GridSpec& background, const std::vector<BodyFittedSpec>& specs);

/// Whether that succeeds.
bool connects(const GridSpec& background, const std::vector<BodyFittedSpec>& specs);

/// Depth of a grid over the radius of the sharpest bend it turns inwards at [-], docs/theory_grids.md, "Grids
/// in a body".
inline constexpr double depth_by_radius = 0.6;

}  // namespace fsi
