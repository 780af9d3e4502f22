#pragma once
/// Straight mirror line.

#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

struct Symmetry {
  static constexpr GasBoundaryFacts facts{
      .meaning = "mirror images across a straight side", .beyond = Beyond::mirror, .precedence = 2};

  static Symmetry from(const BoundaryData& /*data*/) { return {}; }

  /// No velocity across the side, of the difference to the exact solution where there is one.
  static void set_points(const GasSide& side) {
    const Vec2 normal = straight_normal(side.x, side.points);
    for (int k = 0; k < side.points.n(); ++k) {
      if (side.points.elsewhere(k)) continue;
      StateVector state = load(side.q, side.points.at(k, 0));
      double v_n = normal.dot(Vec2(state.segment<2>(1)));
      if (side.forcing != nullptr) v_n -= normal.dot(Vec2(side.exact(k).segment<2>(1)));
      state.segment<2>(1) -= v_n * normal;
      store(side.q, side.points.at(k, 0), state);
    }
  }

  /// Mirror images, of the difference to the exact solution where there is one.
  static void mirror(const GasSide& side, int reach) {
    const SidePoints& points = side.points;
    if (side.forcing == nullptr) return symmetry_ghosts(side.q, side.x, points, -reach, points.n() + reach);
    const Vec2 n = straight_normal(side.x, points);
    for (int m = 1; m <= Layout::ghosts; ++m) {
      for (int k = -reach; k < points.n() + reach; ++k) {
        if (points.elsewhere(k)) continue;
        StateVector difference = load(side.q, points.at(k, m)) - side.exact(position(side.x, points, k, m));
        difference.segment<2>(1) -= 2 * n.dot(difference.segment<2>(1)) * n;
        store(side.q, points.at(k, -m), side.exact(position(side.x, points, k, -m)) + difference);
      }
    }
  }
};

}  // namespace fsi::fluid
