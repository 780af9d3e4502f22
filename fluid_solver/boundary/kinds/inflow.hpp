#pragma once
/// Gas of a given state comes in. Waves from inside leave as through a far field; the words of the case file say what is meant.

#include "fluid_solver/boundary/far_field.hpp"
#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

struct Inflow {
  StateField state;

  static constexpr GasBoundaryFacts facts{
      .meaning =
          "gas of this state comes in: all of it where it is faster than sound, else along characteristics, "
          "so that waves from inside leave",
      .keys = schema::gas_boundary_state,
      .is_open = true};

  static Inflow from(const BoundaryData& data) { return {data.state}; }

  void set_point(const GasSide& side, int k) const { let_waves_through(side, k, state); }
  static void set_ghosts(const GasSide& side) { extrapolate_ghosts(side); }
};

}  // namespace fsi::fluid
