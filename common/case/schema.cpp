#include "common/case/schema.hpp"

#include <array>

#include "common/case/laws.hpp"

namespace fsi::schema {

namespace {

using std::array;
using std::string_view;
constexpr Range fraction{.low = 0, .high = 1, .low_open = true};

constexpr array<string_view, 1> or_reference{"reference"};

// ---- grids

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
constexpr Section grid_section{
    .title = "A component grid", .keys = shake_keys, .variants = grid_variants, .default_kind = "rectangle"};

// ---- the gas

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
constexpr Section gas_state{.title = "A state of the gas", .keys = gas_state_keys};

constexpr array gas_boundary_state{
    Key{.name = "state",
        .type = Type::section,
        .meaning = "the state there, of x, y, r, t; `reference` takes it from the reference solution",
        .required = true,
        .words = or_reference,
        .section = &gas_state},
};
constexpr array gas_interface_keys{
    Key{.name = "solid", .type = Type::name, .meaning = "the solid on the other side", .required = true},
};
constexpr array gas_boundary_variants{
    Variant{"interface", "a solid is on the other side", gas_interface_keys},
    Variant{"slip_wall", "wall without friction", {}},
    Variant{"symmetry", "mirror images across a straight side", {}},
    Variant{"inflow", "the state is imposed", gas_boundary_state},
    Variant{"outflow", "extrapolation", {}},
    Variant{"dirichlet", "all values are imposed, ghost points too", gas_boundary_state},
    Variant{"periodic", "continues at the opposite side", {}},
};
constexpr array<string_view, 6> gas_boundary_words{"slip_wall", "symmetry",  "inflow",
                                                   "outflow",   "dirichlet", "periodic"};
constexpr Section gas_boundary{
    .title = "A side of the gas", .keys = {}, .variants = gas_boundary_variants, .default_kind = ""};

constexpr string_view gas_side =
    "a side of the gas; a bare word is its kind, with data from the reference solution";
constexpr array gas_sides{
    Key{.name = "left",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .words = gas_boundary_words,
        .section = &gas_boundary},
    Key{.name = "right",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .words = gas_boundary_words,
        .section = &gas_boundary},
    Key{.name = "bottom",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .words = gas_boundary_words,
        .section = &gas_boundary},
    Key{.name = "top",
        .type = Type::section,
        .meaning = gas_side,
        .required = true,
        .words = gas_boundary_words,
        .section = &gas_boundary},
};
constexpr Section gas_boundaries{.title = "Boundaries of the gas", .keys = gas_sides};

constexpr array<string_view, 2> riemann_words{"roe", "hllc"};
constexpr array<string_view, 4> gas_limiter_words{"none", "minmod", "mc", "van_leer"};
constexpr array gas_scheme_keys{
    Key{.name = "riemann",
        .type = Type::word,
        .meaning = "Riemann solver",
        .fallback = "roe",
        .words = riemann_words},
    Key{.name = "limiter",
        .type = Type::word,
        .meaning = "limiter of the slopes; none for smooth flow",
        .fallback = "minmod",
        .words = gas_limiter_words},
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
        .section = &grid_section},
    Key{.name = "boundary",
        .type = Type::section,
        .meaning = "its four sides",
        .required = true,
        .section = &gas_boundaries},
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
        .section = &gas_state},
};
constexpr Section fluid_section{.title = "The gas", .keys = fluid_keys};

// ---- solids

constexpr array traction_keys{
    Key{.name = "value",
        .type = Type::vector,
        .meaning = "traction per unit current area",
        .unit = "pressure",
        .required = true,
        .words = or_reference},
};
constexpr array displacement_keys{
    Key{.name = "value",
        .type = Type::vector,
        .meaning = "displacement",
        .unit = "length",
        .required = true,
        .words = or_reference},
    Key{.name = "velocity",
        .type = Type::vector,
        .meaning = "its time derivative",
        .unit = "velocity",
        .fallback = "by differences of `value`"},
};
constexpr array solid_dirichlet_keys{
    Key{.name = "state",
        .type = Type::word,
        .meaning = "where u, v and P come from",
        .required = true,
        .words = or_reference},
};
constexpr array solid_boundary_variants{
    Variant{"interface", "the gas is on the other side", {}},
    Variant{"slip_wall", "no displacement along the normal, no shear", {}},
    Variant{"symmetry", "mirror images across a straight side", {}},
    Variant{"traction", "the traction is imposed", traction_keys},
    Variant{"displacement", "the displacement is imposed", displacement_keys},
    Variant{"dirichlet", "u, v and P are imposed, ghost points too", solid_dirichlet_keys},
    Variant{"periodic", "continues at the opposite side", {}},
};
constexpr array<string_view, 9> solid_boundary_words{"interface", "slip_wall",    "symmetry",
                                                     "traction",  "displacement", "dirichlet",
                                                     "periodic",  "free",         "clamped"};
constexpr Section solid_boundary{
    .title = "A side of a solid", .keys = {}, .variants = solid_boundary_variants, .default_kind = ""};

constexpr string_view solid_side =
    "a side of the solid; a bare word is its kind, with data from the reference solution; `free` is no "
    "traction, `clamped` no displacement";
constexpr array solid_sides{
    Key{.name = "left",
        .type = Type::section,
        .meaning = solid_side,
        .required = true,
        .words = solid_boundary_words,
        .section = &solid_boundary},
    Key{.name = "right",
        .type = Type::section,
        .meaning = solid_side,
        .required = true,
        .words = solid_boundary_words,
        .section = &solid_boundary},
    Key{.name = "bottom",
        .type = Type::section,
        .meaning = solid_side,
        .required = true,
        .words = solid_boundary_words,
        .section = &solid_boundary},
    Key{.name = "top",
        .type = Type::section,
        .meaning = solid_side,
        .required = true,
        .words = solid_boundary_words,
        .section = &solid_boundary},
};
constexpr Section solid_boundaries{.title = "Boundaries of a solid", .keys = solid_sides};

constexpr array beta_keys{
    Key{.name = "rate",
        .meaning = "the part that is a rate",
        .unit = "1/time",
        .fallback = "0",
        .range = not_negative},
    Key{.name = "scaled",
        .meaning = "the part that is a rate times the time step",
        .fallback = "0",
        .range = not_negative},
};
constexpr Section beta_section{.title = "A coefficient beta = rate dt + scaled", .keys = beta_keys};

constexpr array<string_view, 2> solid_limiter_words{"none", "minmod"};
constexpr array solid_scheme_keys{
    Key{.name = "limiter",
        .type = Type::word,
        .meaning = "limiter of the slopes; none for smooth motion",
        .fallback = "minmod",
        .words = solid_limiter_words},
    Key{.name = "tangential_stress",
        .type = Type::section,
        .meaning = "beta^P of (39)",
        .fallback = "0",
        .section = &beta_section},
    Key{.name = "displacement",
        .type = Type::section,
        .meaning = "beta^u of (40)",
        .fallback = "0",
        .section = &beta_section},
    Key{.name = "relaxation",
        .type = Type::section,
        .meaning = "beta^r of (41)",
        .fallback = "0",
        .section = &beta_section},
    Key{.name = "bulk_diffusion",
        .meaning = "coefficient of undivided second differences of v and P",
        .unit = "1/time",
        .fallback = "0",
        .range = not_negative},
};
constexpr Section solid_scheme{.title = "Scheme of a solid", .keys = solid_scheme_keys};

constexpr array solid_initial_keys{
    Key{.name = "u",
        .type = Type::vector,
        .meaning = "displacement, of the reference position",
        .unit = "length",
        .fallback = "[0, 0]"},
    Key{.name = "v",
        .type = Type::vector,
        .meaning = "velocity, of the reference position",
        .unit = "velocity",
        .fallback = "[0, 0]"},
};
constexpr Section solid_initial{.title = "Initial state of a solid", .keys = solid_initial_keys};

constexpr array solid_keys{
    Key{.name = "law",
        .type = Type::word,
        .meaning = "constitutive law; its program is solid_solver_<law>",
        .required = true,
        .words = law_names},
    Key{.name = "rho",
        .meaning = "density of the reference configuration",
        .unit = "mass/volume",
        .required = true,
        .range = positive},
    Key{.name = "lambda",
        .meaning = "Lame constant",
        .unit = "pressure",
        .required = true,
        .range = not_negative},
    Key{.name = "mu",
        .meaning = "Lame constant (shear modulus)",
        .unit = "pressure",
        .required = true,
        .range = positive},
    Key{.name = "grid",
        .type = Type::section,
        .meaning = "the reference configuration",
        .required = true,
        .section = &grid_section},
    Key{.name = "boundary",
        .type = Type::section,
        .meaning = "its four sides",
        .required = true,
        .section = &solid_boundaries},
    Key{.name = "scheme",
        .type = Type::section,
        .meaning = "choices of the solver",
        .fallback = "all defaults",
        .section = &solid_scheme},
    Key{.name = "initial",
        .type = Type::section,
        .meaning = "state at t = 0",
        .fallback = "at rest",
        .words = or_reference,
        .section = &solid_initial},
    Key{.name = "body_force",
        .type = Type::vector,
        .meaning = "force per unit reference volume, of the reference position",
        .unit = "force/volume",
        .fallback = "none"},
};
constexpr Section solid_section{.title = "A solid", .keys = solid_keys};

// ---- reference solutions

constexpr array elastic_piston_keys{
    Key{.name = "density_ratio",
        .meaning = "density of the solid over that of the gas at rest",
        .required = true,
        .range = positive},
    Key{.name = "c_p",
        .meaning = "p-wave speed of the solid over the sound speed of the gas at rest",
        .required = true,
        .range = positive},
    Key{.name = "amplitude",
        .meaning = "A of the interface path F = -A t^4 / 4",
        .unit = "length/time^4",
        .fallback = "0.25"},
    Key{.name = "rotation",
        .meaning = "of the whole set-up about the origin",
        .unit = "degree",
        .fallback = "0"},
    Key{.name = "gamma",
        .meaning = "ratio of specific heats",
        .fallback = "1.4",
        .range = {.low = 1, .low_open = true}},
};
constexpr array riemann_keys{
    Key{.name = "x_0", .meaning = "where the jump is at t = 0", .unit = "length", .required = true},
    Key{.name = "gamma",
        .meaning = "ratio of specific heats",
        .fallback = "1.4",
        .range = {.low = 1, .low_open = true}},
    Key{.name = "rho_left",
        .meaning = "density left of the jump",
        .unit = "mass/volume",
        .required = true,
        .range = positive},
    Key{.name = "v_left", .meaning = "velocity left of the jump", .unit = "velocity", .required = true},
    Key{.name = "p_left",
        .meaning = "pressure left of the jump",
        .unit = "pressure",
        .required = true,
        .range = positive},
    Key{.name = "rho_right",
        .meaning = "density right of the jump",
        .unit = "mass/volume",
        .required = true,
        .range = positive},
    Key{.name = "v_right", .meaning = "velocity right of the jump", .unit = "velocity", .required = true},
    Key{.name = "p_right",
        .meaning = "pressure right of the jump",
        .unit = "pressure",
        .required = true,
        .range = positive},
};
constexpr array expressions_keys{
    Key{.name = "fluid",
        .type = Type::section,
        .meaning = "state of the gas",
        .fallback = "none",
        .section = &gas_state},
    Key{.name = "u",
        .type = Type::vector,
        .meaning = "displacement of the solid, of the reference position",
        .unit = "length",
        .fallback = "none"},
};
constexpr array manufactured_keys{
    Key{.name = "u",
        .type = Type::vector,
        .meaning = "displacement of the solid, of the reference position; the body force follows from it",
        .unit = "length",
        .required = true},
};
constexpr array piston_1d_keys{
    Key{.name = "points",
        .type = Type::integer,
        .meaning = "points per unit length of the fine run",
        .unit = "1/length",
        .fallback = "3200",
        .range = {.low = 100, .high = 1e6}},
};
constexpr array reference_variants{
    Variant{"none", "no reference solution, no errors", {}},
    Variant{"elastic_piston", "exact solution of the elastic piston", elastic_piston_keys},
    Variant{"riemann", "exact solution of the Riemann problem", riemann_keys},
    Variant{"piston_1d", "a fine one-dimensional run of the same case", piston_1d_keys},
    Variant{"expressions", "formulas", expressions_keys},
    Variant{"manufactured", "a motion made exact by a body force", manufactured_keys},
};
constexpr Section reference_section{
    .title = "Reference solution", .keys = {}, .variants = reference_variants, .default_kind = ""};

// ---- time, output, expectations

constexpr array grid_keys{
    Key{.name = "factor",
        .meaning = "resolution factor j; expressions know h = 1 / (10 j)",
        .fallback = "1",
        .range = {.low = 0, .high = 10000, .low_open = true}},
};
constexpr Section resolution{.title = "Resolution", .keys = grid_keys};

constexpr array time_keys{
    Key{.name = "end", .meaning = "end of the run", .unit = "time", .required = true, .range = positive},
    Key{.name = "cfl", .meaning = "safety factor of the time step", .fallback = "0.9", .range = fraction},
    Key{.name = "growth",
        .meaning = "largest ratio of successive time steps",
        .fallback = "1.2",
        .range = {.low = 1, .low_open = true}},
    Key{.name = "multirate",
        .type = Type::boolean,
        .meaning = "the solid takes substeps of its own inside the step of the gas",
        .fallback = "false"},
    Key{.name = "robin_order",
        .type = Type::integer,
        .meaning = "extrapolation in time of what substeps need: 1 linear, 2 quadratic",
        .fallback = "2",
        .range = {.low = 1, .high = 2}},
    Key{.name = "dt",
        .meaning = "largest time step, for studies",
        .unit = "time",
        .fallback = "no limit",
        .range = positive},
    Key{.name = "peer_timeout",
        .meaning = "a program silent for so long is lost",
        .unit = "s",
        .fallback = "4",
        .range = positive},
};
constexpr Section time_section{.title = "Time", .keys = time_keys};

constexpr array<string_view, 3> projection_words{"full", "simplified", "traditional"};
constexpr array interface_keys{
    Key{.name = "projection",
        .type = Type::word,
        .meaning = "AMP projection (28), its simplified form (29), or none",
        .fallback = "simplified",
        .words = projection_words},
};
constexpr Section interface_section{.title = "The interface", .keys = interface_keys};

constexpr array probe_keys{
    Key{.name = "name", .type = Type::name, .meaning = "column in probes.csv", .required = true},
    Key{.name = "in", .type = Type::name, .meaning = "`fluid` or a solid", .required = true},
    Key{.name = "x", .meaning = "gas: where; solid: reference position", .unit = "length", .required = true},
    Key{.name = "y", .meaning = "gas: where; solid: reference position", .unit = "length", .required = true},
};
constexpr Section probe_section{.title = "A probe", .keys = probe_keys};
constexpr Key probe_element{
    .name = "probe", .type = Type::section, .meaning = "a probe", .section = &probe_section};
constexpr array output_keys{
    Key{.name = "times",
        .type = Type::numbers,
        .meaning = "fields are written at these times, hit exactly",
        .unit = "time",
        .fallback = "[time.end]",
        .range = not_negative},
    Key{.name = "every",
        .meaning = "fields are written at its multiples too",
        .unit = "time",
        .fallback = "only `times`",
        .range = positive},
    Key{.name = "probes",
        .type = Type::list,
        .meaning = "values at points, every step",
        .fallback = "[]",
        .element = &probe_element},
};
constexpr Section output_section{.title = "Output", .keys = output_keys};

constexpr array expectation_keys{
    Key{.name = "max", .meaning = "largest value allowed", .fallback = "no limit"},
    Key{.name = "min", .meaning = "smallest value allowed", .fallback = "no limit"},
    Key{.name = "equals", .type = Type::text, .meaning = "the only text allowed", .fallback = "any"},
};
constexpr Section expectation_section{.title = "An expectation", .keys = expectation_keys};

constexpr Key parameter_element{
    .name = "parameter", .type = Type::number, .meaning = "a number, or an expression of other parameters"};
constexpr Key definition_element{.name = "definition", .type = Type::text, .meaning = "a formula"};
constexpr Key solid_element{
    .name = "solid", .type = Type::section, .meaning = "a solid", .section = &solid_section};
constexpr Key expectation_element{.name = "expectation",
                                  .type = Type::section,
                                  .meaning = "limits of a quantity; a bare word is `equals`",
                                  .section = &expectation_section};

constexpr array case_keys{
    Key{.name = "name", .type = Type::text, .meaning = "name of the case", .fallback = "name of the file"},
    Key{.name = "title", .type = Type::text, .meaning = "one line about it", .fallback = "none"},
    Key{.name = "parameters",
        .type = Type::named,
        .meaning = "named numbers, for every expression and `--set parameters.NAME=..`",
        .fallback = "none",
        .element = &parameter_element},
    Key{.name = "definitions",
        .type = Type::named,
        .meaning = "named formulas of x, y, r, s, t, parameters and each other, for fields and maps",
        .fallback = "none",
        .element = &definition_element},
    Key{.name = "grid",
        .type = Type::section,
        .meaning = "resolution of all grids",
        .fallback = "factor 1",
        .section = &resolution},
    Key{.name = "time",
        .type = Type::section,
        .meaning = "time and time steps",
        .required = true,
        .section = &time_section},
    Key{.name = "fluid",
        .type = Type::section,
        .meaning = "the gas",
        .fallback = "no gas",
        .section = &fluid_section},
    Key{.name = "solids",
        .type = Type::named,
        .meaning = "the solids by name, each a program of its own",
        .fallback = "no solids",
        .element = &solid_element},
    Key{.name = "interface",
        .type = Type::section,
        .meaning = "how gas and solids meet",
        .fallback = "all defaults",
        .section = &interface_section},
    Key{.name = "output",
        .type = Type::section,
        .meaning = "what is written",
        .fallback = "fields at the end",
        .section = &output_section},
    Key{.name = "reference",
        .type = Type::section,
        .meaning = "an exact or fine solution: data and yardstick",
        .fallback = "none",
        .section = &reference_section},
    Key{.name = "expect",
        .type = Type::named,
        .meaning = "what summary.json must say, by path (`errors.rho`)",
        .fallback = "nothing",
        .element = &expectation_element},
};

}  // namespace

const Section case_file{.title = "The case", .keys = case_keys};

}  // namespace fsi::schema
