#pragma once
/// The rows of a component grid that a rank has to do with.
///
///     . . . . . . .   rows of others: what lies there nobody looks at
///     h h h h h h h   halo: advanced by others, brought here; interpolation points and ghosts are set here too
///     o o o o o o o   own: advanced here
///     h h h h h h h
///
/// Whole rows, so that the kernels do the same on them as with one rank, and get the same bits.

#include <algorithm>
#include <memory>
#include <vector>

#include "common/grid/intervals.hpp"
#include "common/ranks/ranks.hpp"

namespace fsi {

struct RankRows {
  /// Of a gas, the rows around one's own whose values are complete before a step: two for the fluxes, and one more for
  /// the slope of the pressure along a wall at the ends of the rows. Solids have more of them (CutGrid::halo).
  static constexpr int halo = 3;

  std::shared_ptr<Ranks> ranks = one_rank();
  bool all = true;  ///< one rank: own and halo are everything
  grid::RowRange own;
  std::vector<grid::RowRange>
      halos;  ///< own rows and halo, ghost rows included; where the grid closes in this
              ///< direction, the other end of it too

  bool owns(int j) const { return all || own.contains(j); }
  /// Own or halo.
  bool has(int j) const {
    return all || std::ranges::any_of(halos, [j](const grid::RowRange& rows) { return rows.contains(j); });
  }
};

}  // namespace fsi
