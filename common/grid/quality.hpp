#pragma once
/// How good the cells of a grid are.

#include <string>

#include "common/core/field.hpp"

namespace fsi::grid {

struct GridQuality {
  double min_jacobian = 0;        ///< smallest corner area of a cell; negative where folded
  double min_jacobian_ratio = 0;  ///< smallest ratio of a cell's smallest to its largest corner area [-]
  double max_skew = 0;            ///< largest |cos| of a corner's angle: 0 is orthogonal [-]
  double max_aspect = 0;          ///< largest ratio of the lengths of the edges that meet at a corner [-]
};

/// Over all cells; x: planes x1, x2.
GridQuality quality_of(ConstFieldView x);

/// One number for a watcher: the smallest ratio of a corner's area to that of the rectangle with the cell's
/// mean sides. 1 where all cells are rectangles, 0 where one is about to fold, negative where one is folded.
double cell_quality(ConstFieldView x);

/// @throws NumbersBroke naming grid, cell, position, t and the corner area of the first folded cell
void check_cells(ConstFieldView x, const std::string& name, double t);

}  // namespace fsi::grid
