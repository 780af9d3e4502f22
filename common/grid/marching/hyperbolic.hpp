#pragma once
/// Grids marched from a curve, line by line (paper section 4.1).
///
///     j = 0 ... the curve ... bottom      top: j = n2 - 1 is the curve
///     lines to the left of the curve      lines to its right
///
/// The curve runs along i, its points are line 0 to the bit and keep their index, so that the grids of both
/// sides of an interface meet point by point. Cells have positive area on either side.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/geometry/interface_geometry.hpp"
#include "common/grid/marching/line_solver.hpp"

namespace fsi::grid {

struct HyperbolicGrid {
  std::string name = "grid";
  int points = 0;             ///< along the curve; closed: the last one is the first one
  int lines = 0;              ///< the curve included
  Side curve = Side::bottom;  ///< bottom: marches to the curve's left; top: to its right
  Curve ends = Curve::closed;
  double spacing = 0;  ///< distance of the first line from the curve [length]
  double growth = 1;   ///< ratio of successive distances [-]
  /// Open: direction of the wall on which an end slides, at the first and at the last point; without one the
  /// end goes along the curve's normal.
  std::array<std::optional<Vec2>, 2> walls = {};
  /// Ends at which the curve comes down to its wall so flat that lines along normals would run into the wall:
  /// lines stay parallel to the curve there, and shift along it as far as they must to end on the wall.
  std::array<bool, 2> flat_ends = {false, false};
  double smoothing =
      0.1;  ///< eps of x_rr for lines as far apart as the points are, in proportion for closer ones [-]
  double end_smoothing = 0.01;  ///< the same at the ends [-]
  /// Added where the curve is concave with a radius below the depth over `concave_onset`, where lines would
  /// converge until cells fold: the length depth * concave_smoothing of a front's speed on its curvature [-].
  double concave_smoothing = 1;
  double concave_onset = 0.75;  ///< depth over concave radius from which on it is added, gradually [-]
  int sweeps = 20;              ///< of the local arclength [-]
  int blend = 5;                ///< points over which normals turn into the wall's direction
  /// What is left of the depth at each point of the curve, in (0, 1]: of its distances between lines. Empty:
  /// all of it everywhere.
  std::vector<double> part = {};
};

/// Marches grids of one description, in steps no longer than about the distance between points: where lines
/// are farther apart than that, a line is reached in several steps, for one long step amplifies short waves
/// of the curve until cells fold. How many steps is decided by the first curve and the lines marched from it.
///
/// An object owns the work memory, so that a march allocates nothing.
class HyperbolicMarch {
 public:
  /// @throws UserMistake where the description is out of range
  explicit HyperbolicMarch(HyperbolicGrid grid);

  const HyperbolicGrid& grid() const { return grid_; }
  Layout layout() const { return {grid_.points, grid_.lines}; }
  /// Sum of the nominal distances.
  double depth() const;
  /// From the next march on, HyperbolicGrid::part.
  void leave_part(std::span<const double> part) { grid_.part.assign(part.begin(), part.end()); }

  /// Fills x (planes x1, x2, ghost lines included) from the points of the curve, 2 n component-major.
  /// Ghosts as by `fill_ghosts`. @throws Diverged at a folded cell
  void march(std::span<const double> curve, FieldView x, double t);

 private:
  /// One point of the line marched from.
  struct LinePoint {
    Vec2 tangent;      ///< unit
    Vec2 normal;       ///< unit, towards the next line; longer where lines shift along the curve
    double blend = 0;  ///< 1 where the wall alone decides on the normal, 0 where the curve does [-]
  };

  HyperbolicGrid grid_;
  LineSolver solver_;
  std::vector<LinePoint> line_;
  std::vector<double> arc_;  ///< distance between points
  std::vector<int> steps_;   ///< in which the next line is reached, from the curve on; of the first march
  /// Smoothed along the line, point k at [k + 1], a neighbour beyond each end: distance between points, and
  /// depth over concave radius. The last one is work memory.
  std::vector<double> smooth_, concave_, before_;
  double concave_share_ = 0;  ///< 0 where no lines of the curve converge, towards 1 with every point [-]

  bool closed() const { return grid_.ends == Curve::closed; }
  int row_of(int line) const { return grid_.curve == Side::bottom ? line : grid_.lines - 1 - line; }
  double mean_distance(ConstFieldView x, int j) const;
  int steps_from(ConstFieldView x, int line, double d);
  double longest_step() const;
  double part(std::size_t k) const { return grid_.part.empty() ? 1 : grid_.part[k]; }
  void step(FieldView x, int j, int j_next, double d);
  void measure(ConstFieldView x, int j);
  void measure_distances(ConstFieldView x, int j);
  void relax(std::vector<double>& line);
  void find_concave_places(ConstFieldView x, int j);
  double excess(std::size_t k) const;
  double share_of_concave_points(ConstFieldView x);
  double concave_smoothing(std::size_t k, double d) const;
  void keep_off_walls(ConstFieldView x, int j);
  void blend_into_walls();
  void shift_along_curve(std::size_t end);
  void fill_rows(ConstFieldView x, int j, double d);
  void fill_end(std::size_t k, double d);
  void place(FieldView x, int j, int j_next);
  std::string flat_on_wall(ConstFieldView x, double t) const;
};

}  // namespace fsi::grid
