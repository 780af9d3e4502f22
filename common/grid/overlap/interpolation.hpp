#pragma once
/// Values carried from grid to grid: lists of points with their donors and weights.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/field.hpp"

namespace fsi::grid {

/// Where a point takes its value from: width x width points of a donor grid from (i, j) on.
struct Stencil {
  int grid = -1;  ///< donor
  int i = 0, j = 0;
  int width = 3;
  bool implicit = false;  ///< some donors are interpolated themselves
  double r = 0, s = 0;    ///< position of the point in the stencil, in points from (i, j) [-]
};

/// Weights of equidistant points 0, 1, 2 (width 3, quadratic) or 0, 1 (width 2, linear) for a value at r.
std::array<double, 3> lagrange_weights(double r, int width);

/// Points of one grid that take their values from one donor grid; structure of arrays. Point k has weight
/// weight[width^2 k + width m + l] at column l, row m of its stencil.
struct InterpolationList {
  int target_grid = 0, donor_grid = 0, width = 3;
  bool implicit = false;
  std::vector<std::int32_t> target;  ///< position in a plane of the target field
  std::vector<std::int32_t> donor;   ///< position of the stencil's first point in a plane of the donor field
  std::vector<double> weight;
  std::vector<std::array<double, 2>> x{};  ///< implicit: where the points are, for messages

  std::size_t size() const { return target.size(); }
  void clear();
  void reserve(std::size_t points);
  void append(std::ptrdiff_t at, std::ptrdiff_t donor_at, const Stencil& stencil,
              const std::array<double, 2>& place = {});
  void move(std::size_t from, std::size_t to);  ///< an entry, over another one
  void cut(std::size_t points);                 ///< leaves the first ones
  bool operator==(const InterpolationList&) const = default;
};

/// Sets the points of a list in all planes; one field per grid.
void apply(const InterpolationList& list, std::span<const FieldView> fields);

/// Sets the points of the implicit lists, which are donors of each other, to their common solution: sweeps
/// over the lists until nothing changes but the last digits of each plane, whatever its unit. Does where their weights on one another add up
/// to less than about a half in size; ImplicitSystem decides. @returns whether they settled within 50 sweeps
bool settle_implicit(std::span<const InterpolationList> lists, std::span<const FieldView> fields);

}  // namespace fsi::grid
