#pragma once

#include <array>
#include <numbers>

#include "common/case/shapes/shape.hpp"
#include "common/grid/shapes/ellipse.hpp"

namespace fsi::shapes {

struct Ellipse {
  static constexpr std::array keys{
      centre_key,
      schema::Key{.name = "semi_axes",
                  .type = schema::Type::pair,
                  .meaning = "half lengths of its axes",
                  .unit = "length",
                  .required = true,
                  .range = schema::positive},
      schema::Key{.name = "angle",
                  .meaning = "of the first axis against the x axis, counter-clockwise",
                  .unit = "degree",
                  .fallback = "0"},
  };
  static constexpr ShapeFacts facts{.meaning = "an ellipse", .keys = keys, .may_be_open = false};

  static grid::PlaneCurve curve(const ShapeSection& section) {
    const Vec2 semi_axes = ShapeSection::pair_of(*section.node.find("semi_axes"));
    return grid::ellipse({.centre = section.pair("centre", Vec2::Zero()),
                          .a = semi_axes[0],
                          .b = semi_axes[1],
                          .angle = section.number("angle", 0) * std::numbers::pi / 180});
  }
};

}  // namespace fsi::shapes
