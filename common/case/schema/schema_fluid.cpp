#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <variant>

#include "common/case/case.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/case/schema/boundary_words.hpp"
#include "common/case/schema/schema.hpp"
#include "fluid_solver/boundary/every_boundary.hpp"

namespace fsi::schema {

namespace {

using std::array;
using std::string_view;

constexpr array shake_keys{
    Key{.name = "name",
        .type = Type::name,
        .meaning = "name in messages and output",
        .fallback = "the owner's name"},
    Key{.name = "shake",
        .meaning = "random displacement of every inner point at every step, for tests",
        .unit = "cell",
        .fallback = "0",
        .range = {.low = 0, .high = 0.2}},
    Key{.name = "shake_seed",
        .type = Type::integer,
        .meaning = "seed of the random displacement",
        .fallback = "1",
        .range = not_negative},
    Key{.name = "rotation",
        .meaning = "turns the whole grid about the origin, counter-clockwise",
        .unit = "degree",
        .fallback = "0"},
    Key{.name = "points",
        .type = Type::counts,
        .meaning = "points along the first and the second direction, both ends included",
        .fallback = "from `spacing`",
        .range = {.low = 5, .high = 100000}},
};
constexpr array rectangle_keys{
    Key{.name = "x", .type = Type::pair, .meaning = "left and right end", .unit = "length", .required = true},
    Key{.name = "y", .type = Type::pair, .meaning = "bottom and top", .unit = "length", .required = true},
    Key{.name = "spacing",
        .meaning = "distance of points, rounded so that both ends are points (in place of `points`)",
        .unit = "length",
        .fallback = "from `points`",
        .range = positive},
};
constexpr array mapped_keys{
    Key{.name = "map",
        .type = Type::map,
        .meaning =
            "position of the point with parameters r, s in [0, 1]; a grid whose map depends on t moves",
        .unit = "length",
        .required = true},
};
constexpr array grid_variants{
    Variant{"rectangle", "a rectangle with equally spaced points", rectangle_keys},
    Variant{"mapped", "the unit square mapped by a formula", mapped_keys},
};
constexpr array block_keys{
    Key{.name = "spacing",
        .meaning = "mean distance of points (in place of `points`)",
        .unit = "length",
        .fallback = "from `points`",
        .range = positive},
};
constexpr array solid_grid_variants{
    grid_variants[0],
    grid_variants[1],
    Variant{"block", "of a solid with a `shape` of four straight sides: from corner to corner", block_keys},
};
// ---- the gas

constexpr array refine_keys{
    Key{.name = "variable",
        .type = Type::word,
        .meaning = "quantity whose second differences are looked at",
        .fallback = name_of(RefineSpec{}.variable),
        .words = words_of<RefinedQuantity>},
    Key{.name = "threshold",
        .meaning = "a level is refined where an undivided second difference exceeds this part of the "
                   "quantity's range",
        .fallback = "3e-3",
        .range = positive},
    Key{.name = "buffer",
        .type = Type::integer,
        .meaning = "points of a level around what is refined in it; at least a third of `every`, so that no "
                   "wave leaves the refined part",
        .fallback = "2",
        .range = {.low = 1, .high = 100}},
    Key{.name = "every",
        .type = Type::integer,
        .meaning = "steps between two adaptations",
        .fallback = "6",
        .range = {.low = 1, .high = 300}},
};
constexpr Section refine_section{.title = "Where the background of the gas is refined", .keys = refine_keys};
constexpr array level_keys{
    Key{.name = "levels",
        .type = Type::integer,
        .meaning = "of a rectangle without `rotation`, `shake` and sides that solids move: levels that "
                   "follow the gas and "
                   "the bodies, each three times as coarse as the next finer one, `spacing` or `points` "
                   "being those of "
                   "the finest; points are added until they fit (points - 1 of each direction a multiple of "
                   "3^(levels - 1), and at least four times it)",
        .fallback = "1",
        .range = {.low = 1, .high = 6}},
    Key{.name = "refine",
        .type = Type::section,
        .meaning = "where, with more than one level",
        .fallback = "all defaults",
        .section = &refine_section},
};

/// The keys of any grid and those of levels.
constexpr array gas_grid_keys = [] {
  array<Key, shake_keys.size() + level_keys.size()> keys{};
  for (std::size_t k = 0; k < keys.size(); ++k)
    keys[k] = k < shake_keys.size() ? shake_keys[k] : level_keys[k - shake_keys.size()];
  return keys;
}();
constexpr Section gas_grid_section{.title = "The grid of the gas",
                                   .keys = gas_grid_keys,
                                   .variants = grid_variants,
                                   .default_kind = "rectangle"};

/// What every kind tells, in the order of the case file's documentation.
constexpr array gas_boundary_facts = []<class... Kind>(std::type_identity<std::variant<Kind...>>) {
  return array{Kind::facts...};
}(std::type_identity<fluid::Boundary>{});

constexpr auto gas_boundary_variants = [] {
  array<Variant, fluid::boundary_kinds.size()> variants{};
  for (std::size_t k = 0; k < variants.size(); ++k)
    variants[k] = {name_of(fluid::boundary_kinds[k]), gas_boundary_facts[k].meaning,
                   gas_boundary_facts[k].keys};
  return variants;
}();
constexpr auto gas_boundary_words = words_said<gas_boundary_variants>();

constexpr string_view gas_side =
    "a side of the gas; a bare word is its kind, with data from the reference solution";
constexpr array gas_sides{
    Key{.name = "left",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .section = &gas_boundary_section},
    Key{.name = "right",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .section = &gas_boundary_section},
    Key{.name = "bottom",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .section = &gas_boundary_section},
    Key{.name = "top",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .section = &gas_boundary_section},
};
constexpr Section gas_boundaries{.title = "Boundaries of the gas", .keys = gas_sides};

constexpr array gas_scheme_keys{
    Key{.name = "riemann",
        .type = Type::word,
        .meaning = "Riemann solver",
        .fallback = name_of(GasScheme{}.riemann),
        .words = words_of<RiemannSolver>},
    Key{.name = "limiter",
        .type = Type::word,
        .meaning = "limiter of the slopes; none for smooth flow",
        .fallback = name_of(GasScheme{}.limiter),
        .words = words_of<GasLimiter>},
    Key{.name = "entropy_fix",
        .meaning = "width of the sonic-point fix, part of the sound speed",
        .fallback = "0.1",
        .range = {.low = 0, .high = 1}},
    Key{.name = "shock_viscosity",
        .meaning = "coefficient of max(0, -div v) on undivided differences; strong shocks along grid lines "
                   "break up without",
        .fallback = "0.5 where the case says of shocks of Mach 2 and more, else 0",
        .range = not_negative},
    Key{.name = "linear_diffusion",
        .meaning = "coefficient of undivided second differences",
        .unit = "1/time",
        .fallback = "0",
        .range = not_negative},
};
constexpr Section gas_scheme{.title = "Scheme of the gas", .keys = gas_scheme_keys};

constexpr Key gas_fitted_element{
    .name = "body_fitted", .type = Type::section, .meaning = "a grid", .section = &gas_fitted_section};

constexpr array fluid_keys{
    Key{.name = "gamma",
        .meaning = "ratio of specific heats",
        .fallback = "1.4",
        .range = {.low = 1, .high = 10, .low_open = true}},
    Key{.name = "p_e",
        .meaning = "pressure at which the solid is free of stress",
        .unit = "pressure",
        .fallback = "0",
        .range = not_negative},
    Key{.name = "grid",
        .type = Type::section,
        .meaning = "where the gas is",
        .required = true,
        .section = &gas_grid_section},
    Key{.name = "boundary",
        .type = Type::section,
        .meaning = "its four sides",
        .required = true,
        .section = &gas_boundaries},
    Key{.name = "body_fitted",
        .type = Type::list,
        .meaning = "grids before `grid`, which then is a rectangle that covers them: around solids and walls",
        .fallback =
            "besides those listed, one around each solid with a `shape` that none of them names; with "
            "`fluids` only those listed",
        .most = 64,
        .element = &gas_fitted_element},
    Key{.name = "scheme",
        .type = Type::section,
        .meaning = "choices of the solver",
        .fallback = "all defaults",
        .section = &gas_scheme},
    Key{.name = "initial",
        .type = Type::section,
        .meaning = "state at t = 0",
        .required = true,
        .words = or_reference,
        .section = &gas_state_section},
};

}  // namespace

constinit const Section grid_section{.title = "The grid of a solid",
                                     .keys = shake_keys,
                                     .variants = solid_grid_variants,
                                     .default_kind = "rectangle"};

constinit const Section gas_boundary_section{
    .title = "A side of the gas", .keys = {}, .variants = gas_boundary_variants, .words = gas_boundary_words};

const GasBoundaryFacts& gas_boundary(BoundaryKind kind) {
  const auto found = std::ranges::find(fluid::boundary_kinds, kind);
  return gas_boundary_facts[static_cast<std::size_t>(found -
                                                     fluid::boundary_kinds.begin())];  // else that of Idle
}

constinit const Section fluid_section{.title = "The gas", .keys = fluid_keys};

}  // namespace fsi::schema
