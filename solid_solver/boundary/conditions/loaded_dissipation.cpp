#include "solid_solver/boundary/conditions/loaded_dissipation.hpp"

#include <cstddef>

#include "solid_solver/kernels/sweep/dissipation.hpp"

namespace fsi::solid {
namespace {

/// The gradient of u with which (40) was taken at a point.
template <class Gradient>
Tensor2 gradient_in_sweep(const BoundaryGrid& grid, ConstFieldView q, const GridPoint& p) {
  const WideRow u1(q, plane::u1, p.j), u2(q, plane::u2, p.j);
  return Gradient(grid.x, *grid.metrics, p.j)(p.i, u1.first(p.i), u2.first(p.i));
}

void add_displacement(FieldView next, std::ptrdiff_t at, double factor, Pair change) {
  next.plane(plane::u1)[at] += factor * change.x;
  next.plane(plane::u2)[at] += factor * change.y;
}

template <class Gradient>
void correct(const Sides& sides, ConstFieldView q, FieldView next, double beta) {
  const double factor = 0.5 * beta;
  const BoundaryGrid& grid = sides.grid();
  for (const Side side : all_sides) {
    if (!sides.loaded(side)) continue;
    const SideIndex& line = sides.line(side);
    const int step = at_upper_end(side) ? -1 : 1;
    const bool first = direction_of(side) == 0;
    for (const int k : sides.points(side)) {
      const GridPoint own = grid_point(sides.layout(), side, k);
      const GridPoint next_one = {first ? own.i + step : own.i, first ? own.j : own.j + step};
      const auto across = [&](const double* values) {
        const auto at = [&](int m) { return values[line.at(k, m)]; };
        return fourth_difference(at(-2), at(-1), at(0), at(1), at(2));
      };
      const Pair D4_u = beyond_linear<Gradient>({across(q.plane(plane::u1)), across(q.plane(plane::u2))},
                                                gradient_in_sweep<Gradient>(grid, q, own),
                                                {across(grid.x.plane(0)), across(grid.x.plane(1))});
      add_displacement(next, line.at(k, 0), factor, D4_u);

      const double unlike = 1.0 - squareness(sides.at(side, k));
      if (unlike == 0 || !grid.points->is_discretised(next_one.i, next_one.j)) continue;
      const auto beyond = [&](const double* values, Limiter limiter) {
        const auto at = [&](int m) { return values[line.at(k, m)]; };
        return fourth_difference(at(-1) - extrapolated(at(0), at(1), at(2), at(3), limiter), 0, 0, 0, 0);
      };
      const Pair D4_ghost = beyond_linear<Gradient>(
          {beyond(q.plane(plane::u1), sides.limiter()), beyond(q.plane(plane::u2), sides.limiter())},
          gradient_in_sweep<Gradient>(grid, q, next_one),
          {beyond(grid.x.plane(0), Limiter::none), beyond(grid.x.plane(1), Limiter::none)});
      add_displacement(next, line.at(k, 1), factor * unlike, D4_ghost);
    }
  }
}

}  // namespace

void correct_displacement_dissipation(const Sides& sides, ConstFieldView q, FieldView next, double beta) {
  if (sides.grid().metrics->cartesian()) return correct<CartesianGradient4>(sides, q, next, beta);
  return correct<MappedGradient4>(sides, q, next, beta);
}

}  // namespace fsi::solid
