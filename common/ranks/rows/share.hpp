#pragma once
/// A gas or a solid shared out among ranks: who advances which rows, and what is brought where.
///
///     every rank      positions of all grids, their overlap, walls: the same numbers everywhere, never sent
///     its owner       state of a row; others have it in their halo, or bring what they interpolate from
///     rank 0          what leaves the program
///
/// Arrays have their full size on every rank. Interpolation points and ghosts of a halo are computed by whom the
/// halo is, so values travel once a step: what was advanced, after boundary points were set.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/core/field.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "common/ranks/ranks.hpp"
#include "common/ranks/rows/cut.hpp"
#include "common/ranks/rows/delivery.hpp"
#include "common/ranks/rows/rank_rows.hpp"

namespace fsi {

/// How rows are shared out anew in the course of a run.
struct RecutOptions {
  int every = 0;  ///< tests: other rows for everybody after so many steps, balanced or not; 0: when it pays
  Pieces pieces = Pieces::of_all_grids;
};

/// A strip that a rank needs.
struct Need {
  int rank = 0;
  Strip strip;
};

/// What is brought in a step besides donors of interpolation points.
struct StepNeeds {
  bool halos = true;  ///< what others advanced of one's halo
  std::span<const Need> more = {};
};

class Share {
 public:
  /// Nothing is shared.
  Share() = default;
  Share(std::shared_ptr<Ranks> ranks, const RecutOptions& options, std::span<const CutGrid> grids);

  bool alone() const { return ranks_->alone(); }
  Ranks& ranks() const { return *ranks_; }
  RankRows rows(int grid) const;

  /// Whether rows should be shared out anew before the next step; counts the steps.
  bool recut_is_due(std::span<const CutGrid> grids);
  /// Shares them out anew and brings the new rows of `fields`, one of each grid, whole, several times over.
  void recut(std::span<const CutGrid> grids, std::span<const std::vector<FieldView>> fields);

  /// Finds what is to be brought in a step, and which interpolation points this rank sets. `composite`: null
  /// where there is one grid only.
  void plan(std::span<const CutGrid> grids, const grid::CompositeGrid* composite,
            const StepNeeds& needs = {});
  /// The same for the points that a motion uncovered.
  void plan_exposed(const grid::CompositeGrid& composite);

  /// What others have advanced: halos, and donors of interpolation points.
  void bring(std::span<const FieldView> fields) { bring(step_, fields); }
  /// Donors of points that a motion uncovered.
  void bring_exposed(std::span<const FieldView> fields) { bring(exposed_, fields); }
  /// Of what others have advanced, the rows next to one's own.
  void bring_neighbours(std::span<const FieldView> fields) { bring(neighbours_, fields); }

  /// Something else that was planned for all ranks.
  void bring(Delivery& delivery, std::span<const FieldView> fields);
  Delivery nothing_yet() const { return {cut_, ranks_->rank()}; }
  /// Whether a rank has a row of a grid: it owns it, or has it as halo.
  bool has(int rank, int grid, int j) const;
  /// The parts of some points of a grid that are in a rank's halo.
  void need_halos(int grid, const grid::RowSets& points, Delivery& delivery) const;

  /// Those of the lists' points that this rank sets; of points that are donors of each other, every rank sets all.
  std::span<const grid::InterpolationList> mine(
      std::span<const grid::InterpolationList> interpolation) const {
    return alone() ? interpolation : mine_;
  }
  std::span<const grid::InterpolationList> mine_exposed(
      std::span<const grid::InterpolationList> exposed) const {
    return alone() ? exposed : mine_exposed_;
  }

  /// Brings strips to rank 0.
  void to_first(std::span<const Strip> strips, std::span<const FieldView> fields);
  /// Brings all rows of all grids to rank 0, ghosts included.
  void all_to_first(std::span<const FieldView> fields);
  /// A row of a grid with ghosts and what lies between rows.
  Strip whole_row(int grid, int j) const;

  /// Counted since the start.
  struct Counts {
    double steps = 0, recuts = 0;
    double values = 0;  ///< brought here, one per point and plane
  };
  const Counts& counts() const { return counts_; }
  const Cut& cut() const { return cut_; }

 private:
  std::shared_ptr<Ranks> ranks_ = one_rank();
  RecutOptions options_;
  Cut cut_;
  std::vector<Layout> layouts_;
  std::vector<std::vector<std::vector<int>>>
      holders_;  ///< by grid and row: ranks that own it or have it as halo
  Delivery step_, exposed_, neighbours_;
  std::vector<grid::InterpolationList> mine_, mine_exposed_;
  std::vector<std::vector<bool>> everywhere_;  ///< by grid and position: donors of points that all ranks set
  std::vector<int> all_ranks_;
  int since_recut_ = 0;
  Counts counts_;

  void find_holders();
  int row_of(int grid, std::int32_t at) const;
  void need_neighbours(int grid, const grid::RowSets& points);
  void need_donors(const grid::InterpolationList& list, std::size_t point, int rank,
                   Delivery& delivery) const;
  void mark_everywhere(std::span<const grid::InterpolationList> lists);
  const std::vector<int>& setters_of(const grid::InterpolationList& list, std::size_t point) const;
  void plan_list(const grid::InterpolationList& list, Delivery& delivery,
                 grid::InterpolationList& mine) const;
  void plan_for_all(const grid::InterpolationList& list, Delivery& delivery) const;
};

}  // namespace fsi
