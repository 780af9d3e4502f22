#include "common/grid/marching/ghost_points.hpp"

#include <algorithm>

#include "common/core/component_major.hpp"
#include "common/core/types.hpp"

namespace fsi::grid {

namespace {

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
      set(x, -g, j, vector_at(x, last - g, j));
      set(x, last + g, j, vector_at(x, g, j));
    } else {
      set(x, -g, j,
          continued_within_bounds(vector_at(x, 1 - g, j), vector_at(x, 2 - g, j), vector_at(x, 3 - g, j)));
      set(x, last + g, j,
          continued_within_bounds(vector_at(x, last - 1 + g, j), vector_at(x, last - 2 + g, j),
                                  vector_at(x, last - 3 + g, j)));
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

/// The part of their way behind line j that ghost points go at point i, where the lines across shall keep the distance
/// `least_ghost_distance`: the whole, but where they come nearer; that distance is linear in the part.
/// @param out  rows to the first line of ghosts
double part_of_way(ConstFieldView x, int i, int j, int out) {
  const Vec2 across = vector_at(x, i, j + 2 * out) - vector_at(x, i, j);
  const double own = cross(vector_at(x, i + 1, j) - vector_at(x, i - 1, j), across),
               behind = cross(vector_at(x, i + 1, j + out) - vector_at(x, i - 1, j + out), across);
  if ((own - behind) * own <= (1 - least_ghost_distance) * own * own) return 1;
  return (1 - least_ghost_distance) * own / (own - behind);
}

/// Behind a sharp corner, around which they fan out, lines across the curve would cross at the ghost points, whose cells
/// have no area then: these go less far there.
void keep_apart(FieldView x, int j, int out, Curve lines) {
  const int first = -1, last = x.layout.n1;
  double before = 1, here = part_of_way(x, first, j, out);
  for (int i = first; i <= last; ++i) {
    const double next = i < last ? part_of_way(x, i + 1, j, out) : 1, part = std::min({before, here, next});
    before = here;
    here = next;
    if (part == 1) continue;
    const Vec2 own = vector_at(x, i, j);
    for (int g = 1; g <= Layout::ghosts; ++g)
      set(x, i, j + g * out, own + part * (vector_at(x, i, j + g * out) - own));
  }
  for (int g = 1; lines == Curve::closed && g <= Layout::ghosts; ++g) continue_line(x, j + g * out, lines);
}

}  // namespace

void fill_ghosts(FieldView x, Curve lines) {
  const int last = x.layout.n2 - 1;
  for (int j = 0; j <= last; ++j) continue_line(x, j, lines);
  for (int g = 1; g <= Layout::ghosts; ++g) {
    continue_across(x, -g, 1);
    continue_across(x, last + g, -1);
  }
  keep_apart(x, 0, -1, lines);
  keep_apart(x, last, 1, lines);
}

}  // namespace fsi::grid
