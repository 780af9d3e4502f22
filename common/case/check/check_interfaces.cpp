#include "common/case/check/check_interfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "common/case/check/check_meeting.hpp"
#include "common/case/document/fluid_sections.hpp"
#include "common/case/document/node_at.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/types.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

const Node& side_of(const Node& root, const FluidSpec& fluid, Side side) {
  return node_at(fluid_section_of(root, fluid.name), {"boundary", name_of(side)});
}

/// The sides of the gas that are interfaces to a solid.
std::vector<Side> sides_to(const FluidSpec& fluid, const std::string& solid) {
  std::vector<Side> sides;
  for (const Side side : all_sides) {
    const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
    if (spec.kind == BoundaryKind::interface && spec.solid == solid) sides.push_back(side);
  }
  return sides;
}

std::ptrdiff_t grids_at(const FluidSpec& fluid, const std::string& solid) {
  return std::ranges::count(fluid.body_fitted, solid, &BodyFittedSpec::solid);
}

/// The sides of a gas name solids that are there.
void check_sides(const Case& problem, const FluidSpec& fluid, const Node& root) {
  std::vector<std::string> names;
  for (const SolidSpec& solid : problem.solids) names.push_back(solid.name);
  for (const Side side : all_sides) {
    const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
    if (spec.kind != BoundaryKind::interface ||
        std::find(names.begin(), names.end(), spec.solid) != names.end())
      continue;
    fail(node_at(side_of(root, fluid, side), {"solid"}).place,
         fmt::format("{}.boundary.{}", fluid.path, name_of(side)),
         fmt::format("there is no solid {}{}", in_ticks(spec.solid), did_you_mean(spec.solid, names)));
  }
  if (problem.fluids.size() == 1) return;
  if (std::ranges::none_of(names, [&](const std::string& solid) { return meets(fluid, solid); })) {
    fail(fluid_section_of(root, fluid.name).place, fluid.path,
         "meets no solid, so that nothing connects it with the other gases; write a case of its own");
  }
}

/// A side that meets a solid takes the whole grid with it, which the background of other grids cannot.
void check_background(const FluidSpec& fluid, const Node& root) {
  if (fluid.body_fitted.empty()) return;
  for (const Side side : all_sides) {
    const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
    if (spec.kind != BoundaryKind::interface) continue;
    const bool upright = side == Side::left || side == Side::right;
    if (grids_at(fluid, spec.solid) > 0)
      fail(side_of(root, fluid, side).place, fmt::format("{}.boundary.{}", fluid.path, name_of(side)),
           fmt::format("{} meets the gas by its grid in `body_fitted`; write slip_wall or outflow here",
                       in_ticks(spec.solid)));
    fail(
        side_of(root, fluid, side).place, fmt::format("{}.boundary.{}", fluid.path, name_of(side)),
        fmt::format("moves with {} and the whole grid with it, but the background of the grids in "
                    "`body_fitted` stays; write slip_wall here, {{name: at_{}, solid: {}, walls: [{}]}} into "
                    "`body_fitted`, and let `grid` begin behind the interface",
                    in_ticks(spec.solid), spec.solid, spec.solid, upright ? "bottom, top" : "left, right"));
  }
}

/// A solid with a shape of its own meets the gas along its outline.
void check_outline(const Case& problem, const SolidSpec& solid, const Node& root) {
  const BodyFittedSpec& outline = solid.body_fitted.front();
  const Node& node = node_at(root, {"solids", solid.name, "body_fitted", "boundary"});
  const std::string path = fmt::format("solids.{}.body_fitted.boundary", solid.name);
  const BoundarySpec& own = outline.boundary[static_cast<std::size_t>(outline.side)];
  const bool is_interface = own.kind == BoundaryKind::interface;
  if (problem.fluids.empty()) {
    if (is_interface)
      fail(node.place, path, "an interface, but the case has no gas; write free, for example");
    return;
  }
  if (!is_interface) fail(node.place, path, "must be an interface: the case has a gas");
  std::size_t gases = 0;
  for (const FluidSpec& fluid : problem.fluids) {
    const auto grids = grids_at(fluid, solid.name);
    gases += grids > 0 ? 1 : 0;
    if (grids > 1)
      fail(node_at(fluid_section_of(root, fluid.name), {"body_fitted"}).place, fluid.path + ".body_fitted",
           fmt::format("{} grids meet solid `{}`; keep one", grids, solid.name));
  }
  if (gases > 0 || problem.fluids.size() == 1) return;
  fail(node.place, fmt::format("solids.{}.shape", solid.name),
       fmt::format("no gas has a grid along it; write body_fitted: [{{name: around_{}, solid: {}}}] into the "
                   "one in which it is",
                   solid.name, solid.name));
}

/// One interface of a solid that meets gases along sides of its grid.
void check_side(const FluidSpec& fluid, const SolidSpec& solid, Side own, bool displaced, const Node& root) {
  const Node& place = node_at(root, {"solids", solid.name, "boundary"});
  const std::vector<Side> gas = sides_to(fluid, solid.name);
  const auto fitted = grids_at(fluid, solid.name);
  if (fitted + std::ssize(gas) > 1 && fitted > 0) {
    fail(node_at(fluid_section_of(root, fluid.name), {"body_fitted"}).place, fluid.path + ".body_fitted",
         fmt::format("solid `{}` is met more than once; keep one", solid.name));
  }
  if (fitted == 1) return;
  if (gas.empty()) {
    fail(node_at(place, {name_of(own)}).place, fmt::format("solids.{}.boundary.{}", solid.name, name_of(own)),
         fmt::format("the interface has no partner; write {{kind: interface, solid: {}}} on a side of "
                     "{}.boundary",
                     solid.name, fluid.path));
  }
  if (gas.size() > 1) {
    fail(side_of(root, fluid, gas[1]).place, fluid.path + ".boundary",
         fmt::format("two sides meet solid `{}`; keep one", solid.name));
  }
  check_periods_meet(fluid, solid, gas.front(), own, place);
  if (!displaced) check_sides_meet(fluid, solid, gas.front(), own, side_of(root, fluid, gas.front()));
}

/// The gases that meet a solid are those that its interfaces name.
void check_named(const Case& problem, const SolidSpec& solid, const std::string& path, const Node& place) {
  const std::vector<std::string> own = gases_at(solid);
  for (const FluidSpec& fluid : problem.fluids) {
    if (!meets(fluid, solid.name) || std::ranges::find(own, fluid.name) != own.end()) continue;
    fail(place.place, path,
         fmt::format(
             "no side is the interface to `{}`, which meets this solid; write {{kind: interface, fluid: "
             "{}}} on one",
             fluid.name, fluid.name));
  }
  const FluidSpec* first = own.empty() ? nullptr : fluid_named(problem, own.front());
  for (const std::string& name : own) {
    const FluidSpec* fluid = fluid_named(problem, name);
    if (first == nullptr || fluid == nullptr || fluid->p_e == first->p_e) continue;
    fail(place.place, path,
         fmt::format("p_e, at which the solid is free of stress, is {} in {} and {} in {}; write the same in "
                     "both (either may begin at another pressure)",
                     first->p_e, first->path, fluid->p_e, fluid->path));
  }
}

void check_grid_sides(const Case& problem, const SolidSpec& solid, const Node& root) {
  const std::string path = fmt::format("solids.{}.boundary", solid.name);
  const Node& place = node_at(root, {"solids", solid.name, "boundary"});
  const bool displaced = solid.initial_from_reference &&
                         problem.reference.kind != ReferenceKind::elastic_piston &&
                         problem.reference.kind != ReferenceKind::wall_between_gases &&
                         problem.reference.kind != ReferenceKind::clamped_wall;
  std::vector<Side> sides;
  for (const Side side : all_sides) {
    const BoundarySpec& spec = solid.boundary[static_cast<std::size_t>(side)];
    if (spec.kind != BoundaryKind::interface) continue;
    sides.push_back(side);
    const auto before = sides.end() - 1;
    const auto has_same = [&](Side other) {
      return solid.boundary[static_cast<std::size_t>(other)].fluid == spec.fluid;
    };
    if (std::find_if(sides.begin(), before, has_same) != before)
      fail(node_at(place, {name_of(side)}).place, path,
           problem.fluids.size() < 2
               ? "two sides are interfaces; a solid meets the gas along one, or all around its `shape`"
               : fmt::format("two sides are interfaces to {}; a solid meets each gas along one",
                             in_ticks(spec.fluid)));
  }
  if (sides.empty() && !problem.fluids.empty())
    fail(place.place, path,
         "no side is an interface, yet the case has a gas; write `interface` on the side that meets it");
  std::vector<std::string> names;
  for (const FluidSpec& fluid : problem.fluids) names.push_back(fluid.name);
  for (const Side side : sides) {
    const std::string& own = solid.boundary[static_cast<std::size_t>(side)].fluid;
    const std::string name = own.empty() && !names.empty() ? names.front() : own;
    if (const FluidSpec* fluid = fluid_named(problem, name)) {
      check_side(*fluid, solid, side, displaced, root);
      continue;
    }
    fail(node_at(place, {name_of(side), "fluid"}).place, fmt::format("{}.{}", path, name_of(side)),
         names.empty() ? "an interface, but the case has no gas; write free, for example"
                       : fmt::format("there is no gas {}{}", in_ticks(name), did_you_mean(name, names)));
  }
  check_named(problem, solid, path, place);
}

}  // namespace

void check_interfaces(const Case& problem, const Node& root) {
  for (const FluidSpec& fluid : problem.fluids) {
    check_sides(problem, fluid, root);
    check_background(fluid, root);
  }
  for (const SolidSpec& solid : problem.solids) {
    if (solid.body_fitted.empty()) {
      check_grid_sides(problem, solid, root);
    } else {
      check_outline(problem, solid, root);
    }
  }
}

}  // namespace fsi
