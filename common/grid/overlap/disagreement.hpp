#pragma once
/// Where two component grids that compute the same place have different solutions there.
///
///     . . . . . . . .      background, and . . . a body-fitted grid: what one advances between its own sides
///     . . x x x . . .      and the other as well (x) both should agree upon, but for their errors.
///
/// Interpolation carries values from grid to grid and conserves nothing, so each grid may hold a jump of its own
/// beside the points that it interpolates: a shock that stands at the rim of the one, and another at the hole of
/// the other. Both solutions are then steady, and neither is that of the equations. It happens where a wake or
/// a jet is resolved by two or three cells.

#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/grid/cartesian_grid.hpp"
#include "common/grid/watch.hpp"

namespace fsi::grid {

/// Largest ratio of the sides of cells that are compared [-].
inline constexpr double unlike = 3;

/// Above this size a program says so. A shock that is a slope over W in the cells of one grid and over w in those of
/// the other, its middle at the same place in both, makes a difference of (1 - w / W) / 2 of its jump.
inline constexpr double torn = 0.5 * (1 - 1 / unlike);  ///< difference over range [-]

class DisagreementWatch final : public Watch {
 public:
  DisagreementWatch(std::vector<WatchedQuantity> quantities, std::vector<std::string> grids);

  /// Compares all points that grids 1, 2, ... advance with the background, grid 0, wherever that advances all
  /// corners of the cell around them and the cells of both are of about the same size: coarse cells draw a shock out
  /// over what fine ones beside them see as two constant states. `ranges`: of each quantity [unit of the quantity].
  void look(const CartesianGrid& background, std::span<const WatchedGrid> grids,
            std::span<const double> ranges, double t);
  /// `v1 differs by 54 % of its range between grid "ring", point (20, 3) at (0.24, 0), and grid "background",
  /// t = 0.00059`
  std::string in_words(const Finding& found) const override;
  void archive(Archive& archive) { archive_findings(archive); }

 private:
  std::string background_;
  void compare(const CartesianGrid& background, std::span<const WatchedGrid> grids,
               std::span<const double> ranges, Finding at);
};

}  // namespace fsi::grid
