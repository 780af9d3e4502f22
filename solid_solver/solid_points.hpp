#pragma once
/// Which points of a component grid the solver works on, as runs of rows: kernels pass over whole runs.

#include <span>

#include "common/core/field.hpp"
#include "common/grid/intervals.hpp"

namespace fsi::solid {

/// Points begin <= i < end of row j.
struct RowRun {
  int j = 0, begin = 0, end = 0;
};

/// Points that are advanced (discretised) and points that have a value (valid); the latter are more where a
/// composite grid interpolates. The step of a point needs the prediction of its four neighbours, ghost points
/// included, which is made here as well.
class SolidPoints {
 public:
  /// All points of a grid that stands alone.
  explicit SolidPoints(const Layout& layout);
  /// Those of a composite grid, with at least two layers of interpolation points.
  SolidPoints(const Layout& layout, grid::RowSets discretised, grid::RowSets valid);

  std::span<const grid::Interval> discretised(int j) const { return discretised_.row(j); }
  const grid::RowSets& discretised() const { return discretised_; }
  /// From the first to the last column that has one.
  const grid::Interval& columns() const { return columns_; }
  std::span<const grid::Interval> valid(int j) const { return valid_.row(j); }
  const grid::RowSets& valid() const { return valid_; }
  /// Points beside discretised ones, -1 <= j <= n2: predicted, but not advanced.
  std::span<const grid::Interval> beside(int j) const { return beside_.row(j + 1); }
  /// Both together, -1 <= j <= n2.
  std::span<const grid::Interval> predicted(int j) const { return predicted_.row(j + 1); }
  /// Faces between rows j - 1 and j with a discretised point on one side, 0 <= j <= n2.
  std::span<const grid::Interval> faces(int j) const { return faces_.row(j); }

  bool is_discretised(int i, int j) const { return discretised_.contains(i, j); }
  bool is_valid(int i, int j) const { return valid_.contains(i, j); }
  std::size_t count() const { return valid_.points(); }

 private:
  grid::RowSets discretised_, valid_, beside_, predicted_, faces_;
  grid::Interval columns_;

  void find_neighbours(const Layout& layout);
};

}  // namespace fsi::solid
