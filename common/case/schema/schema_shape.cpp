/// Curves, and the grids that are fitted to them.

#include <array>
#include <cstddef>

#include "common/case/schema/schema.hpp"
#include "common/case/shapes/every_shape.hpp"

namespace fsi::schema {

namespace {

using std::array;
using std::string_view;

constexpr array weight_keys{
    Key{.name = "strength", .meaning = "about this part of all points goes there", .required = true},
    Key{.name = "sharpness",
        .meaning = "one over the width of the place, in parts of the curve's length",
        .required = true,
        .range = positive},
    Key{.name = "place",
        .meaning = "where, in parts of the curve's length",
        .required = true,
        .range = {.low = 0, .high = 1}},
};
constexpr Section weight_section{.title = "A place where points cluster", .keys = weight_keys};
constexpr Key weight_element{
    .name = "weight", .type = Type::section, .meaning = "a place", .section = &weight_section};
constexpr array<string_view, 4> side_words{"left", "right", "bottom", "top"};
constexpr Key side_element{.name = "side", .type = Type::word, .meaning = "a side", .words = side_words};

constexpr Key wall_element{.name = "wall", .type = Type::name, .meaning = "a side, or a grid along a wall"};

constexpr array shape_keys{
    Key{.name = "points",
        .type = Type::integer,
        .meaning = "points along the curve; of a closed one the last is the first",
        .fallback = "from `spacing`",
        .range = {.low = 9, .high = 10000}},
    Key{.name = "spacing",
        .meaning = "distance of points along the curve, rounded (in place of `points`)",
        .unit = "length",
        .fallback = "h",
        .range = positive},
    Key{.name = "weights",
        .type = Type::list,
        .meaning = "places where points cluster",
        .fallback = "[]",
        .most = 100,
        .element = &weight_element},
    Key{.name = "walls",
        .type = Type::list,
        .meaning = "open curve: the sides of the background (left, right, bottom, top) on which its two ends "
                   "lie; or twice "
                   "the name of a grid of `fluid.body_fitted` with a `shape`, on whose wall, straight there, "
                   "both ends stand",
        .fallback = "closed curve",
        .element = &wall_element},
};
constexpr auto shape_variants = [] {
  array<Variant, shapes::shape_names.size()> variants{};
  for (std::size_t k = 0; k < variants.size(); ++k)
    variants[k] = {shapes::shape_names[k], shapes::shape_facts[k].meaning, shapes::shape_facts[k].keys};
  return variants;
}();

constexpr Key lines_key{.name = "lines",
                        .type = Type::integer,
                        .meaning = "grid lines along the curve, the curve included",
                        .fallback = "8, or chosen",
                        .range = {.low = 5, .high = 1000}};
constexpr Key line_spacing_key{.name = "spacing",
                               .meaning = "distance of the first line from the curve",
                               .unit = "length",
                               .fallback = "h, or chosen",
                               .range = positive};
constexpr Key growth_key{.name = "growth",
                         .meaning = "ratio of successive distances",
                         .fallback = "1",
                         .range = {.low = 0.5, .high = 2}};
constexpr Key concave_key{
    .name = "concave_smoothing",
    .meaning =
        "how strongly lines that converge are smoothed, in parts of the grid's depth: only where the "
        "curve is concave with a radius below 4/3 of that depth; 0: not at all",
    .fallback = "1",
    .range = {.low = 0, .high = 10}};

constexpr Key map_key{
    .name = "map",
    .type = Type::map,
    .meaning =
        "position of the point with parameters r along the curve and s from the curve (0) to the "
        "last line (1), in place of marching; at s = 0 it must be the curve",
    .unit = "length",
    .fallback = "marched from the curve"};

constexpr array gas_fitted_keys{
    Key{.name = "name", .type = Type::name, .meaning = "name in messages and output", .required = true},
    Key{.name = "solid",
        .type = Type::name,
        .meaning = "fitted to the outline of this solid, or to its interface side, which it meets",
        .fallback = "fitted to `shape`"},
    Key{.name = "points",
        .type = Type::integer,
        .meaning = "points along the solid's outline or side, where they are not those of the solid",
        .fallback = "those of the solid",
        .range = {.low = 9, .high = 10000}},
    Key{.name = "walls",
        .type = Type::list,
        .meaning =
            "of a solid without `shape`, which is met along a side of its grid: the sides of the background "
            "(left, right, bottom, top) on which the first and the last point of that side lie",
        .fallback = "those of the outline",
        .element = &side_element},
    Key{.name = "shape",
        .type = Type::section,
        .meaning = "the curve where it is not a solid's outline: a wall",
        .fallback = "the outline of `solid`",
        .section = &shape_section},
    Key{.name = "boundary",
        .type = Type::section,
        .meaning = "what holds on `shape`; a bare word is its kind",
        .fallback = "slip_wall",
        .section = &gas_boundary_section},
    Key{.name = "inside", .type = Type::boolean, .meaning = "the gas is inside `shape`", .fallback = "false"},
    lines_key,
    line_spacing_key,
    growth_key,
    concave_key,
    map_key,
};
constexpr array solid_fitted_keys{
    Key{.name = "boundary",
        .type = Type::section,
        .meaning = "what holds on the outline; a bare word is its kind",
        .fallback = "interface",
        .section = &solid_boundary_section},
    lines_key,
    line_spacing_key,
    growth_key,
    concave_key,
    map_key,
};

}  // namespace

constinit const Section shape_section{
    .title = "A curve", .keys = shape_keys, .variants = shape_variants, .default_kind = ""};

constinit const Section gas_fitted_section{.title = "A grid of the gas fitted to a curve",
                                           .keys = gas_fitted_keys};

constinit const Section solid_fitted_section{.title = "The grid of a solid fitted to its outline",
                                             .keys = solid_fitted_keys};

}  // namespace fsi::schema
