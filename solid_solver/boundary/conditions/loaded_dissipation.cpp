#include "solid_solver/boundary/conditions/loaded_dissipation.hpp"

#include "solid_solver/kernels/sweep/dissipation.hpp"

namespace fsi::solid {

void correct_displacement_dissipation(const Sides& sides, ConstFieldView q, FieldView next, double beta) {
  const double factor = 0.5 * beta;
  for (const Side side : all_sides) {
    if (!sides.loaded(side)) continue;
    const SideIndex& line = sides.line(side);
    for (const int k : sides.points(side)) {
      const auto [i, j] = grid_point(sides.layout(), side, k);
      const int step = at_upper_end(side) ? -1 : 1;
      const bool first = direction_of(side) == 0;
      const bool has_next = sides.grid().points->is_discretised(first ? i + step : i, first ? j : j + step);
      const double unlike = has_next ? factor * (1.0 - squareness(sides.at(side, k))) : 0.0;
      for (int p = plane::u1; p <= plane::u2; ++p) {
        const double* values = q.plane(p);
        const auto u = [&](int m) { return values[line.at(k, m)]; };
        const double beyond = u(-1) - extrapolated(u(0), u(1), u(2), u(3), sides.limiter());
        next.plane(p)[line.at(k, 0)] += factor * fourth_difference(u(-2), u(-1), u(0), u(1), u(2));
        next.plane(p)[line.at(k, 1)] += unlike * fourth_difference(beyond, 0, 0, 0, 0);
      }
    }
  }
}

}  // namespace fsi::solid
