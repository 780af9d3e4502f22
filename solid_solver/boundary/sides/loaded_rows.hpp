#pragma once
/// Rows of numbers for loops over the discretised points of loaded sides.

#include <array>
#include <vector>

#include "common/core/field.hpp"
#include "solid_solver/boundary/sides/sides.hpp"
#include "solid_solver/kernels/side_rows.hpp"

namespace fsi::solid {

/// The rows have all discretised points of a side, also where a rank has only some: the same loops give the same bits.
class LoadedRows {
 public:
  explicit LoadedRows(const Sides& sides) { lay_out(sides); }

  /// Anew, with the geometry of the sides and nothing else.
  void lay_out(const Sides& sides);
  SideRows of(Side side) { return {rows_[Sides::index(side)].view()}; }
  /// Place of a discretised point in the rows of its side.
  std::size_t slot(Side side, int k) const { return slots_[Sides::index(side)][static_cast<std::size_t>(k)]; }

 private:
  std::array<Field, 4> rows_;
  std::array<std::vector<std::size_t>, 4> slots_;
};

}  // namespace fsi::solid
