#pragma once
/// Nothing given: what leaves is extrapolated, what would enter is taken as undisturbed.

#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

struct Outflow {
  static constexpr GasBoundaryFacts facts{.meaning = "extrapolation", .is_open = true};

  static Outflow from(const BoundaryData& /*data*/) { return {}; }

  static void set_ghosts(const GasSide& side) {
    side.bounded += outflow_ghosts(side.q, side.x, side.points, side.motion.velocity, side.options);
  }
};

}  // namespace fsi::fluid
