#pragma once
/// The last line is the first one of the next period.

#include "solid_solver/boundary/side_data.hpp"

namespace fsi::solid {

struct Periodic {
  static constexpr SolidBoundaryFacts facts{.meaning = "continues at the opposite side",
                                            .holds = Hold::others};
  static constexpr Condition condition{.ghosts = Condition::Ghosts::repeated};

  static Boundary from(const SideData& /*data*/) { return {.condition = condition}; }
};

}  // namespace fsi::solid
