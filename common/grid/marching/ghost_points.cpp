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
double continued(double x0, double x1, double x2) {
  return 3 * (x0 - x1) + x2;
}

/// The same of points, with a bounded change of the step.
Vec2 continued_within_bounds(const Vec2& x0, const Vec2& x1, const Vec2& x2) {
  const Vec2 step = x0 - x1, change = step - (x1 - x2);
  const double most = largest_change_of_step * step.norm(), size = change.norm();
  if (size > most) return x0 + step + most / size * change;
  return {continued(x0[0], x1[0], x2[0]), continued(x0[1], x1[1], x2[1])};
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

/// Line j from the three lines that go `step` rows away from it.
void continue_across(FieldView x, int j, int step) {
  for (const int c : {0, 1}) {
    double* to = x.row(c, j);
    const double *x0 = x.row(c, j + step), *x1 = x.row(c, j + 2 * step), *x2 = x.row(c, j + 3 * step);
    for (int i = -Layout::ghosts; i < x.layout.n1 + Layout::ghosts; ++i)
      to[i] = continued(x0[i], x1[i], x2[i]);
  }
}

}  // namespace

void fill_ghosts(FieldView x, Curve lines) {
  const int last = x.layout.n2 - 1;
  for (int j = 0; j <= last; ++j) continue_line(x, j, lines);
  for (int g = 1; g <= Layout::ghosts; ++g) {
    continue_across(x, -g, 1);
    continue_across(x, last + g, -1);
  }
}

}  // namespace fsi::grid
