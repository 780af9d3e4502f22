#include "common/case/check/given/check_side_data.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/case/check/given/given.hpp"
#include "common/case/check/given/sample.hpp"
#include "common/case/document/fluid_sections.hpp"
#include "common/case/document/node_at.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// A side of a gas or a solid, with the place where the case speaks of it.
struct GivenSide {
  const BoundarySpec& spec;
  const Node& node;
  std::string path;
  std::vector<Vec2> points;
  double spacing;  ///< of its points [length]
};

GivenSide given_side(const GridSpec& grid, Side side, const BoundarySpec& spec, const Node& boundary,
                     const std::string& path) {
  return {.spec = spec,
          .node = node_at(boundary, {name_of(side)}),
          .path = fmt::format("{}.{}", path, name_of(side)),
          .points = sample_points(grid, side),
          .spacing = (side_point(grid, side, 1) - side_point(grid, side, 0)).norm()};
}

/// The outline of a solid with a shape of its own.
GivenSide given_outline(const BodyFittedSpec& outline, const Node& node, const std::string& path) {
  return {.spec = outline.boundary[static_cast<std::size_t>(outline.side)],
          .node = node,
          .path = path,
          .points = outline_points(outline.curve),
          .spacing = outline.curve.spacing};
}

[[noreturn]] void fail_at_side(const GivenSide& side, const std::string& key, const std::string& values,
                               const Vec2& x, double t) {
  fail(node_at(side.node, {key}).place, fmt::format("{}.{}", side.path, key),
       fmt::format("is {} at ({:.4g}, {:.4g}), t = {:.4g}; must be finite", values, x[0], x[1], t));
}

void check_values(const Case& problem, const GivenSide& side) {
  const auto check = [&](const std::string& key, const VectorExpressions& given, const Vec2& x, double t) {
    const double c1 = given.c1(x[0], x[1], t), c2 = given.c2(x[0], x[1], t);
    if (!std::isfinite(c1) || !std::isfinite(c2))
      fail_at_side(side, key, fmt::format("({}, {})", c1, c2), x, t);
  };
  const BoundarySpec& spec = side.spec;
  for (int k = 0; k < looked_at_times; ++k) {
    const double t = looked_at_time(problem, k);
    for (const Vec2& x : side.points) {
      if (spec.vector) check("value", *spec.vector, x, t);
      if (spec.velocity) check("velocity", *spec.velocity, x, t);
      for (const auto& [key, given] : spec.vectors) check(key, given, x, t);
      for (const auto& [key, given] : spec.fields) {
        const double value = given(x[0], x[1], t);
        if (!std::isfinite(value)) fail_at_side(side, key, fmt::to_string(value), x, t);
      }
    }
  }
}

/// A displacement that does not begin as the body does would tear its first cell in no time.
void check_fits(const GivenSide& side, const GivenVector& u) {
  if (schema::solid_boundary(side.spec.kind).holds != Hold::motion || !side.spec.vector || !u) return;
  constexpr double tolerance = 0.05;  // of the distance of points, as of an outline (check_starts.cpp)
  const GivenVector given = given_by(*side.spec.vector);
  for (const Vec2& x : side.points) {
    const Vec2 own = u(x, 0), of_side = given(x, 0);
    if ((of_side - own).norm() <= tolerance * side.spacing) continue;
    fail(node_at(side.node, {"value"}).place, side.path + ".value",
         fmt::format(
             "is ({:.3g}, {:.3g}) at ({:.4g}, {:.4g}), t = 0, where the solid starts with the displacement "
             "({:.3g}, {:.3g}); let it begin there, or give that displacement as `initial: {{u: [.., ..]}}`",
             of_side[0], of_side[1], x[0], x[1], own[0], own[1]));
  }
}

void check_solid_sides(const Case& problem, const SolidSpec& solid, const Node& node) {
  const std::string path = "solids." + solid.name;
  std::vector<GivenSide> sides;
  if (fitted_grids(solid).empty()) {
    for (const Side side : all_sides)
      sides.push_back(given_side(solid.grid, side, solid.boundary[static_cast<std::size_t>(side)],
                                 node_at(node, {"boundary"}), path + ".boundary"));
  } else {
    sides.push_back(given_outline(solid.body_fitted.front(), node_at(node, {"body_fitted", "boundary"}),
                                  path + ".body_fitted.boundary"));
  }
  const GivenVector u = initial_displacement(problem, solid);
  for (const GivenSide& side : sides) {
    check_values(problem, side);
    check_fits(side, u);
  }
}

}  // namespace

void check_side_data(const Case& problem, const Node& root) {
  for (const FluidSpec& fluid : problem.fluids) {
    const Node& boundary = node_at(fluid_section_of(root, fluid.name), {"boundary"});
    for (const Side side : all_sides)
      check_values(problem, given_side(fluid.grid, side, fluid.boundary[static_cast<std::size_t>(side)],
                                       boundary, fluid.path + ".boundary"));
  }
  for (const SolidSpec& solid : problem.solids)
    if (is_continuum(solid.law)) check_solid_sides(problem, solid, node_at(root, {"solids", solid.name}));
}

}  // namespace fsi
