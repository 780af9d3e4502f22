#pragma once
/// Which points of a Cartesian grid lie behind a curve.
///
///      row j   . . . . | x x x x | . . .      |  crossing of the row with the curve, which knows its segment
///
/// Each segment meets a few rows; the crossings of a row, in order, are the ends of its holes. The side of a
/// point is that against the polygon of the curve's points,
/// the first line of the cells of its body-fitted grid.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/grid/cartesian_grid.hpp"
#include "common/grid/geometry/interface_geometry.hpp"
#include "common/grid/intervals.hpp"

namespace fsi::grid {

/// A curve that bounds the domain.
struct CuttingCurve {
  const double *x = nullptr, *y = nullptr;
  int points = 0;
  Curve ends = Curve::closed;  ///< open: both ends lie on the boundary of the Cartesian grid
  bool domain_left = true;     ///< the domain lies to the left of the direction of increasing index
  bool on_wall = false;        ///< open: its ends stand on another curve; it is closed behind that one
};

/// Where a row meets the curve: between columns `column` - 1 and `column`.
struct Crossing {
  int row = 0, column = 0;
  int segment = 0;         ///< of the curve, from its point `segment` to the next
  double x = 0;            ///< [length]
  bool into_hole = false;  ///< going towards larger x
};

/// Where what lies behind the curve passes between two neighbouring points, both of which belong to the domain: a body
/// thinner than a cell.
struct Pinch {
  int direction = 0;  ///< 0: between (i - 1, j) and (i, j); 1: between (i, j - 1) and (i, j)
  int i = 0, j = 0;
  double middle = 0;  ///< of what lies between them, from the first point to the second one [cells]
};

/// The side of a Cartesian grid's points against one curve.
class CurveCut {
 public:
  /// Recomputes everything for the curve where it is. @throws Diverged where an open curve does not end
  /// on the boundary of the grid, or a curve leaves it unclear which part is the domain
  void cut(const CartesianGrid& grid, const CuttingCurve& curve, const std::string& name, double t);

  std::span<const Crossing> crossings(int row) const {
    const auto k = static_cast<std::size_t>(row);
    return {sorted_.data() + first_[k], first_[k + 1] - first_[k]};
  }
  /// Appends the points of a row that lie behind the curve to `parts`, sorted and disjoint.
  void append_holes(int row, int n1, std::vector<Interval>& parts) const;
  std::span<const Pinch> pinches() const { return pinches_; }
  /// Crossing nearest to point (i, j) within `reach` rows, null where there is none.
  const Crossing* nearest(int i, int j, int reach) const;
  /// Is a position within the grid behind the curve? Cheap away from the curve.
  bool behind(const CartesianGrid& grid, const Vec2& position) const;

 private:
  /// Change of side along the grid's left boundary between rows `row` - 1 and `row`.
  struct Flip {
    int row = 0;
    double y = 0;            ///< [length]
    bool into_hole = false;  ///< going towards larger y
  };

  struct Segment {
    Vec2 a, b;
  };
  /// Where a column meets the curve.
  struct ColumnCrossing {
    int column = 0;
    double y = 0;            ///< [length]
    bool into_hole = false;  ///< going towards larger y
  };

  bool domain_left_ = true;
  std::vector<Vec2> cutting_;  ///< the curve's points, as they cut
  std::vector<Segment> segments_;
  std::vector<Crossing> crossings_, sorted_;
  std::vector<std::size_t> first_;
  std::vector<Flip> flips_;
  std::vector<ColumnCrossing> of_columns_;  ///< work memory
  std::vector<Pinch> pinches_;
  std::vector<unsigned char> starts_behind_;  ///< the side of each row before its first crossing

  int depth(int i, int row) const;
  void collect(const CartesianGrid& grid, const CuttingCurve& curve, const std::string& name, double t);
  void withdraw(const CartesianGrid& grid, const CuttingCurve& curve);
  void add_segment(const CartesianGrid& grid, const Vec2& a, const Vec2& b, int segment);
  void sort_by_rows(int rows);
  void drop_touches(double tolerance);
  void find_pinches(const CartesianGrid& grid);
  void cross_columns(const CartesianGrid& grid);
  void find_hidden(const CartesianGrid& grid, const CuttingCurve& curve);
  bool is_pinched_near(int i, int j) const;
  void find_starts(const CartesianGrid& grid, const CuttingCurve& curve, const std::string& name, double t);
  bool are_rows_behind(const CartesianGrid& grid, const CuttingCurve& curve, const std::string& name,
                       double t) const;
};

}  // namespace fsi::grid
