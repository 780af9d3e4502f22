#pragma once
/// A given state beyond the boundary: what comes in along characteristics is its, what goes out leaves.

#include "fluid_solver/boundary/far_field.hpp"
#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

struct FarField {
  StateField state;

  static constexpr GasBoundaryFacts facts{
      .meaning = "what comes in along characteristics is that of the state, what goes out leaves",
      .keys = schema::gas_boundary_state,
      .is_open = true};

  static FarField from(const BoundaryData& data) { return {data.state}; }

  void set_point(const GasSide& side, int k) const { let_waves_through(side, k, state); }
  static void set_ghosts(const GasSide& side) { extrapolate_ghosts(side); }
};

}  // namespace fsi::fluid
