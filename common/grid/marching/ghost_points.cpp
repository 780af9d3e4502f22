#include "common/grid/marching/ghost_points.hpp"

#include "common/core/types.hpp"

namespace fsi::grid {

namespace {

Vec2 point(ConstFieldView x, int i, int j) {
  return {x(0, i, j), x(1, i, j)};
}

void set(FieldView x, int i, int j, const Vec2& place) {
  x(0, i, j) = place[0];
  x(1, i, j) = place[1];
}

/// What continues x0, x1, x2 (from near to far) one step outward, third order.
Vec2 continued(const Vec2& x0, const Vec2& x1, const Vec2& x2) {
  return 3 * (x0 - x1) + x2;
}

/// The same with a bounded change of the step.
Vec2 continued_within_bounds(const Vec2& x0, const Vec2& x1, const Vec2& x2) {
  const Vec2 step = x0 - x1, change = step - (x1 - x2);
  const double most = largest_change_of_step * step.norm(), size = change.norm();
  return size <= most ? continued(x0, x1, x2) : Vec2(x0 + step + most / size * change);
}

void continue_line(FieldView x, int j, Curve lines) {
  const int last = x.layout.n1 - 1;
  for (int g = 1; g <= Layout::ghosts; ++g) {
    if (lines == Curve::closed) {
      set(x, -g, j, point(x, last - g, j));
      set(x, last + g, j, point(x, g, j));
    } else {
      set(x, -g, j, continued_within_bounds(point(x, 1 - g, j), point(x, 2 - g, j), point(x, 3 - g, j)));
      set(x, last + g, j,
          continued_within_bounds(point(x, last - 1 + g, j), point(x, last - 2 + g, j),
                                  point(x, last - 3 + g, j)));
    }
  }
}

}  // namespace

void fill_ghosts(FieldView x, Curve lines) {
  const int last = x.layout.n2 - 1;
  for (int j = 0; j <= last; ++j) continue_line(x, j, lines);
  for (int g = 1; g <= Layout::ghosts; ++g) {
    for (int i = -Layout::ghosts; i < x.layout.n1 + Layout::ghosts; ++i) {
      set(x, i, -g, continued(point(x, i, 1 - g), point(x, i, 2 - g), point(x, i, 3 - g)));
      set(x, i, last + g,
          continued(point(x, i, last - 1 + g), point(x, i, last - 2 + g), point(x, i, last - 3 + g)));
    }
  }
}

}  // namespace fsi::grid
