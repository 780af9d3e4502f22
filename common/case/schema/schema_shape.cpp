/// Curves, and the grids that are fitted to them.

#include <array>

#include "common/case/schema/schema.hpp"

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
constexpr Key point_element{.name = "point", .type = Type::pair, .meaning = "[x, y]", .unit = "length"};
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
constexpr Key centre_key{
    .name = "centre", .type = Type::pair, .meaning = "its middle", .unit = "length", .fallback = "[0, 0]"};
constexpr array circle_keys{
    centre_key,
    Key{.name = "radius", .meaning = "radius", .unit = "length", .required = true, .range = positive},
};
constexpr array ellipse_keys{
    centre_key,
    Key{.name = "semi_axes",
        .type = Type::pair,
        .meaning = "half lengths of its axes",
        .unit = "length",
        .required = true,
        .range = positive},
    Key{.name = "angle",
        .meaning = "of the first axis against the x axis, counter-clockwise",
        .unit = "degree",
        .fallback = "0"},
};
constexpr Key blunt_key{
    .name = "blunt",
    .meaning = "corners that turn by more than 110 degrees are cut off where the sides are so far apart",
    .unit = "length",
    .fallback = "0.5 * h",
    .range = positive};
constexpr array polygon_keys{
    Key{.name = "corners",
        .type = Type::list,
        .meaning = "corners in their order",
        .unit = "length",
        .required = true,
        .most = 200,
        .element = &point_element},
    Key{.name = "radius",
        .meaning =
            "corners become arcs of this radius between edges that stay where they are; 0: sharp corners",
        .unit = "length",
        .fallback = "from `sharpness`",
        .range = {.low = 0}},
    Key{.name = "sharpness",
        .meaning =
            "in place of `radius`: one over the radius of the rounded corners, in parts of the length; "
            "the outline is drawn in from its corners",
        .fallback = "50",
        .range = positive},
    blunt_key,
};
constexpr array spline_keys{
    Key{.name = "through",
        .type = Type::list,
        .meaning = "points on the curve in their order",
        .unit = "length",
        .fallback = "from `file`",
        .element = &point_element},
    Key{.name = "file",
        .type = Type::text,
        .meaning = "CSV file with the points, x, y on each line; relative to the case file",
        .fallback = "from `through`"},
    Key{.name = "corner_angle",
        .meaning =
            "the outline has a sharp corner at every point where the lines from point to point turn by more "
            "than this: a trailing edge",
        .unit = "degree",
        .fallback = "180: smooth everywhere",
        .range = {.low = 1, .high = 180}},
    blunt_key,
};
constexpr array shape_variants{
    Variant{"circle", "a circle", circle_keys},
    Variant{"ellipse", "an ellipse", ellipse_keys},
    Variant{"polygon", "a polygon with rounded corners", polygon_keys},
    Variant{"spline", "a smooth curve through points", spline_keys},
};

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
        .words = gas_boundary_words,
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
        .words = solid_boundary_words,
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
