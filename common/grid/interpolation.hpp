#pragma once
/// Values carried from grid to grid: lists of points with their donors and weights.

#include <cstdint>
#include <span>
#include <vector>

#include "common/core/field.hpp"

namespace fsi::grid {

/// Where a point takes its value from: width x width points of a donor grid from (i, j) on, weights as a
/// product.
struct Stencil {
  int grid = -1;  ///< donor, -1: none
  int i = 0, j = 0;
  int width = 3;
  bool implicit = false;  ///< some donors are interpolated themselves
  double r = 0, s = 0;    ///< position of the point in the stencil, 0 .. width - 1
};

/// Points of one grid that take their values from one donor grid, structure of arrays; point k has
/// weight[9 k + 3 m + l] (width 3) or weight[4 k + 2 m + l] (width 2) at donor column l, row m.
struct InterpolationList {
  int target_grid = 0, donor_grid = 0, width = 3;
  std::vector<std::int32_t> target;  ///< position in a plane of the target field
  std::vector<std::int32_t> donor;   ///< position of the stencil's first point in a plane of the donor field
  std::vector<double> weight;

  std::size_t size() const { return target.size(); }
  void clear();
  void append(std::ptrdiff_t at, std::ptrdiff_t donor_at, const Stencil& stencil);
};

/// Sets the points of a list in all planes.
void apply(const InterpolationList& list, FieldView target, ConstFieldView donor);

}  // namespace fsi::grid
