#pragma once
/// A mapped component grid that may move: vertices at t^n and at t^{n+1}, ghost lines included.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/cartesian_grid.hpp"
#include "common/grid/marching/hyperbolic.hpp"

namespace fsi::grid {

/// Position of the grid point with parameters (r, s) in the unit square at time t. Also asked a little
/// outside the square, for the ghost lines.
using Mapping = std::function<Vec2(double r, double s, double t)>;

struct GridDescription {
  std::string name = "grid";
  int n1 = 0, n2 = 0;  ///< points along r and s, both ends included
  Mapping mapping;
  bool moving = false;     ///< the mapping depends on t
  bool periodic1 = false;  ///< the mapping continues periodically: point n1 - 1 is point 0 of the next period
  bool periodic2 = false;
  bool follows = false;  ///< one of its sides is moved by commands
  double shake = 0;      ///< random displacement of every inner point at every step, in cells (tests) [-]
  std::uint64_t shake_seed = 1;
  /// Marched from `curve` in place of a mapping, and again
  /// at every move from the commanded points of its side.
  std::optional<HyperbolicGrid> hyperbolic = {};
  std::vector<double> curve = {};  ///< 2 points, component-major
};

/// Description of a grid marched from a curve and following it.
GridDescription marched_from(const HyperbolicGrid& grid, std::vector<double> curve);

/// Commanded positions of the points of one side: n_d * n, component-major, n points along the side.
struct SideCommand {
  Side side = Side::left;
  std::span<const double> x;
  int grid = 0;  ///< of several component grids, the one that is meant
};

class MovingGrid {
 public:
  /// Places the vertices at time t. @throws Diverged at a folded cell
  MovingGrid(GridDescription description, double t);

  const std::string& name() const { return description_.name; }
  const Layout& layout() const { return x_.layout(); }
  bool moves() const { return description_.moving || description_.shake > 0 || description_.follows; }
  bool periodic(int direction) const {
    return direction == 0 ? description_.periodic1 : description_.periodic2;
  }

  /// Vertices now (planes 0, 1: x1, x2), valid on -2 <= i < n1 + 2, -2 <= j < n2 + 2.
  ConstFieldView x() const { return x_.view(); }
  /// Vertices before the last move.
  ConstFieldView x_old() const { return stayed() ? x_.view() : x_old_.view(); }

  /// Moves to time t: along the mapping, then sides with a command go where they are told and the
  /// displacement fades linearly to the opposite side, continued to the ghost lines. x() becomes x_old().
  /// Where two adjacent sides are told different places for their corner, it goes to the middle between them.
  /// @throws Diverged at a folded cell, naming grid, point, t and the area; where the two places of a
  /// corner are a cell apart
  void move(double t, std::span<const SideCommand> commands = {});
  /// Mean distance of the lines of a marched grid, where it has all its depth; 0 of others.
  double line_distance() const { return march_ ? march_->depth() / (layout().n2 - 1) : 0; }
  /// From the next move on a marched grid has only these parts of its depth, at each point of its curve, in
  /// (0, 1]; empty: all of it. Other grids do not care.
  void leave_part(std::span<const double> part) {
    if (march_) march_->leave_part(part);
  }

  /// Points of a side, n_d * n component-major.
  std::vector<double> side_points(Side side) const;
  int side_size(Side side) const;

  /// Where the grid is and was; nothing of a grid at rest.
  void archive(Archive& archive);

 private:
  GridDescription description_;
  Field x_mapped_, x_, x_old_;  ///< a grid that has never moved has x_ alone
  std::optional<HyperbolicMarch> march_;
  std::array<Vec2, 2> feet_;  ///< where the ends of the curve of a marched grid were at first
  std::uint64_t move_count_ = 0;

  void keep_on_wall(std::size_t end, double t);
  bool stayed() const { return x_old_.planes() == 0; }
  void remember_places();
  void place(double t, FieldView x) const;
  /// The commanded points of each side, adjacent sides with the same corner.
  std::vector<std::vector<double>> with_common_corners(double t, std::span<const SideCommand> commands) const;
  Vec2 common_corner(double t, const SideCommand& a, const SideCommand& b) const;
  void follow(Side side, std::span<const double> told);
  void march(double t, std::span<const SideCommand> commands);
  void shake();
  void check(double t) const;
};

/// A grid whose points form a rectangle along x and y, evenly
/// spaced (for the caller to know), as a background.
CartesianGrid background_of(const MovingGrid& grid);

}  // namespace fsi::grid
