#pragma once
/// Which points of each row a step works on.
///
///     row r + 1      . . d d d . .        d  advanced
///     row r          . p d d d d p .      p  states are predicted there too, for the faces of the advanced
///     row r - 1      . p d d d d d p
///
/// Kernels take whole runs; points that are not advanced cost nothing and are never read beyond the stencil. The last
/// points of a run may be rounded otherwise than if it went on, so where ranks share the rows out, runs are those of
/// all rows nevertheless.

#include <cstddef>
#include <span>
#include <vector>

#include "fluid_solver/kernels/rows.hpp"

namespace fsi::fluid {

class SweepRuns {
 public:
  /// `rows` gives the runs to advance of each of the n2 rows, sorted and disjoint; those with first <= r < last are
  /// advanced here.
  void assign(std::span<const std::vector<Range>> rows, Range here);
  /// All rows are.
  void assign(std::span<const std::vector<Range>> rows) { assign(rows, {0, static_cast<int>(rows.size())}); }

  int rows() const { return static_cast<int>(advanced_.first.size()) - 1; }
  /// Points of the longest run whose states are predicted, here or elsewhere.
  int longest() const { return longest_; }
  /// The rows that are advanced here.
  Range here() const { return here_; }
  /// Points to advance here, 0 <= r < n2.
  std::span<const Range> advanced(int r) const { return part(advanced_, r, 0); }
  /// Points to advance, here or elsewhere.
  std::span<const Range> advanced_anywhere(int r) const { return advanced_.of(r); }
  /// Points whose state is predicted, -1 <= r <= n2: one further than the advanced ones on each side.
  std::span<const Range> predicted(int r) const { return part(predicted_, r + 1, 2); }
  /// Points with a face between rows r - 1 and r, 0 <= r <= n2.
  std::span<const Range> between(int r) const { return part(between_, r, 1); }

 private:
  /// Runs of all rows, one after the other.
  struct Table {
    std::vector<Range> runs;
    std::vector<std::size_t> first{0};
    std::span<const Range> of(int row) const {
      const auto k = static_cast<std::size_t>(row);
      return {runs.data() + first[k], first[k + 1] - first[k]};
    }
    void clear() {
      runs.clear();
      first.assign(1, 0);
    }
    void append_row(std::vector<Range>& row);
  };
  Table advanced_, predicted_, between_;
  Range here_{0, 0};
  int longest_ = 0;
  std::vector<Range> row_;  ///< work memory

  /// A row of a table that has `more` rows than are advanced.
  std::span<const Range> part(const Table& table, int row, int more) const {
    const bool needed = here_.first < here_.last && row >= here_.first && row < here_.last + more;
    return needed ? table.of(row) : std::span<const Range>{};
  }
};

}  // namespace fsi::fluid
