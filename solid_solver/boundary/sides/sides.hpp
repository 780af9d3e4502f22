#pragma once
/// The four sides of one component grid: where their points are, what holds there, and which of them this rank has. Nothing here
/// depends on the law or on the state.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "common/core/types.hpp"
#include "common/ranks/rows/rank_rows.hpp"
#include "solid_solver/boundary/ghost_lines.hpp"
#include "solid_solver/kernels/reference_metrics.hpp"
#include "solid_solver/options.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

/// What a boundary works on.
struct BoundaryGrid {
  std::string name;
  int index = 0;     ///< of the grid among those of the body
  ConstFieldView x;  ///< reference positions with ghosts
  const ReferenceMetrics* metrics = nullptr;
  const SolidPoints* points = nullptr;
};

/// Point k of a side.
struct SidePoint {
  Side side = Side::left;
  int k = 0;
};

class Sides {
 public:
  /// @throws UserMistake when periodic sides do not come in pairs, or a state is missing
  Sides(BoundaryGrid grid, Boundaries boundaries, Limiter limiter);

  static std::size_t index(Side side) { return static_cast<std::size_t>(side); }
  const BoundaryGrid& grid() const { return grid_; }
  Layout layout() const { return grid_.x.layout; }
  Limiter limiter() const { return limiter_; }
  const SideIndex& line(Side side) const { return lines_[index(side)]; }
  /// Geometry of point k of a side.
  const SideMetrics& at(Side side, int k) const { return metrics_[index(side)][static_cast<std::size_t>(k)]; }
  /// In the reference configuration.
  Vec2 position(std::ptrdiff_t at) const { return {grid_.x.plane(0)[at], grid_.x.plane(1)[at]}; }

  /// What holds on a side: that of its boundary, without mirror images where the grid has none.
  const Condition& condition(Side side) const { return conditions_[index(side)]; }
  /// The values of the condition.
  const Boundary& boundary(Side side) const { return boundaries_[index(side)]; }
  bool loaded(Side side) const { return condition(side).loaded(); }
  std::array<bool, 4> loaded() const {
    return {loaded(Side::left), loaded(Side::right), loaded(Side::bottom), loaded(Side::top)};
  }
  /// The load of a side follows the deformation: its area and its normal are the present ones.
  bool follows(Side side) const { return boundary(side).load == LoadConfiguration::current; }

  bool at_end(Side side, int k) const { return k == 0 || k == line(side).n - 1; }
  /// What holds on the side met at end k.
  const Condition& condition_beyond(Side side, int k) const { return condition(neighbour(side, k != 0)); }
  /// The end k of a side as a point of the side it meets there.
  SidePoint around_corner(Side side, int k) const {
    const Side other = neighbour(side, k != 0);
    return {other, at_upper_end(side) ? line(other).n - 1 : 0};
  }
  /// Normal of the side met at end k.
  Vec2 normal_around_corner(Side side, int k) const {
    const SidePoint other = around_corner(side, k);
    return at(other.side, other.k).n0;
  }
  /// False at a corner, unless the neighbour's ghost points are
  /// images, so that differences along the side are sound.
  bool inner(Side side, int k) const {
    return !at_end(side, k) || condition_beyond(side, k).imaged() ||
           (loaded(side) && condition_beyond(side, k).slips());
  }

  /// Whether an interface turns round a corner at this point of a side or at the next one. A fourth-order difference
  /// along the side reaches ghost points of the other side there, which make P(F) at the corner right with differences
  /// of second order and do not continue the field. What (41) makes of them in nearly incompressible bodies is a
  /// traction that pushes the corner the way it went (docs/theory_solid.md, stability).
  bool turns_near(Side side, int k) const;

  /// Discretised points of a side, in the rows that the rank has.
  std::span<const int> points(Side side) const { return advanced_[index(side)]; }
  /// Those with interpolated values.
  std::span<const int> interpolated(Side side) const { return interpolated_[index(side)]; }
  bool advanced(Side side, int k) const;
  /// Conditions are applied next to interpolated points: these must have their values before.
  bool reads_interpolated_points() const;

  // Where several ranks share the body.

  /// From now on points of these rows only.
  void take_rows(const RankRows& rows);
  /// Some of the side is in the rows.
  bool present(Side side) const { return present_[index(side)]; }
  /// Numbers that break at a point are told by its owner.
  bool owns(Side side, int k) const { return held_.owns(grid_point(layout(), side, k).j); }

 private:
  bool mirrors(Side side) const;
  void check_pairs() const;
  void find_points(Side side);

  BoundaryGrid grid_;
  Boundaries boundaries_;
  Limiter limiter_;
  std::array<SideIndex, 4> lines_;
  std::array<Condition, 4> conditions_{};
  std::array<std::vector<SideMetrics>, 4> metrics_;
  std::array<std::vector<int>, 4> advanced_, interpolated_;  ///< points of the sides
  RankRows held_;                                            ///< rows that this rank has
  std::array<bool, 4> present_{true, true, true, true};
};

}  // namespace fsi::solid
