#pragma once
/// The last point of a line is the first point of the next period.

#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

struct Periodic {
  static constexpr GasBoundaryFacts facts{
      .meaning = "continues at the opposite side", .beyond = Beyond::period, .precedence = 6};

  static Periodic from(const BoundaryData& /*data*/) { return {}; }

  static void set_points(const GasSide& side) {
    const SidePoints& points = side.points;
    if (!at_upper_end(points.side())) return;
    for (int k = 0; k < points.n(); ++k) {
      if (!points.elsewhere(k)) store(side.q, points.at(k, 0), load(side.q, points.at(k, points.depth())));
    }
  }

  static void mirror(const GasSide& side, int reach) {
    periodic_ghosts(side.q, side.points, -reach, side.points.n() + reach);
  }
};

}  // namespace fsi::fluid
