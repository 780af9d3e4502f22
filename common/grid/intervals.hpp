#pragma once
/// Sets of points of a grid as sorted, disjoint intervals of each row: the cost of every operation is that of
/// the ends of the intervals, not that of the points between.

#include <span>
#include <vector>

namespace fsi::grid {

/// Points begin <= i < end of a row.
struct Interval {
  int begin = 0, end = 0;
  bool operator==(const Interval&) const = default;
};

class RowSets {
 public:
  explicit RowSets(int rows = 0) : first_(static_cast<std::size_t>(rows) + 1, 0) {}

  int rows() const { return static_cast<int>(first_.size()) - 1; }
  std::span<const Interval> row(int j) const {
    const auto k = static_cast<std::size_t>(j);
    return {intervals_.data() + first_[k], static_cast<std::size_t>(first_[k + 1] - first_[k])};
  }
  bool contains(int i, int j) const;
  /// All of begin <= i < end.
  bool contains(Interval part, int j) const;
  /// Points in all rows.
  std::size_t points() const;

  /// Rows are appended in order: clear, then for each row its intervals and end_row().
  void clear();
  void append(Interval interval) { intervals_.push_back(interval); }
  void end_row();
  bool operator==(const RowSets&) const = default;

 private:
  std::vector<int> first_;
  std::vector<Interval> intervals_;
  int built_ = 0;
};

}  // namespace fsi::grid
