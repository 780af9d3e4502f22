#pragma once
/// Sets of points of a grid as sorted, disjoint intervals of each row: the cost of every operation is that of
/// the ends of the intervals, not that of the points between.

#include <cstddef>
#include <span>
#include <vector>

namespace fsi::grid {

/// Points begin <= i < end of a row.
struct Interval {
  int begin = 0, end = 0;
  bool operator==(const Interval&) const = default;
};

/// One set of points. Rows are appended in order: clear(), then for each row its intervals and end_row().
class RowSets {
 public:
  int rows() const { return static_cast<int>(first_.size()) - 1; }
  std::span<const Interval> row(int j) const {
    const auto k = static_cast<std::size_t>(j);
    return {intervals_.data() + first_[k], first_[k + 1] - first_[k]};
  }
  bool contains(int i, int j) const { return contains(Interval{i, i + 1}, j); }
  /// All of begin <= i < end; false in rows there are not.
  bool contains(Interval part, int j) const {
    if (j < 0 || j >= rows()) return false;
    for (const Interval& interval : row(j)) {
      if (part.begin < interval.end) return part.begin >= interval.begin && part.end <= interval.end;
    }
    return false;
  }
  std::size_t points() const;

  void clear();
  void append(Interval interval) { intervals_.push_back(interval); }
  void append(std::span<const Interval> row) { intervals_.insert(intervals_.end(), row.begin(), row.end()); }
  void end_row() { first_.push_back(intervals_.size()); }
  bool operator==(const RowSets&) const = default;

 private:
  std::vector<std::size_t> first_{0};
  std::vector<Interval> intervals_;
};

/// All points of a grid of n1 x n2.
RowSets all_points(int n1, int n2);

/// Sorts and merges; empty intervals vanish.
void unite(std::vector<Interval>& parts);

/// Appends what is in `from` and not in `without`, both sorted and disjoint, to `parts`.
void subtract(std::span<const Interval> from, std::span<const Interval> without,
              std::vector<Interval>& parts);

/// Appends what is in both to `parts`.
void intersect(std::span<const Interval> a, std::span<const Interval> b, std::vector<Interval>& parts);

/// Shape of the index space in which sets grow.
struct RowShape {
  int n1 = 0;
  bool closed = false;  ///< point n1 - 1 is point 0
};

/// Appends the points of row j that lie within `reach` of the set in both directions to `parts`, unsorted.
void grow(const RowSets& set, int j, int reach, RowShape shape, std::vector<Interval>& parts);

/// Rows first <= j < end.
struct RowRange {
  int first = 0, end = 0;
  bool contains(int j) const { return first <= j && j < end; }
  bool operator==(const RowRange&) const = default;
};

/// Points of one grid by what is done with them.
struct PointSets {
  RowSets holes;        ///< unused for what they are, not for want of need
  RowSets discretised;  ///< all points within the stencil's reach are valid
  RowSets valid;        ///< discretised, or interpolated and within the reach of a discretised point
};

/// The rows of a grid.
struct GridRows {
  RowShape shape;
  int n2 = 0;
  RowRange inner;  ///< may be discretised
  RowRange used;   ///< may be discretised or interpolated
};

/// Discretised and valid points from the holes; `layers` is the reach of the stencil, `parts` work memory.
void classify(PointSets& sets, const GridRows& rows, int layers, std::vector<Interval>& parts);

}  // namespace fsi::grid
