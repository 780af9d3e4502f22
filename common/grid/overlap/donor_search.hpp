#pragma once
/// Where in a grid a position lies, and which points of it may give a value there.

#include <optional>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/cartesian_grid.hpp"
#include "common/grid/intervals.hpp"
#include "common/grid/overlap/interpolation.hpp"

namespace fsi::grid {

/// Room for the rounding of positions at the edges of cells and the ends of grids, in cells.
inline constexpr double rounding = 1e-7;

/// Cell between the points (i, j) and (i + 1, j + 1), and about where in it (0 .. 1).
struct CellPosition {
  int i = 0, j = 0;
  double r = 0, s = 0;  ///< [-]
};

/// The cells of a body-fitted grid.
struct CellMap {
  ConstFieldView x;  ///< planes x1, x2
  bool closed = false;

  /// Walks from a cell towards the position, by the sides of its edges on which it lies; the nearest boundary
  /// cell (with r or s outside 0 .. 1) where the grid ends before.
  /// Nothing where the walk does not come to an end.
  std::optional<CellPosition> find(const Vec2& position, int i, int j) const;
  /// Coordinates of a position in the (bi)quadratic map of the
  /// stencil's own points, by Newton from stencil.r, .s.
  /// @returns false where Newton does not converge
  bool invert(const Vec2& position, Stencil& stencil) const;
};

/// Cell of a Cartesian grid, the nearest one for a position outside.
CellPosition find_cell(const CartesianGrid& grid, const Vec2& position);

/// Which of a grid's points may be donors.
struct Donors {
  const RowSets& discretised;
  const RowSets& valid;  ///< discretised or interpolated
  int widest = 3;        ///< points per direction of a stencil

  bool explicit_legal(const Stencil& stencil) const { return all_in(discretised, stencil); }
  bool implicit_legal(const Stencil& stencil) const { return all_in(valid, stencil); }

 private:
  static bool all_in(const RowSets& set, const Stencil& stencil) {
    for (int m = 0; m < stencil.width; ++m) {
      if (!set.contains({stencil.i, stencil.i + stencil.width}, stencil.j + m)) return false;
    }
    return true;
  }
};

/// How far from its stencil a position may lie, in points.
struct Reach {
  double low = 0;   ///< before j = 0 [-]
  double high = 0;  ///< behind j = n2 - 1 [-]
};

/// The best legal stencil for a position: width 3 before width 2, discretised donors before interpolated
/// ones, then the one that has the position most in its middle. Nothing where there is none. `outside`: how
/// far from a Cartesian grid the position may lie, in cells.
std::optional<Stencil> find_stencil(const CartesianGrid& grid, const Donors& donors, const Vec2& position,
                                    double outside);
std::optional<Stencil> find_stencil(const CellMap& cells, const Donors& donors, const Vec2& position,
                                    const CellPosition& near, const Reach& reach);

}  // namespace fsi::grid
