#include "common/case/read/idle_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "common/case/grids/curve_side.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

using config::fail;

bool is_free(const BoundarySpec& spec) {
  return schema::solid_boundary(spec.kind).holds == Hold::nothing && !carries_load(spec);
}

}  // namespace

void refuse_idle_sides(const config::Node& node, const std::string& path, const SolidSpec& solid) {
  const config::Node* boundary = node.find("boundary");
  if (boundary == nullptr || solid.body_fitted.empty()) return;
  const std::vector<Side> of_body = sides_of_body(solid);
  for (const Side side : all_sides) {
    const BoundarySpec& spec = solid.boundary[static_cast<std::size_t>(side)];
    const bool stands_on = std::ranges::find(of_body, side) != of_body.end();
    if (stands_on ? spec.kind != BoundaryKind::interface : is_free(spec)) continue;
    const std::string name = name_of(side);
    fail(boundary->find(name)->place, fmt::format("{}.boundary.{}", path, name),
         stands_on
             ? fmt::format("the body stands on this side; write {}`{}: slip_wall`",
                           solid.law == rigid_law ? "" : fmt::format("`{}: clamped` or ", name), name)
             : "is no side of the body, whose outline is `shape`, and would have no effect; write free; what "
               "holds on the outline of a body without a gas is `body_fitted: {boundary: ..}`, and a rigid "
               "body may be held by `motion: fixed`");
  }
}

}  // namespace fsi
