#pragma once
/// A given displacement.

#include <array>

#include "solid_solver/boundary/side_data.hpp"

namespace fsi::solid {

struct Displacement {
  static constexpr std::array keys{
      schema::Key{.name = "value",
                  .type = schema::Type::vector,
                  .meaning = "displacement",
                  .unit = "length",
                  .required = true,
                  .words = schema::or_reference},
      schema::Key{.name = "velocity",
                  .type = schema::Type::vector,
                  .meaning = "its time derivative",
                  .unit = "velocity",
                  .fallback = "by differences of `value`"},
  };
  static constexpr SolidBoundaryFacts facts{.meaning = "the displacement is imposed",
                                            .keys = keys,
                                            .holds = Hold::motion,
                                            .word_for_zero = "clamped"};
  static constexpr Condition condition{.motion = Condition::Motion::given};

  static Boundary from(const SideData& data) {
    Boundary result{.condition = condition};
    if (data.from_reference) {
      const StateFunction exact = data.exact();
      result.vector = [exact](double x, double y, double t) { return exact(x, y, t).u; };
      result.velocity = [exact](double x, double y, double t) { return exact(x, y, t).v; };
    } else if (data.value) {
      result.vector = data.value;
      result.velocity = data.velocity ? data.velocity : rate_of(data.value, data.time_scale);
    }
    return result;
  }
};

}  // namespace fsi::solid
