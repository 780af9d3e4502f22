#include "common/case/schema/schema.hpp"

#include <array>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi::schema {

namespace {

using config::most_keys;
using std::array;
using std::string_view;
/// [s]; Cyclone remembers a silent participant for an hour at most, and must for twice as long.
constexpr Range at_most_half_an_hour{.low = 0, .high = 1800, .low_open = true};
constexpr Range at_most_a_day{.low = 0, .high = 86400, .low_open = true};  ///< [s]

// ---- time, output, expectations

constexpr array grid_keys{
    Key{.name = "factor",
        .meaning = "resolution factor j; expressions know h = 1 / (10 j)",
        .unit = "1/length",
        .fallback = "1",
        .range = factor_range},
};
constexpr Section resolution{.title = "Resolution", .keys = grid_keys};

constexpr array time_keys{
    Key{.name = "end", .meaning = "end of the run", .unit = "time", .required = true, .range = positive},
    Key{.name = "cfl",
        .meaning = "safety factor of the time step",
        .fallback = "0.9",
        .range = {.low = 1e-4, .high = 1}},
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
        .meaning = "largest time step, for studies; a beam without a gas needs it",
        .unit = "time",
        .fallback = "no limit",
        .range = positive},
    Key{.name = "join_timeout",
        .meaning =
            "a program is lost when it has been idle for so long before joining the run; computing and "
            "waiting for a disk do not count",
        .unit = "s",
        .fallback = "20",
        .range = at_most_a_day},
    Key{.name = "peer_timeout",
        .meaning = "a program silent for so long is lost",
        .unit = "s",
        .fallback = "4",
        .range = at_most_half_an_hour},
    Key{.name = "step_timeout",
        .meaning = "a program that computes for longer than this, and than twenty times its longest step so "
                   "far, without ending its step is stuck",
        .unit = "s",
        .fallback = "120",
        .range = at_most_a_day},
};
constexpr Section time_section{.title = "Time", .keys = time_keys};

constexpr array interface_keys{
    Key{.name = "projection",
        .type = Type::word,
        .meaning =
            "AMP projection (28), its simplified form (29), or none; rigid bodies have one of their own, "
            "and so have substeps; `traditional` goes with neither",
        .fallback = name_of(ProjectionSpec{}.projection),
        .words = words_of<Projection>},
    Key{.name = "riemann",
        .type = Type::word,
        .meaning =
            "the gas's side of the projection: its whole wave curve (shock or rarefaction of any "
            "strength), or the tangent of that curve as in (28); they differ by the square of the jump",
        .fallback = name_of(ProjectionSpec{}.riemann),
        .words = words_of<GasResponse>},
    Key{.name = "motion",
        .type = Type::vector,
        .meaning = "chosen solutions of gas and solid: where the interface point at (x, y) at t = 0 is at t",
        .unit = "length",
        .fallback = "the solid moves it"},
};
constexpr Section interface_section{.title = "The interface", .keys = interface_keys};

constexpr array probe_keys{
    Key{.name = "name", .type = Type::name, .meaning = "column in probes.csv", .required = true},
    Key{.name = "in",
        .type = Type::name,
        .meaning = "`fluid`, one of `fluids`, or a solid",
        .required = true},
    Key{.name = "x", .meaning = "gas: where; solid: reference position", .unit = "length", .required = true},
    Key{.name = "y", .meaning = "gas: where; solid: reference position", .unit = "length", .required = true},
};
constexpr Section probe_section{.title = "A probe", .keys = probe_keys};
constexpr Key probe_element{
    .name = "probe", .type = Type::section, .meaning = "a probe", .section = &probe_section};
constexpr array<string_view, 2> on_failure_words{"end", "go_on"};
constexpr array output_keys{
    Key{.name = "times",
        .type = Type::numbers,
        .meaning = "fields are written at these times, hit exactly, and at time.end; those after it are left "
                   "out, those closer than 1e-8 of the run are one",
        .unit = "time",
        .fallback = "[time.end]",
        .range = not_negative},
    Key{.name = "every",
        .meaning = "fields are written at its multiples too, and at t = 0",
        .unit = "time",
        .fallback = "only `times`",
        .range = positive},
    Key{.name = "probes",
        .type = Type::list,
        .meaning = "values at points, every step",
        .fallback = "[]",
        .most = 1000,
        .element = &probe_element},
    Key{.name = "checkpoint_every",
        .type = Type::integer,
        .meaning = "a checkpoint after each so many steps",
        .unit = "steps",
        .fallback = "never",
        .range = {.low = 1, .high = 1e9}},
    Key{.name = "checkpoint_seconds",
        .meaning = "a checkpoint when so much wall time has gone since the last",
        .unit = "s",
        .fallback = "600",
        .range = positive},
    Key{.name = "checkpoint_at_end",
        .type = Type::boolean,
        .meaning = "one at the end, from which `--restart` goes on to a later `time.end`",
        .fallback = "true"},
    Key{.name = "on_failure",
        .type = Type::word,
        .meaning = "when results cannot be written: end the run (exit 5), or go on without them",
        .fallback = "end",
        .words = on_failure_words},
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
constexpr Key fluid_element{
    .name = "gas", .type = Type::section, .meaning = "a gas", .section = &fluid_section};
constexpr Key solid_element{
    .name = "solid", .type = Type::section, .meaning = "a solid", .section = &solid_section};
constexpr Key expectation_element{.name = "expectation",
                                  .type = Type::section,
                                  .meaning = "limits of a quantity; a bare value is `equals`",
                                  .section = &expectation_section};

constexpr array<string_view, 2> unit_systems{"none", "SI"};
constexpr array case_keys{
    Key{.name = "name",
        .type = Type::text,
        .meaning = "name of the case, part of the names of files: letters, digits, _ . -",
        .fallback = "name of the file"},
    Key{.name = "title", .type = Type::text, .meaning = "one line about it", .fallback = "none"},
    Key{.name = "units",
        .type = Type::word,
        .meaning =
            "labels of pictures: `SI` where all numbers are in m, s, kg; the numbers stay what they are",
        .fallback = "none",
        .words = unit_systems},
    Key{.name = "parameters",
        .type = Type::named,
        .meaning = "named numbers, for every expression and `--set parameters.NAME=..`",
        .fallback = "none",
        .most = most_keys,
        .element = &parameter_element},
    Key{.name = "definitions",
        .type = Type::named,
        .meaning = "named formulas of x, y, r, s, t, parameters and each other, for fields and maps",
        .fallback = "none",
        .most = most_definitions,
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
    Key{.name = "fluids",
        .type = Type::named,
        .meaning = "in the place of `fluid`: several gases by name, separated by solids, each with a grid, a "
                   "state and a program of its own",
        .fallback = "no gas but `fluid`",
        .most = 16,
        .element = &fluid_element},
    Key{.name = "solids",
        .type = Type::named,
        .meaning = "the solids by name, each a program of its own",
        .fallback = "no solids",
        .most = 64,
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
        .meaning = "what summary.json must say, by path (`errors.rho`); a bare value is `equals`. `build`, "
                   "`restart` "
                   "and `failure` cannot be expected",
        .fallback = "nothing",
        .most = most_keys,
        .element = &expectation_element},
};

}  // namespace

constinit const Section case_file{.title = "The case", .keys = case_keys};

}  // namespace fsi::schema
