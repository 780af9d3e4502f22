#pragma once
/// What kinds of boundaries tell those who ask before anything is computed: the schema and the reader of the case file, its
/// checks, budgets, levels, rigid bodies and beams. Each kind states it once, in its file in fluid_solver/boundary/kinds or
/// solid_solver/boundary/kinds.

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "common/case/schema/schema.hpp"
#include "common/core/boundary_kinds.hpp"

namespace fsi {

/// What lies beyond a side of a grid, as far as it must agree with what is inside.
enum class Beyond { other, mirror, period };

/// Of a boundary of the gas.
struct GasBoundaryFacts {
  std::string_view meaning;                ///< for docs/case_file.md
  std::span<const schema::Key> keys = {};  ///< its own, besides `kind`
  bool is_open = false;                    ///< gas crosses it: its points conserve nothing
  bool is_wall = false;                    ///< impermeable, and where the grid is
  bool meets_solid = false;                ///< and moves with it
  Beyond beyond = Beyond::other;
  int precedence = 4;  ///< a point of two sides is that of the greater one [-]
};

/// What becomes of a side of a solid under the loads of the body.
enum class Hold {
  nothing,  ///< it goes where they take it
  normal,   ///< it slides along itself, as along a wall
  motion,   ///< its motion is given, whatever they are
  others    ///< what lies beyond says so: the gas, the opposite side
};

/// Of a boundary of a solid.
struct SolidBoundaryFacts {
  std::string_view meaning;                ///< for docs/case_file.md
  std::span<const schema::Key> keys = {};  ///< its own, besides `kind`
  Hold holds = Hold::nothing;
  std::string_view word_for_zero = {};  ///< stands for this kind with `value: [0, 0]`
};

namespace schema {

/// Of a kind of boundary that is one of the gas, or of a solid.
const GasBoundaryFacts& gas_boundary(BoundaryKind kind);
const SolidBoundaryFacts& solid_boundary(BoundaryKind kind);
/// The kind of a solid's boundary that this word stands for with zeros as its data; none: no such word.
BoundaryKind kind_for_zero(std::string_view word);

/// Its data may come from the reference solution.
constexpr bool takes_reference(const Key& key) {
  return std::ranges::equal(key.words, or_reference);
}

/// Density, velocity, and pressure or temperature.
inline constexpr std::array gas_state_keys{
    Key{.name = "rho",
        .type = Type::field,
        .meaning = "density",
        .unit = "mass/volume",
        .required = true,
        .range = positive},
    Key{.name = "v", .type = Type::vector, .meaning = "velocity", .unit = "velocity", .required = true},
    Key{.name = "p",
        .type = Type::field,
        .meaning = "pressure (or give T)",
        .unit = "pressure",
        .fallback = "rho T",
        .range = positive},
    Key{.name = "T",
        .type = Type::field,
        .meaning = "temperature p / rho, in place of p: in SI units 287 times the kelvin of air",
        .unit = "pressure volume/mass",
        .fallback = "p / rho",
        .range = positive},
};
inline constexpr Section gas_state_section{.title = "A state of the gas", .keys = gas_state_keys};

/// The key of boundaries of the gas that are told a state.
inline constexpr std::array gas_boundary_state{
    Key{.name = "state",
        .type = Type::section,
        .meaning = "the state there, of x, y, r, t; `reference` takes it from the reference solution",
        .required = true,
        .words = or_reference,
        .section = &gas_state_section},
};

/// Whether a bare word says all of a boundary, with data from the reference solution.
constexpr bool is_said_by_a_word(std::span<const Key> keys) {
  return std::ranges::all_of(keys, [](const Key& key) { return !key.required || takes_reference(key); });
}

}  // namespace schema
}  // namespace fsi
