#include "common/case/check/check_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "common/case/grids/grid_points.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/case/schema/laws.hpp"

namespace fsi {

bool is_wall(const BoundarySpec& boundary) {
  return boundary.kind == BoundaryKind::slip_wall || boundary.kind == BoundaryKind::symmetry;
}

std::array<Side, 2> sides_beside(Side side) {
  if (direction_of(side) == 1) return {Side::left, Side::right};
  return {Side::bottom, Side::top};
}

std::string wall_at(const FluidSpec& fluid, const SolidSpec& solid, const Vec2& x) {
  for (const BodyFittedSpec& grid : fluid.body_fitted) {
    if (grid.solid == solid.name && !grid.curve.closed()) return fmt::format("a wall of {}", fluid.path);
  }
  for (const Side side : all_sides) {
    const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
    if (spec.kind != BoundaryKind::interface || spec.solid != solid.name) continue;
    const Vec2 first = side_point(fluid.grid, side, 0);
    const Vec2 last = side_point(fluid.grid, side, points_along(fluid.grid, side) - 1);
    const Side end = sides_beside(side)[(x - first).norm() < (x - last).norm() ? 0 : 1];
    if (is_wall(fluid.boundary[static_cast<std::size_t>(end)]))
      return fmt::format("the {} side of {}.grid, a wall", name_of(end), fluid.path);
  }
  return "";
}

namespace {

using config::fail;
using config::Node;

/// The sides of a solid on which the ends of its interface with this gas lie.
std::array<Side, 2> sides_at_ends(const SolidSpec& solid, const FluidSpec& fluid) {
  if (!solid.body_fitted.empty()) return *solid.body_fitted.front().curve.walls;
  return sides_beside(side_to(solid, fluid.name).value());
}

/// The solid's own condition on the first and the last of its ends.
const BoundarySpec& condition_at(const SolidSpec& solid, const FluidSpec& fluid, std::size_t end) {
  if (solid.body_fitted.empty())
    return solid.boundary[static_cast<std::size_t>(sides_at_ends(solid, fluid)[end])];
  constexpr std::array ends{Side::left, Side::right};
  return solid.body_fitted.front().boundary[static_cast<std::size_t>(ends[end])];
}

/// What to write for one side of a body: all of them where the case has no `boundary` at all, whose sides must all be there.
std::string with_side(const Node* boundary, Side held, const char* how) {
  if (boundary != nullptr) return fmt::format("`{}: {}`", name_of(held), how);
  std::string sides;
  for (const Side side : all_sides)
    sides += fmt::format("{}{}: {}", sides.empty() ? "" : ", ", name_of(side), side == held ? how : "free");
  return fmt::format("`boundary: {{{}}}`", sides);
}

void check_end(const SolidSpec& solid, const FluidSpec& fluid, const BodyFittedSpec& grid, std::size_t end,
               const Node& root) {
  if (schema::solid_boundary(condition_at(solid, fluid, end).kind).holds != Hold::nothing) return;
  const auto n = static_cast<std::size_t>(grid.curve.points());
  const std::size_t k = end == 0 ? 0 : n - 1;
  const Side side = sides_at_ends(solid, fluid)[end];
  const std::string wall = grid.curve.on.empty() ? fmt::format("the {} side of {}.grid",
                                                               name_of((*grid.curve.walls)[end]), fluid.path)
                                                 : fmt::format("the wall of grid `{}`", grid.curve.on);
  const Node& node = *root.find("solids")->find(solid.name);
  const Node* boundary = node.find("boundary");
  const bool rigid = solid.law == rigid_law;
  fail(boundary != nullptr ? boundary->place : node.place, fmt::format("solids.{}.boundary", solid.name),
       fmt::format(
           "the outline ends at ({:.6g}, {:.6g}) on {}, but nothing holds it there: it would leave the wall, "
           "and the grid of the gas with it; write {}{} (it slides along the wall){}",
           grid.curve.x[k], grid.curve.x[n + k], wall, rigid ? "`motion: fixed`, or " : "",
           with_side(boundary, side, "slip_wall"),
           rigid ? "" : " or " + with_side(boundary, side, "clamped")));
}

/// The same where the gas meets the solid along a side of its own grid.
void check_end_of_side(const SolidSpec& solid, const FluidSpec& fluid, std::size_t end, const Node& root) {
  if (schema::solid_boundary(condition_at(solid, fluid, end).kind).holds != Hold::nothing) return;
  const Side side = side_to(solid, fluid.name).value();
  const Vec2 x = side_point(solid.grid, side, end == 0 ? 0 : points_along(solid.grid, side) - 1);
  const std::string wall = wall_at(fluid, solid, x);
  if (wall.empty()) return;
  const char* beside = name_of(sides_beside(side)[end]);
  const Node& node = *root.find("solids")->find(solid.name);
  const bool rigid = solid.law == rigid_law;
  fail(node.find("boundary")->find(beside)->place, fmt::format("solids.{}.boundary.{}", solid.name, beside),
       fmt::format("the interface ends at ({:.6g}, {:.6g}) on {}, but nothing holds it there: it would leave "
                   "the wall, and the grid of the gas with it; write {}`{}: slip_wall` (it slides along the "
                   "wall){}",
                   x.x(), x.y(), wall, rigid ? "`motion: fixed`, or " : "", beside,
                   rigid ? "" : fmt::format(" or `{}: clamped`", beside)));
}

bool follows_outline(const FluidSpec& fluid, const SolidSpec& solid) {
  return std::ranges::any_of(fluid.body_fitted,
                             [&](const BodyFittedSpec& grid) { return grid.solid == solid.name; });
}

/// A beam holds its own ends, or says how; a path that the case gives leads along the walls.
bool holds_itself(const Case& problem, const SolidSpec& solid) {
  return solid.fixed || (!is_continuum(solid.law) && solid.law != rigid_law) || problem.interface.motion;
}

}  // namespace

void check_held_ends(const Case& problem, const Node& root) {
  for (const FluidSpec& fluid : problem.fluids) {
    for (const BodyFittedSpec& grid : fluid.body_fitted) {
      const auto solid = std::ranges::find(problem.solids, grid.solid, &SolidSpec::name);
      if (solid == problem.solids.end() || grid.curve.closed() || solid->fixed) continue;
      if (!is_continuum(solid->law) && solid->law != rigid_law)
        continue;  // they hold their own ends, or say how
      if (solid->body_fitted.empty() && !side_to(*solid, fluid.name)) continue;  // another check says so
      for (const std::size_t end : {0U, 1U}) check_end(*solid, fluid, grid, end, root);
    }
    for (const SolidSpec& solid : problem.solids) {
      if (!solid.body_fitted.empty() || holds_itself(problem, solid) || follows_outline(fluid, solid) ||
          !side_to(solid, fluid.name))
        continue;
      for (const std::size_t end : {0U, 1U}) check_end_of_side(solid, fluid, end, root);
    }
  }
}

}  // namespace fsi
