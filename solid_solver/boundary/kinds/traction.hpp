#pragma once
/// A given traction.

#include <array>

#include "common/case/schema/load_key.hpp"
#include "solid_solver/boundary/side_data.hpp"

namespace fsi::solid {

struct Traction {
  static constexpr std::array keys{
      schema::Key{.name = "value",
                  .type = schema::Type::vector,
                  .meaning = "traction per unit area",
                  .unit = "pressure",
                  .required = true,
                  .words = schema::or_reference},
      schema::load_key,
  };
  static constexpr SolidBoundaryFacts facts{
      .meaning = "the traction is imposed", .keys = keys, .word_for_zero = "free"};
  static constexpr Condition condition{.traction = Condition::Traction::given};

  static Boundary from(const SideData& data) {
    return {.condition = condition, .vector = data.from_reference ? data.exact_traction() : data.value};
  }
};

}  // namespace fsi::solid
