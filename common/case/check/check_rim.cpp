#include "common/case/check/check_rim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "common/case/document/fluid_sections.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/core/component_major.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// Points in a row.
struct Run {
  int first = 0, points = 0;
};

/// The most points in a row that lie on a side but for round-off.
Run longest_along(const CurveSpec& curve, const GridSpec& grid, Side side) {
  constexpr double part = 1e-6;  // of a cell
  const double cell =
      direction_of(side) == 0 ? (grid.x_b - grid.x_a) / grid.n1 : (grid.y_b - grid.y_a) / grid.n2;
  Run longest, now;
  for (int k = 0; k < curve.points(); ++k) {
    const Vec2 x = vector_at(curve.x, static_cast<std::size_t>(k));
    const bool on = std::abs(x[direction_of(side)] - end_of(grid, side)) <= part * cell;
    now = on ? Run{now.points > 0 ? now.first : k, now.points + 1} : Run{};
    if (now.points > longest.points) longest = now;
  }
  return longest;
}

/// What to write for a rectangle that reaches some cells farther on that side.
std::string farther(const GridSpec& grid, Side side) {
  constexpr double cells = 4;
  const bool along_x = direction_of(side) == 0;
  std::array<double, 2> ends = along_x ? std::array{grid.x_a, grid.x_b} : std::array{grid.y_a, grid.y_b};
  const double way = cells * (ends[1] - ends[0]) / ((along_x ? grid.n1 : grid.n2) - 1);
  ends[at_upper_end(side) ? 1 : 0] += at_upper_end(side) ? way : -way;
  return fmt::format("`{}: [{:.4g}, {:.4g}]`", along_x ? "x" : "y", ends[0], ends[1]);
}

bool moves(const Case& problem, const BodyFittedSpec& fitted) {
  const auto solid = std::ranges::find(problem.solids, fitted.solid, &SolidSpec::name);
  return solid != problem.solids.end() && !solid->fixed;
}

/// Whether a curve that stays where it is changes nothing for the points of a side on it.
bool is_same(const BodyFittedSpec& fitted, const BoundarySpec& side) {
  const BoundaryKind own = fitted.boundary[static_cast<std::size_t>(fitted.side)].kind;
  const bool is_wall = own == BoundaryKind::interface || schema::gas_boundary(own).is_wall;
  return own == side.kind || (is_wall && schema::gas_boundary(side.kind).is_wall);
}

void check_curve(const Case& problem, const FluidSpec& fluid, std::size_t k, const Node& node) {
  const BodyFittedSpec& fitted = fluid.body_fitted[k];
  const bool goes = moves(problem, fitted);
  for (const Side side : all_sides) {
    const Run run = longest_along(fitted.curve, fluid.grid, side);
    constexpr int touches = 2;  // an end, or where a round body comes to the rim
    if (run.points <= touches) continue;
    if (!goes && is_same(fitted, fluid.boundary[static_cast<std::size_t>(side)])) continue;
    const Vec2 a = vector_at(fitted.curve.x, static_cast<std::size_t>(run.first)),
               b = vector_at(fitted.curve.x, static_cast<std::size_t>(run.first + run.points - 1));
    const std::string room = farther(fluid.grid, side);
    fail(node.place, fmt::format("{}.body_fitted[{}]", fluid.path, k),
         fmt::format(
             "the curve of grid `{}` lies along the {} side of {}.grid from ({:.6g}, {:.6g}) to ({:.6g}, "
             "{:.6g}), which has a condition of its own; {}",
             fitted.name, name_of(side), fluid.path, a[0], a[1], b[0], b[1],
             goes ? fmt::format("let the rectangle reach as far as the curve goes and some cells more, as {}",
                                room)
                  : fmt::format(
                        "write `{}: slip_wall` if all of that side lies on or behind the curve, or let the "
                        "rectangle reach some cells behind it: {}",
                        name_of(side), room)));
  }
}

}  // namespace

void check_rim(const Case& problem, const Node& root) {
  for (const FluidSpec& fluid : problem.fluids) {
    if (fluid.grid.kind != GridSpec::Kind::rectangle || fluid.grid.rotation != 0) continue;
    const Node& section = fluid_section_of(root, fluid.name);
    const Node* list = section.find("body_fitted");
    for (std::size_t k = 0; k < fluid.body_fitted.size(); ++k)
      check_curve(problem, fluid, k, list != nullptr && k < list->items.size() ? list->items[k] : section);
  }
}

}  // namespace fsi
