#pragma once
/// All four values given on the boundary and behind it.

#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

struct Dirichlet {
  StateField state;

  static constexpr GasBoundaryFacts facts{.meaning = "all values are imposed, ghost points too",
                                          .keys = schema::gas_boundary_state,
                                          .is_open = true,
                                          .precedence = 5};

  static Dirichlet from(const BoundaryData& data) { return {data.state}; }

  void set_points(const GasSide& side) const { given_lines(side.q, side.x, side.points, state, side.t); }
  void set_after_corners(const GasSide& side) const { set_points(side); }
};

}  // namespace fsi::fluid
