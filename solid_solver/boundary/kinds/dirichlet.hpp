#pragma once
/// All unknowns given on the side and behind it.

#include <array>

#include "solid_solver/boundary/side_data.hpp"

namespace fsi::solid {

struct Dirichlet {
  static constexpr std::array keys{
      schema::Key{.name = "state",
                  .type = schema::Type::word,
                  .meaning = "where u, v and P come from",
                  .required = true,
                  .words = schema::or_reference},
  };
  static constexpr SolidBoundaryFacts facts{
      .meaning = "u, v and P are imposed, ghost points too", .keys = keys, .holds = Hold::motion};
  static constexpr Condition condition{.ghosts = Condition::Ghosts::state};

  static Boundary from(const SideData& data) { return {.condition = condition, .state = data.exact()}; }
};

}  // namespace fsi::solid
