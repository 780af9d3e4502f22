#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <variant>

#include "common/case/case.hpp"
#include "common/case/schema/boundary_words.hpp"
#include "common/case/schema/law_numbers.hpp"
#include "common/case/schema/laws.hpp"
#include "common/case/schema/schema.hpp"
#include "common/core/input/config.hpp"
#include "solid_solver/boundary/every_boundary.hpp"

namespace fsi::schema {

namespace {

using std::array;
using std::string_view;

/// What every kind tells, in the order of the case file's documentation.
constexpr array solid_boundary_facts = []<class... Kind>(std::type_identity<std::variant<Kind...>>) {
  return array{Kind::facts...};
}(std::type_identity<solid::EveryBoundary>{});

constexpr auto solid_boundary_variants = [] {
  array<Variant, solid::boundary_kinds.size()> variants{};
  for (std::size_t k = 0; k < variants.size(); ++k) {
    const SolidBoundaryFacts& facts = solid_boundary_facts[k];
    variants[k] = {name_of(solid::boundary_kinds[k]), facts.meaning, facts.keys};
  }
  return variants;
}();

constexpr bool has_word_for_zero(const SolidBoundaryFacts& facts) {
  return !facts.word_for_zero.empty();
}

/// The kinds, and the words for zeros.
constexpr auto solid_boundary_words = [] {
  constexpr auto kinds = words_said<solid_boundary_variants>();
  array<string_view, kinds.size() + static_cast<std::size_t>(
                                        std::ranges::count_if(solid_boundary_facts, has_word_for_zero))>
      words{};
  auto next = std::ranges::copy(kinds, words.begin()).out;
  for (const SolidBoundaryFacts& facts : solid_boundary_facts)
    if (has_word_for_zero(facts)) *next++ = facts.word_for_zero;
  return words;
}();

constexpr string_view solid_side =
    "a side of the solid; a bare word is its kind, with data from the reference solution; `free` is no "
    "traction, `clamped` no displacement";
constexpr array solid_sides{
    Key{.name = "left",
        .type = Type::section,
        .meaning = solid_side,
        .required = true,
        .section = &solid_boundary_section},
    Key{.name = "right",
        .type = Type::section,
        .meaning = solid_side,
        .required = true,
        .section = &solid_boundary_section},
    Key{.name = "bottom",
        .type = Type::section,
        .meaning = solid_side,
        .required = true,
        .section = &solid_boundary_section},
    Key{.name = "top",
        .type = Type::section,
        .meaning = solid_side,
        .required = true,
        .section = &solid_boundary_section},
};
constexpr Section solid_boundaries{.title = "Boundaries of a solid", .keys = solid_sides};

constexpr array beta_keys{
    Key{.name = "rate",
        .meaning = "part that grows with the time step: rate * dt",
        .unit = "1/time",
        .fallback = "0",
        .range = not_negative},
    Key{.name = "scaled",
        .meaning = "part that is the same in every step, whatever dt is",
        .fallback = "0",
        .range = not_negative},
};
constexpr Section beta_section{.title = "A coefficient beta = rate dt + scaled", .keys = beta_keys};

constexpr array solid_scheme_keys{
    Key{.name = "limiter",
        .type = Type::word,
        .meaning = "limiter of the slopes; none for smooth motion, minmod where stresses jump and mc breaks",
        .fallback = name_of(SolidScheme{}.limiter),
        .words = words_of<SolidLimiter>},
    Key{.name = "tangential_stress",
        .type = Type::section,
        .meaning = "beta^P of (39)",
        .fallback = "{scaled: 0.5}",
        .section = &beta_section},
    Key{.name = "displacement",
        .type = Type::section,
        .meaning = "beta^u of (40)",
        .fallback = "{scaled: 0.5}",
        .section = &beta_section},
    Key{.name = "relaxation",
        .type = Type::section,
        .meaning = "beta^r of (41)",
        .fallback = "{scaled: 0.2}",
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
        .meaning = "displacement, of the reference position; rigid bodies and beams may begin with `v` and "
                   "nothing else",
        .unit = "length",
        .fallback = "[0, 0]"},
    Key{.name = "v",
        .type = Type::vector,
        .meaning = "velocity, of the reference position; a rigid body takes that of its centre, and the "
                   "rotation that fits "
                   "the velocities along its outline best",
        .unit = "velocity",
        .fallback = "[0, 0]"},
};
constexpr Section solid_initial{.title = "Initial state of a solid", .keys = solid_initial_keys};

constexpr Key data_element{.name = "number", .type = Type::number, .meaning = "a number for the program"};

constexpr array<string_view, 2> motion_words{"free", "fixed"};
constexpr const char* not_given = "held, but for what is among the `degrees_of_freedom`";
constexpr array motion_keys{
    Key{.name = "x",
        .type = Type::field,
        .meaning = "how far the pivot has gone along x at t, from 0 at t = 0",
        .unit = "length",
        .fallback = not_given},
    Key{.name = "y", .type = Type::field, .meaning = "along y", .unit = "length", .fallback = not_given},
    Key{.name = "rotation",
        .type = Type::field,
        .meaning = "turned about the pivot, in radians",
        .fallback = not_given},
};
constexpr Section motion_section{.title = "The given motion of a rigid body", .keys = motion_keys};
constexpr Key rigid_motion{
    .name = "motion", .type = Type::word, .meaning = "what the body may do", .words = rigid_motions};
constexpr array spring_keys{
    Key{.name = "x",
        .meaning = "stiffness against displacements of the pivot along x",
        .unit = "force/length/depth",
        .fallback = "0",
        .range = not_negative},
    Key{.name = "y",
        .meaning = "along y",
        .unit = "force/length/depth",
        .fallback = "0",
        .range = not_negative},
    Key{.name = "rotation",
        .meaning = "against rotation, per radian",
        .unit = "force*length/depth",
        .fallback = "0",
        .range = not_negative},
};
constexpr Section spring_section{.title = "The spring of a rigid body", .keys = spring_keys};
constexpr array damper_keys{
    Key{.name = "x",
        .meaning = "resistance to velocities of the pivot along x",
        .unit = "force*time/length/depth",
        .fallback = "0",
        .range = not_negative},
    Key{.name = "y",
        .meaning = "along y",
        .unit = "force*time/length/depth",
        .fallback = "0",
        .range = not_negative},
    Key{.name = "rotation",
        .meaning = "to rotation, per radian and time",
        .unit = "force*length*time/depth",
        .fallback = "0",
        .range = not_negative},
};
constexpr Section damper_section{.title = "The damper of a rigid body", .keys = damper_keys};
constexpr Key end_element{
    .name = "end", .type = Type::word, .meaning = "what holds an end", .words = words_of<BeamEnd>};
constexpr Key line_point{
    .name = "point", .type = Type::pair, .meaning = "a point of the centre line", .unit = "length"};
constexpr array beam_keys{
    Key{.name = "line",
        .type = Type::list,
        .meaning =
            "points [x, y] of the centre line: a straight line through two, a spline through four or more",
        .unit = "length",
        .required = true,
        .element = &line_point},
    Key{.name = "closed",
        .type = Type::boolean,
        .meaning = "the line is a ring: its last point is joined to the first",
        .fallback = "false"},
    Key{.name = "thickness",
        .type = Type::field,
        .meaning = "thickness d, of the reference position: axial force E' d, shear 5/6 mu d, bending E' d^3 "
                   "/ 12, with E' = "
                   "E / (1 - nu^2); mass rho d; > 0 all along the line",
        .unit = "length",
        .required = true},
    Key{.name = "elements",
        .type = Type::integer,
        .meaning = "elements along the line",
        .fallback = "as long as the spacing h",
        .range = {.low = 3, .high = 5000}},
    Key{.name = "ends",
        .type = Type::list,
        .meaning = "what holds the first and the last end: free, pinned (its place), clamped (place and "
                   "direction), guided "
                   "(direction, and it moves across the line only). Where one of them is not free, `rho` may "
                   "be 0; without a gas the "
                   "ends must then hold every motion: one clamped, both pinned, one pinned and one guided, "
                   "or both guided across "
                   "different directions",
        .fallback = "[free, free]",
        .element = &end_element},
};
constexpr Section beam_section{.title = "A beam", .keys = beam_keys};

constexpr array solid_keys{
    Key{.name = "law",
        .type = Type::word,
        .meaning = "constitutive law; its program is solid_solver_<law>, or `program` where it is `external`",
        .required = true,
        .words = law_names},
    Key{.name = "program",
        .type = Type::text,
        .meaning = "the program of an external solid: a name among the programs of this project, or a path "
                   "with a / in it, which counts from where fsi is called",
        .fallback = "that of `law`"},
    Key{.name = "data",
        .type = Type::named,
        .meaning = "numbers for the program of an external solid",
        .fallback = "none",
        .most = config::most_keys,
        .element = &data_element},
    Key{.name = "rho",
        .meaning = "density of the reference configuration, > 0 but for a beam that is held",
        .unit = "mass/volume",
        .required = true,
        .range = not_negative},
    Key{.name = "lambda",
        .meaning = "Lame constant",
        .unit = "pressure",
        .fallback = "required (or `E` and `nu`), but where `law` is `rigid` or `external`",
        .range = not_negative},
    Key{.name = "mu",
        .meaning = "Lame constant (shear modulus)",
        .unit = "pressure",
        .fallback = "required with `lambda`",
        .range = positive},
    Key{.name = "E",
        .meaning =
            "Young's modulus, in the place of lambda and mu: lambda = E nu / ((1 + nu) (1 - 2 nu)), mu = E / "
            "(2 (1 + nu))",
        .unit = "pressure",
        .fallback = "required with `nu`",
        .range = positive},
    Key{.name = "nu",
        .meaning = "Poisson's ratio",
        .fallback = "required with `E`",
        .range = {.low = 0, .high = 0.5, .high_open = true}},
    Key{.name = "c10",
        .meaning =
            "coefficient of I1 - 3; `c10`, `c01` and `bulk` may stand in the place of lambda and mu: mu = 2 "
            "(c10 + c01), lambda = bulk - 2/3 mu",
        .unit = "pressure",
        .fallback = "required with `bulk`",
        .range = not_negative},
    Key{.name = "c01",
        .meaning = "coefficient of I2 - 3 of the law `mooney_rivlin`, at most mu / 2 and lambda / 4; with "
                   "other laws it counts in `c10` + `c01` only",
        .unit = "pressure",
        .fallback = "required with `law: mooney_rivlin` and with `c10`",
        .range = not_negative},
    Key{.name = "bulk",
        .meaning = "bulk modulus, at least 2/3 mu",
        .unit = "pressure",
        .fallback = "required with `c10`",
        .range = positive},
    Key{.name = "J_m",
        .meaning = "largest I1 - 3 of the law `gent`, which locks there, at least 2 mu / lambda; other laws "
                   "pass it over",
        .fallback = "required with `law: gent`",
        .range = positive},
    Key{.name = "motion",
        .type = Type::section,
        .meaning = "of a rigid body: `fixed` holds it where it is; a section says where it is at t, whatever "
                   "the gas does. Its load is in forces_NAME.csv",
        .fallback = "free",
        .words = motion_words,
        .section = &motion_section},
    Key{.name = "degrees_of_freedom",
        .type = Type::list,
        .meaning = "of a rigid body: what it is free to do at its pivot",
        .fallback = "[x, y, rotation], or along the walls that it slides along; where its motion is given, "
                    "nothing else",
        .element = &rigid_motion},
    Key{.name = "pivot",
        .type = Type::pair,
        .meaning = "of a rigid body: the point of it, inside or outside, at which it is held, at t = 0",
        .unit = "length",
        .fallback = "its centre of mass"},
    Key{.name = "spring",
        .type = Type::section,
        .meaning = "of a rigid body: pulls the pivot back to where it was at t = 0",
        .fallback = "none",
        .section = &spring_section},
    Key{.name = "damper",
        .type = Type::section,
        .meaning = "of a rigid body: resists its motion at the pivot",
        .fallback = "none",
        .section = &damper_section},
    Key{.name = "grid",
        .type = Type::section,
        .meaning = "the reference configuration; with a `shape` the core of its grids, a rectangle around it",
        .fallback = "required; with a `shape` chosen, as what else is missing of its grids",
        .section = &grid_section},
    Key{.name = "boundary",
        .type = Type::section,
        .meaning = "its four sides; with a `shape` those are free that are no side of the body",
        .fallback = "required, but where `shape` leaves nothing of them",
        .section = &solid_boundaries},
    Key{.name = "shape",
        .type = Type::section,
        .meaning = "outline of the solid where it is not that of `grid`, which then is a rectangle around it",
        .fallback = "the rim of `grid`",
        .section = &shape_section},
    Key{.name = "body_fitted",
        .type = Type::section,
        .meaning =
            "the grid along the outline; where it is chosen, at most 0.6 of the outline's smallest radius of "
            "curvature deep, and points of `grid` less than a quarter of its depth apart",
        .fallback = "all defaults",
        .section = &solid_fitted_section},
    Key{.name = "scheme",
        .type = Type::section,
        .meaning = "choices of the solver",
        .fallback = "all defaults",
        .section = &solid_scheme},
    Key{.name = "beam",
        .type = Type::section,
        .meaning = "centre line, thickness and supports where `law` is `beam`; the outline, which the gas "
                   "meets, moves with "
                   "the sections of the line",
        .fallback = "required with `law: beam`",
        .section = &beam_section},
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

}  // namespace

constinit const Section solid_boundary_section{.title = "A side of a solid",
                                               .keys = {},
                                               .variants = solid_boundary_variants,
                                               .words = solid_boundary_words};

const SolidBoundaryFacts& solid_boundary(BoundaryKind kind) {
  static constexpr SolidBoundaryFacts of_none{.meaning = "nothing is done"};
  const auto found = std::ranges::find(solid::boundary_kinds, kind);
  if (found == solid::boundary_kinds.end()) return of_none;
  return solid_boundary_facts[static_cast<std::size_t>(found - solid::boundary_kinds.begin())];
}

BoundaryKind kind_for_zero(std::string_view word) {
  const auto found = std::ranges::find(solid_boundary_facts, word, &SolidBoundaryFacts::word_for_zero);
  if (found == solid_boundary_facts.end() || word.empty()) return BoundaryKind::none;
  return solid::boundary_kinds[static_cast<std::size_t>(found - solid_boundary_facts.begin())];
}

constexpr auto solid_and_law_keys = with_law_numbers<solid_keys>();
constinit const Section solid_section{.title = "A solid", .keys = solid_and_law_keys};

}  // namespace fsi::schema
