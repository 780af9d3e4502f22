#pragma once
/// All four values given on the boundary; what lies behind is extrapolated.

#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

struct Imposed {
  StateField state;

  static constexpr GasBoundaryFacts facts{
      .meaning = "all four values are imposed; waves from inside are reflected",
      .keys = schema::gas_boundary_state,
      .is_open = true,
      .precedence = 3};

  static Imposed from(const BoundaryData& data) { return {data.state}; }

  void set_point(const GasSide& side, int k) const {
    const Vec2 place = position(side.x, side.points, k, 0);
    store(side.q, side.points.at(k, 0), to_vector(state(place[0], place[1], side.t)));
  }
  static void set_ghosts(const GasSide& side) { extrapolate_ghosts(side); }
};

}  // namespace fsi::fluid
