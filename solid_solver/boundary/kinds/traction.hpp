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

  static Boundary from(const SideData& data) {
    return {.kind = Boundary::Kind::traction,
            .vector = data.from_reference ? data.exact_traction() : data.value};
  }
};

}  // namespace fsi::solid
