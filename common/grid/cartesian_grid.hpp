#pragma once
/// A Cartesian background grid: no stored vertices, no metrics.

#include <string>

#include "common/core/field.hpp"
#include "common/core/types.hpp"

namespace fsi::grid {

struct CartesianGrid {
  std::string name = "background";
  int n1 = 0, n2 = 0;                         ///< points, both ends included
  double x_a = 0, x_b = 1, y_a = 0, y_b = 1;  ///< [length]

  double dx() const { return (x_b - x_a) / (n1 - 1); }
  double dy() const { return (y_b - y_a) / (n2 - 1); }
  double x(int i) const { return x_a + i * dx(); }
  double y(int j) const { return y_a + j * dy(); }
  Vec2 point(int i, int j) const { return {x(i), y(j)}; }
  Layout layout() const { return {n1, n2}; }
};

}  // namespace fsi::grid
