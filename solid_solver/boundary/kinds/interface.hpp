#pragma once
/// The gas is on the other side: values come with apply_solid_bcs.

#include <array>

#include "common/case/schema/load_key.hpp"
#include "solid_solver/boundary/side_data.hpp"

namespace fsi::solid {

struct Interface {
  static constexpr std::array keys{
      schema::load_key,
      schema::Key{.name = "fluid",
                  .type = schema::Type::name,
                  .meaning = "where the case has `fluids`: the gas on the other side",
                  .fallback = "the one gas that names this solid"},
  };
  static constexpr SolidBoundaryFacts facts{
      .meaning = "the gas is on the other side", .keys = keys, .holds = Hold::others};
  static constexpr Condition condition{.traction = Condition::Traction::projected};

  static Boundary from(const SideData& /*data*/) { return {.condition = condition}; }
};

}  // namespace fsi::solid
