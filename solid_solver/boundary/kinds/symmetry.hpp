#pragma once
/// Straight mirror line.

#include "solid_solver/boundary/side_data.hpp"

namespace fsi::solid {

struct Symmetry {
  static constexpr SolidBoundaryFacts facts{.meaning = "mirror images across a straight side",
                                            .holds = Hold::normal};
  static constexpr Condition condition{.motion = Condition::Motion::along_wall,
                                       .ghosts = Condition::Ghosts::mirrored};

  static Boundary from(const SideData& /*data*/) { return {.condition = condition}; }
};

}  // namespace fsi::solid
