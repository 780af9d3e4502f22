#pragma once

#include <array>

#include "common/case/shapes/shape.hpp"
#include "common/grid/shapes/rounded_polygon.hpp"
#include "common/grid/shapes/smoothed_polygon.hpp"

namespace fsi::shapes {

struct Polygon {
  static constexpr std::array keys{
      schema::Key{.name = "corners",
                  .type = schema::Type::list,
                  .meaning = "corners in their order",
                  .unit = "length",
                  .required = true,
                  .most = 200,
                  .element = &point_element},
      schema::Key{.name = "radius",
                  .meaning = "corners become arcs of this radius between edges that stay where they are; 0: "
                             "sharp corners",
                  .unit = "length",
                  .fallback = "from `sharpness`; 0 of a thin body",
                  .range = {.low = 0}},
      schema::Key{
          .name = "sharpness",
          .meaning =
              "in place of `radius`: one over the width of the bell that rounds the corners, in parts of the "
              "length of the edges together; a right angle then has a smallest radius of length / (1.41 "
              "sharpness), a sharper corner a smaller one; the outline is drawn in from its corners",
          .fallback = "50",
          .range = schema::positive},
      blunt_key,
  };
  static constexpr ShapeFacts facts{.meaning = "a polygon with rounded corners", .keys = keys};

  static grid::PlaneCurve curve(const ShapeSection& section) {
    const config::Node *radius = section.node.find("radius"), *sharpness = section.node.find("sharpness");
    if (radius != nullptr && sharpness != nullptr)
      config::fail(sharpness->place, section.path, "give `radius` or `sharpness`, one of them");
    if (radius != nullptr)
      return grid::rounded_polygon(
          {.corners = section.points("corners"), .ends = section.ends, .radius = *radius->number});
    grid::SmoothedPolygon polygon{.corners = section.points("corners"), .ends = section.ends};
    polygon.sharpness = section.number("sharpness", polygon.sharpness);
    return grid::smoothed_polygon(polygon);
  }
};

}  // namespace fsi::shapes
