#pragma once
/// A domain covered by overlapping component grids (paper section 4.1): a Cartesian background and
/// body-fitted grids before it.
///
///     . . . . . . . .     .  discretised point of the background
///     . . o o o o . .     o  interpolates from the body-fitted grid (as many layers as the stencils need)
///     . o o /---\ o .     x  unused: behind the curve (or needed by nobody)
///     . o o | x x |       ---  curve: first line of a body-fitted grid, whose outermost lines interpolate
///     from
///                              the background or from another body-fitted grid
///
/// Background points are classified by the crossings of the grid rows with the curves; what is known of a row
/// are intervals, so an update costs as much as the curves are long, whatever the number of points, and
/// depends on the present positions only.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/cartesian_grid.hpp"
#include "common/grid/donor_search.hpp"
#include "common/grid/hole_cutting.hpp"
#include "common/grid/interpolation.hpp"
#include "common/grid/intervals.hpp"

namespace fsi::grid {

/// A grid whose first line (bottom or top) bounds the domain and cuts the other grids; the opposite side
/// interpolates.
struct BodyFittedGrid {
  std::string name = "grid";
  int n1 = 0, n2 = 0;
  Side curve = Side::bottom;   ///< bottom: the domain lies to the left of the curve; top: to its right
  Curve ends = Curve::closed;  ///< open: both ends on the boundary of the background
};

struct OverlapOptions {
  int layers = 2;     ///< of interpolation points: half-width of the widest stencil, in all directions
  bool trim = false;  ///< leave unused the outer lines of body-fitted grids that nobody needs
};

enum class PointKind : std::uint8_t { unused, interpolated, discretised };

/// What an update did and what it had to put up with.
struct OverlapCounts {
  std::size_t interpolated = 0;  ///< points, all grids
  std::size_t width_2 = 0;       ///< of these with two points per direction: second order only
  std::size_t implicit = 0;      ///< of these with donors that are interpolated themselves
  std::size_t exposed = 0;       ///< points that were unused before
  std::size_t extrapolated = 0;  ///< of these behind the old curve, less than a cell
};

/// Vertices of a body-fitted grid before and after a step.
struct GridPositions {
  ConstFieldView x, x_old;
};

class CompositeGrid {
 public:
  /// Grid 0 is the background, grid k > 0 is bodies[k - 1]. @throws UserMistake
  CompositeGrid(CartesianGrid background, std::vector<BodyFittedGrid> bodies, OverlapOptions options = {});

  /// Connects the grids where they are, without a past. @throws NumbersBroke at a point without donor
  void connect(std::span<const ConstFieldView> x, double t);
  /// Connects the moved grids and finds the points that were unused before.
  /// @throws NumbersBroke at a point without donor, or uncovered by a motion of more than a cell
  void update(std::span<const GridPositions> x, double t);

  int grids() const { return static_cast<int>(parts_.size()); }
  const CartesianGrid& background() const { return background_; }
  /// Runs of discretised points.
  const RowSets& discretised(int grid) const;
  /// Runs of points with a value: discretised and interpolated.
  const RowSets& valid(int grid) const;
  PointKind kind(int grid, int i, int j) const;

  /// Interpolates all planes of all fields, one per grid.
  void interpolate(std::span<const FieldView> fields) const;
  /// Fills points that were unused before the last update with values of the old time: `fields` and positions
  /// are those before the step.
  void fill_exposed(std::span<const FieldView> fields) const;

  std::span<const InterpolationList> interpolation() const { return interpolation_; }
  std::span<const InterpolationList> exposed() const { return exposed_; }
  const OverlapCounts& counts() const { return counts_; }
};

}  // namespace fsi::grid
