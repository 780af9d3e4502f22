#include "common/grid/overlap/donor_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/core/component_major.hpp"

namespace fsi::grid {

namespace {

/// Twice the area of the triangle a, b, p: positive where p lies to the left of a -> b.
double left_of(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/// Lagrange polynomials and their derivatives at r.
struct Basis {
  std::array<double, 3> value, slope;

  Basis(double r, int width) : value(lagrange_weights(r, width)) {
    if (width == 2) {
      slope = {-1, 1, 0};
    } else {
      slope = {r - 1.5, 2 - 2 * r, r - 0.5};
    }
  }
};

/// Position and derivatives of a stencil's map at (r, s).
struct MapAt {
  Vec2 x = Vec2::Zero(), x_r = Vec2::Zero(), x_s = Vec2::Zero();

  MapAt(ConstFieldView grid, const Stencil& at) {
    const Basis along(at.r, at.width), across(at.s, at.width);
    for (std::size_t m = 0; m < static_cast<std::size_t>(at.width); ++m) {
      Vec2 row = Vec2::Zero(), row_r = Vec2::Zero();
      for (std::size_t l = 0; l < static_cast<std::size_t>(at.width); ++l) {
        const Vec2 node = vector_at(grid, at.i + static_cast<int>(l), at.j + static_cast<int>(m));
        row += along.value[l] * node;
        row_r += along.slope[l] * node;
      }
      x += across.value[m] * row;
      x_r += across.value[m] * row_r;
      x_s += across.slope[m] * row;
    }
  }
};

/// First points of the stencils of a width that contain cell `cell`, the better centred one first.
struct Bases {
  std::array<int, 2> first{};
  int count = 0;

  Bases(int cell, double part, int width, int n) {
    if (width == 2) {
      add(cell, width, n);
      return;
    }
    const bool lower = part < 0.5;
    add(lower ? cell - 1 : cell, width, n);
    add(lower ? cell : cell - 1, width, n);
  }

 private:
  void add(int base, int width, int n) {
    if (base >= 0 && base + width <= n) first[static_cast<std::size_t>(count++)] = base;
  }
};

/// Tries the stencils around a cell in order of preference, those that shift least first, so that a turned
/// grid has turned stencils; `place` sets r and s and says whether the position is in reach.
template <class Place>
std::optional<Stencil> first_legal(const Layout& shape, const Donors& donors, const CellPosition& cell,
                                   Place&& place) {
  const bool rows_first = std::abs(cell.s - 0.5) < std::abs(cell.r - 0.5);
  for (int width = donors.widest; width >= 2; --width) {
    const Bases columns(cell.i, cell.r, width, shape.n1), rows(cell.j, cell.s, width, shape.n2);
    for (const bool implicit : {false, true}) {
      for (int c = 0; c < columns.count * rows.count; ++c) {
        const int column = rows_first ? c / rows.count : c % columns.count;
        const int row = rows_first ? c % rows.count : c / columns.count;
        Stencil stencil{.grid = -1,
                        .i = columns.first[static_cast<std::size_t>(column)],
                        .j = rows.first[static_cast<std::size_t>(row)],
                        .width = width,
                        .implicit = implicit};
        if (!(implicit ? donors.implicit_legal(stencil) : donors.explicit_legal(stencil))) continue;
        if (place(stencil)) return stencil;
      }
    }
  }
  return {};
}

}  // namespace

std::optional<CellPosition> CellMap::find(const Vec2& position, int i, int j) const {
  const int cells1 = x.layout.n1 - 1, cells2 = x.layout.n2 - 1;
  i = std::clamp(i, 0, cells1 - 1);
  j = std::clamp(j, 0, cells2 - 1);
  int i_before = -1, j_before = -1;
  for (int step = 0; step < 2 * (cells1 + cells2); ++step) {
    const Vec2 a = vector_at(x, i, j), b = vector_at(x, i + 1, j), c = vector_at(x, i, j + 1),
               d = vector_at(x, i + 1, j + 1);
    const double below = left_of(a, b, position), above = left_of(c, d, position);
    const double before = -left_of(a, c, position), after = -left_of(b, d, position);
    int i_next = i + (before < 0 ? -1 : after >= 0 ? 1 : 0);
    if (closed) i_next = (i_next + cells1) % cells1;
    i_next = std::clamp(i_next, 0, cells1 - 1);
    const int j_next = std::clamp(j + (below < 0 ? -1 : above >= 0 ? 1 : 0), 0, cells2 - 1);
    // A position on an edge may be on the wrong side of it for both cells, by round-off: either one will do.
    if ((i_next == i && j_next == j) || (i_next == i_before && j_next == j_before)) {
      return CellPosition{.i = i, .j = j, .r = before / (before - after), .s = below / (below - above)};
    }
    i_before = std::exchange(i, i_next);
    j_before = std::exchange(j, j_next);
  }
  return {};
}

bool CellMap::invert(const Vec2& position, Stencil& stencil) const {
  constexpr int most_iterations = 12;
  constexpr double converged = 1e-7;  // the step after such a one would be its square: round-off
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const MapAt map(x, stencil);
    const Vec2 miss = position - map.x;
    const double area = map.x_r[0] * map.x_s[1] - map.x_r[1] * map.x_s[0];
    const double dr = (miss[0] * map.x_s[1] - miss[1] * map.x_s[0]) / area;
    const double ds = (map.x_r[0] * miss[1] - map.x_r[1] * miss[0]) / area;
    stencil.r += dr;
    stencil.s += ds;
    if (!(std::abs(stencil.r) < 10 && std::abs(stencil.s) < 10)) return false;
    if (std::abs(dr) + std::abs(ds) < converged) return true;
  }
  return false;
}

CellPosition find_cell(const CartesianGrid& grid, const Vec2& position) {
  const double r = (position[0] - grid.x_a) / grid.dx(), s = (position[1] - grid.y_a) / grid.dy();
  const int i = static_cast<int>(std::clamp(std::floor(r), 0.0, grid.n1 - 2.0));
  const int j = static_cast<int>(std::clamp(std::floor(s), 0.0, grid.n2 - 2.0));
  return {.i = i, .j = j, .r = r - i, .s = s - j};
}

std::optional<Stencil> find_stencil(const CartesianGrid& grid, const Donors& donors, const Vec2& position,
                                    double outside) {
  const CellPosition cell = find_cell(grid, position);
  const double room = outside + rounding;
  const auto far = [room](double part) { return !(part >= -room && part <= 1 + room); };
  if (far(cell.r) || far(cell.s)) return {};
  return first_legal(grid.layout(), donors, cell, [&](Stencil& stencil) {
    stencil.r = cell.i - stencil.i + cell.r;
    stencil.s = cell.j - stencil.j + cell.s;
    return true;
  });
}

std::optional<Stencil> find_stencil(const CellMap& cells, const Donors& donors, const Vec2& position,
                                    const CellPosition& near, const Reach& reach) {
  // Far from its nearest cell a position is not in the grid, and Newton has no business there.
  if (!(std::abs(near.r - 0.5) < 2.5 && std::abs(near.s - 0.5) < 2.5)) return {};
  const int n1 = cells.x.layout.n1, n2 = cells.x.layout.n2;
  return first_legal(cells.x.layout, donors, near, [&](Stencil& stencil) {
    stencil.r = near.i - stencil.i + near.r;
    stencil.s = near.j - stencil.j + near.s;
    if (!cells.invert(position, stencil)) return false;
    // Inside the grid a quadratic map may bend a little over the
    // cell's straight edges; only the grid's ends are hard.
    constexpr double bend = 0.1;
    const double last = stencil.width - 1;
    const bool first_column = stencil.i == 0 && !cells.closed, first_row = stencil.j == 0;
    const bool last_column = stencil.i + stencil.width == n1 && !cells.closed,
               last_row = stencil.j + stencil.width == n2;
    return stencil.r >= -(first_column ? rounding : bend) &&
           stencil.r <= last + (last_column ? rounding : bend) &&
           stencil.s >= -(first_row ? rounding + reach.low : bend) &&
           stencil.s <= last + (last_row ? rounding + reach.high : bend);
  });
}

}  // namespace fsi::grid
