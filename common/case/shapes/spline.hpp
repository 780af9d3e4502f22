#pragma once

#include <array>
#include <numbers>

#include "common/case/shapes/shape.hpp"
#include "common/grid/shapes/spline.hpp"

namespace fsi::shapes {

struct Spline {
  static constexpr std::array keys{
      schema::Key{.name = "through",
                  .type = schema::Type::list,
                  .meaning = "points on the curve in their order",
                  .unit = "length",
                  .fallback = "from `file`",
                  .element = &point_element},
      schema::Key{.name = "file",
                  .type = schema::Type::text,
                  .meaning = "CSV file with the points, x, y on each line, in the unit of the case; relative "
                             "to the case file",
                  .fallback = "from `through`"},
      schema::Key{
          .name = "corner_angle",
          .meaning =
              "the outline has a sharp corner at every point where the lines from point to point turn by "
              "more than this: a trailing edge",
          .unit = "degree",
          .fallback = "180: smooth everywhere",
          .range = {.low = 1, .high = 180}},
      blunt_key,
  };
  static constexpr ShapeFacts facts{.meaning = "a smooth curve through points", .keys = keys};

  static grid::PlaneCurve curve(const ShapeSection& section) {
    if (section.node.find("through") == nullptr)
      config::fail(section.node.place, section.path, "give `through: [[x, y], ..]` or `file: NAME.csv`");
    return grid::spline(section.points("through"), section.ends,
                        section.number("corner_angle", 180) / 180 * std::numbers::pi);
  }
};

}  // namespace fsi::shapes
