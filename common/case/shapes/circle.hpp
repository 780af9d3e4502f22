#pragma once

#include <array>

#include "common/case/shapes/shape.hpp"
#include "common/grid/shapes/circle.hpp"

namespace fsi::shapes {

struct Circle {
  static constexpr std::array keys{
      centre_key,
      schema::Key{.name = "radius",
                  .meaning = "radius",
                  .unit = "length",
                  .required = true,
                  .range = schema::positive},
  };
  static constexpr ShapeFacts facts{.meaning = "a circle", .keys = keys, .may_be_open = false};

  static grid::PlaneCurve curve(const ShapeSection& section) {
    return grid::circle(section.pair("centre", Vec2::Zero()), *section.node.find("radius")->number);
  }
};

}  // namespace fsi::shapes
