#pragma once
/// A wall along which the solid slides.

#include "solid_solver/boundary/side_data.hpp"

namespace fsi::solid {

struct SlipWall {
  static constexpr SolidBoundaryFacts facts{.meaning = "no displacement along the normal, no shear",
                                            .holds = Hold::normal};
  static constexpr Condition condition{.motion = Condition::Motion::along_wall};

  static Boundary from(const SideData& /*data*/) { return {.condition = condition}; }
};

}  // namespace fsi::solid
