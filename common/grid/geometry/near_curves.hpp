#pragma once
/// Curves that come near each other: less deep grids where they do.
///
///     )  (      \   |  |  |  |   /      where the way to the next curve is shorter than some five lines, the
///     )  (      _\__|__|__|__|__/_      lines of a grid are drawn towards its own curve, point by point, so
///     )  (      curve                   that five of them stand between the curves as long as there is a way
///
/// Grids of both curves then reach over the whole way, and each finds donors in the other one. What is found
/// depends on the present positions only.

#include <cstddef>
#include <span>
#include <vector>

#include "common/core/types.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/moving_grid.hpp"
#include "common/grid/overlap/composite_grid.hpp"

namespace fsi::grid {

/// A curve and the grid along it.
struct FittedCurve {
  std::vector<double> x;  ///< its n points, component-major, 2 n
  double step = 0;        ///< distance of the grid's lines, their mean; 0: they are not drawn in [length]
};

/// The two curves that are nearest to each other.
struct Approach {
  std::size_t a = 0, b = 0;
  Gap gap;  ///< between them; x on one of them
};

class NearCurves {
 public:
  /// Lines there are to be between two curves at least.
  static constexpr double lines_between = 5;  ///< [-]
  /// The distance from which on a grid is less deep, in distances of its lines.
  static constexpr double onset = 1.25 * lines_between;  ///< [-]

  /// Nearer than that, in cells of the background, no gas is computed between two curves.
  static constexpr double fewest_cells = 0.5;  ///< [-]

  /// Curves that touch in the beginning stay out of this: one body stands on another.
  explicit NearCurves(std::vector<FittedCurve> curves);

  /// Curve k has moved.
  void place(std::size_t k, std::span<const double> x);
  /// Looks at the curves where they are now. Costs the product of their points for two curves within reach
  /// of each other, next to nothing for others.
  void measure();

  /// What is left of the depth of grid k at each point of its curve: in (0, 1], 1 where no other curve is
  /// within reach. Empty: 1 everywhere.
  std::span<const double> part(std::size_t k) const { return parts_[k]; }
  /// The nearest two of those within reach of each other; infinitely far where there are none.
  const Approach& nearest() const { return nearest_; }

 private:
  std::vector<FittedCurve> curves_;
  std::vector<std::vector<double>> parts_;
  std::vector<bool> touching_;  ///< curves a and b at [a * n + b]
  Approach nearest_;
  bool touching(std::size_t a, std::size_t b) const { return touching_[a * curves_.size() + b]; }
  void look(std::size_t a, std::size_t b);
};

/// Where the nearest two curves have less than NearCurves::fewest_cells cells of the background between them.
/// @throws Diverged then: who, how far from whom, where
void report_too_near(const NearCurves& near, const CompositeGrid& composite, double t);

/// The curves of body-fitted grids where they are now; the grids are marched again from them, at time t, with
/// the room they leave each other. @throws Diverged at a folded cell
NearCurves leave_room(std::span<MovingGrid* const> grids, std::span<const BodyFittedGrid> bodies, double t);

}  // namespace fsi::grid
