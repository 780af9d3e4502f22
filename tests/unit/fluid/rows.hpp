#pragma once
/// Small grids and scratch rows for the tests of the row kernels.

#include <functional>

#include "common/core/types.hpp"
#include "fluid_solver/kernels/flow_rows.hpp"

namespace fsi::fluid::test {

inline constexpr int n1 = 9, n2 = 7;
inline constexpr double dt = 0.03;

/// Positions of a grid, ghosts included.
inline Field points(const std::function<Vec2(double i, double j)>& position) {
  Field x(Layout(n1, n2), 2);
  for (int j = -2; j < n2 + 2; ++j) {
    for (int i = -2; i < n1 + 2; ++i) {
      const Vec2 at = position(i, j);
      x(0, i, j) = at.x();
      x(1, i, j) = at.y();
    }
  }
  return x;
}

/// Scratch rows that live as long as the object.
class Scratch {
 public:
  double* row() { return rows_.view().row(0, next_++); }
  MetricRow metric() { return {row(), row(), row(), row(), row(), row(), row()}; }
  CornerRow corners() { return {row(), row(), row(), row()}; }
  FaceRow faces() { return {row(), row(), row(), row()}; }

 private:
  Field rows_{Layout(n1, 60), 1};
  int next_ = 0;
};

/// A sheared grid whose cells all look alike, and which moves on as a whole.
struct ShearedGrid {
  Vec2 along_r1{0.1, 0.02}, along_r2{-0.03, 0.2}, velocity{0.7, -0.4};
  Field at(double t) const {
    return points([&](double i, double j) -> Vec2 { return i * along_r1 + j * along_r2 + t * velocity; });
  }
  /// Of every cell.
  double volume() const { return along_r1.x() * along_r2.y() - along_r1.y() * along_r2.x(); }
};

}  // namespace fsi::fluid::test
