#include <array>

#include "common/case/case.hpp"
#include "common/case/schema/schema.hpp"

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
        .range = {.low = 0, .high = 0.4}},
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
        .meaning =
            "of a rectangle: levels that follow the gas and the bodies, each three times as coarse as the "
            "next finer one, `spacing` or `points` being those of the finest; points are added until they "
            "fit (points - 1 of each direction a multiple of 3^(levels - 1), and at least four times it)",
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

constexpr array gas_state_keys{
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
        .meaning = "temperature p / rho, in place of p",
        .unit = "pressure volume/mass",
        .fallback = "p / rho",
        .range = positive},
};

constexpr array gas_boundary_state{
    Key{.name = "state",
        .type = Type::section,
        .meaning = "the state there, of x, y, r, t; `reference` takes it from the reference solution",
        .required = true,
        .words = or_reference,
        .section = &gas_state_section},
};
constexpr array gas_interface_keys{
    Key{.name = "solid", .type = Type::name, .meaning = "the solid on the other side", .required = true},
};
constexpr array gas_boundary_variants{
    Variant{"interface", "a solid is on the other side", gas_interface_keys},
    Variant{"slip_wall", "wall without friction", {}},
    Variant{"symmetry", "mirror images across a straight side", {}},
    Variant{
        "inflow",
        "gas of this state comes in: all of it where it is faster than sound, else along characteristics, so "
        "that waves from inside leave",
        gas_boundary_state},
    Variant{"imposed", "all four values are imposed; waves from inside are reflected", gas_boundary_state},
    Variant{"outflow", "extrapolation", {}},
    Variant{"far_field", "what comes in along characteristics is that of the state, what goes out leaves",
            gas_boundary_state},
    Variant{"dirichlet", "all values are imposed, ghost points too", gas_boundary_state},
    Variant{"periodic", "continues at the opposite side", {}},
};

constexpr string_view gas_side =
    "a side of the gas; a bare word is its kind, with data from the reference solution";
constexpr array gas_sides{
    Key{.name = "left",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .words = gas_boundary_words,
        .section = &gas_boundary_section},
    Key{.name = "right",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .words = gas_boundary_words,
        .section = &gas_boundary_section},
    Key{.name = "bottom",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .words = gas_boundary_words,
        .section = &gas_boundary_section},
    Key{.name = "top",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .words = gas_boundary_words,
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
        .meaning = "coefficient of max(0, -div v) on undivided differences",
        .fallback = "0",
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
        .fallback = "one around each solid with a `shape`",
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

constinit const Section grid_section{
    .title = "A component grid", .keys = shake_keys, .variants = grid_variants, .default_kind = "rectangle"};

constinit const Section gas_boundary_section{
    .title = "A side of the gas", .keys = {}, .variants = gas_boundary_variants, .default_kind = ""};

constinit const Section gas_state_section{.title = "A state of the gas", .keys = gas_state_keys};

constinit const Section fluid_section{.title = "The gas", .keys = fluid_keys};

}  // namespace fsi::schema
