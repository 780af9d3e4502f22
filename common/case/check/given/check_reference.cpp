#include "common/case/check/given/check_reference.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/case/check/given/given.hpp"
#include "common/case/check/given/misfit.hpp"
#include "common/case/check/given/sample.hpp"
#include "common/case/document/fluid_sections.hpp"
#include "common/case/document/node_at.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/scales.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/types.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// Whether the reference describes the gas, or the solids.
bool describes(const ReferenceSpec& reference, bool gas) {
  if (!reference.in_formulas()) return true;
  return gas ? reference.fluid.has_value() : reference.u.has_value();
}

/// A body that starts from the reference is described there.
void check_start(const ReferenceSpec& reference, bool gas, const std::string& owner, const Node& node) {
  if (gas && reference.computed())
    fail(node.place, owner + ".initial",
         fmt::format("reference `{}` is computed from the state at the start; give it here",
                     name_of(reference.kind)));
  if (describes(reference, gas)) return;
  fail(node.place, owner + ".initial",
       fmt::format("takes its data from `reference`, which has no `{}`; add it there, or give the state here",
                   gas ? "fluid" : "u"));
}

/// A solution of this case.
void check_kind(const Case& problem, const Node& root) {
  if (problem.reference.kind == ReferenceKind::riemann && !problem.solids.empty())
    fail(node_at(root, {"reference", "kind"}).place, "reference",
         "`riemann` is a solution for a gas alone; leave it out");
}

/// What is said of solids goes together.
void check_motion_of_solids(const Case& problem, const Node& root) {
  if (problem.reference.u) return;
  for (const auto& [key, is_there] :
       {std::pair{"v", problem.reference.v.has_value()}, std::pair{"P", problem.reference.P.has_value()}}) {
    if (is_there)
      fail(node_at(root, {"reference", key}).place, fmt::format("reference.{}", key),
           "goes with `u`, which is missing");
  }
}

/// What holds on the outline of a solid with a `shape`; null where it has none.
const BoundarySpec* on_outline(const SolidSpec& solid) {
  if (solid.body_fitted.empty()) return nullptr;
  const BodyFittedSpec& outline = solid.body_fitted.front();
  return &outline.boundary[static_cast<std::size_t>(outline.side)];
}

std::string path_of_outline(const SolidSpec& solid) {
  return fmt::format("solids.{}.body_fitted.boundary", solid.name);
}

const Node& node_of_outline(const SolidSpec& solid, const Node& root) {
  return node_at(root, {"solids", solid.name, "body_fitted", "boundary"});
}

/// Who takes data from the reference finds them there.
void check_takers(const Case& problem, const Node& root) {
  const auto need = [&](const BoundarySpec& spec, bool is_gas, const std::string& path, const Node& node) {
    if (!spec.from_reference) return;
    if (problem.reference.computed()) {
      fail(node.place, path,
           fmt::format("reference `{}` is known at output times only; give the boundary data here",
                       name_of(problem.reference.kind)));
    }
    if (!describes(problem.reference, is_gas))
      fail(node.place, path,
           fmt::format("takes its data from `reference`, which has no `{}`", is_gas ? "fluid" : "u"));
    if (spec.kind == BoundaryKind::traction && !problem.reference.u)
      fail(node.place, path,
           fmt::format("takes its traction from `reference`, and `{}` has none; write `traction: [.., ..]`",
                       name_of(problem.reference.kind)));
  };
  for (const FluidSpec& fluid : problem.fluids) {
    if (fluid.initial_from_reference)
      check_start(problem.reference, true, fluid.path,
                  node_at(fluid_section_of(root, fluid.name), {"initial"}));
  }
  for (const SolidSpec& solid : problem.solids) {
    if (solid.initial_from_reference)
      check_start(problem.reference, false, "solids." + solid.name,
                  node_at(root, {"solids", solid.name, "initial"}));
  }
  for (const SolidSpec& solid : problem.solids) {
    if (const BoundarySpec* outline = on_outline(solid))
      need(*outline, false, path_of_outline(solid), node_of_outline(solid, root));
  }
  for (const Side side : all_sides) {
    const auto index = static_cast<std::size_t>(side);
    for (const FluidSpec& fluid : problem.fluids) {
      need(fluid.boundary[index], true, fmt::format("{}.boundary.{}", fluid.path, name_of(side)),
           node_at(fluid_section_of(root, fluid.name), {"boundary", name_of(side)}));
    }
    for (const SolidSpec& solid : problem.solids) {
      need(solid.boundary[index], false, fmt::format("solids.{}.boundary.{}", solid.name, name_of(side)),
           node_at(root, {"solids", solid.name, "boundary", name_of(side)}));
    }
  }
  for (const FluidSpec& fluid : problem.fluids) {
    for (const GivenOnCurve& given : given_on_curves(fluid, fluid_section_of(root, fluid.name)))
      need(given.spec, true, given.path, given.node);
  }
}

/// Points where a solid meets the gas at t = 0.
std::vector<Vec2> meeting_points(const SolidSpec& solid) {
  std::vector<Vec2> points;
  if (!solid.body_fitted.empty()) points = outline_points(solid.body_fitted.front().curve);
  for (const Side side : all_sides) {
    if (solid.boundary[static_cast<std::size_t>(side)].kind != BoundaryKind::interface) continue;
    for (int k = 0; k < points_along(solid.grid, side); ++k)
      points.push_back(side_point(solid.grid, side, k));
  }
  return points;
}

/// A chosen solution of gas and solid and a given path of the interface belong together.
void check_motion(const Case& problem, const Node& root) {
  const ReferenceSpec& reference = problem.reference;
  const bool chosen =
      reference.kind == ReferenceKind::manufactured && !problem.fluids.empty() && !problem.solids.empty();
  if (!problem.interface.motion) {
    if (!chosen) return;
    fail(node_at(root, {"reference"}).place, "reference",
         "kind manufactured for gas and solid needs the path of the interface; write interface: {motion: "
         "[.., ..]}");
  }
  const Node& node = node_at(root, {"interface", "motion"});
  if (!chosen || !reference.fluid || !reference.u) {
    fail(node.place, "interface.motion",
         "goes with `reference: {kind: manufactured, fluid: .., u: ..}` only; leave it out: the solid moves "
         "it");
  }
  for (const SolidSpec& solid : problem.solids) {
    if (is_continuum(solid.law)) continue;
    fail(node.place, "interface.motion",
         fmt::format(
             "is the path of elastic bodies, which take their load from `reference.u`; solid `{}` is `{}`",
             solid.name, solid.law));
  }
  constexpr double tolerance = 1e-9;
  for (const SolidSpec& solid : problem.solids) {
    for (const Vec2& x : meeting_points(solid)) {
      const Vec2 start(problem.interface.motion->c1(x[0], x[1], 0),
                       problem.interface.motion->c2(x[0], x[1], 0));
      if ((start - x).norm() <= tolerance * (size_of(solid.grid) + x.norm())) continue;
      fail(node.place, "interface.motion",
           fmt::format("must be (x, y) at t = 0, but ({:.6g}, {:.6g}) goes to ({:.6g}, {:.6g})", x[0], x[1],
                       start[0], start[1]));
    }
  }
}

/// Where the reference is a chosen displacement, what acts on the body is what makes it the solution.
void check_forces(const Case& problem, const Node& root) {
  if (problem.reference.kind != ReferenceKind::manufactured || !problem.reference.u) return;
  for (const SolidSpec& solid : problem.solids) {
    if (!solid.body_force) continue;
    fail(node_at(root, {"solids", solid.name, "body_force"}).place,
         fmt::format("solids.{}.body_force", solid.name),
         "has no effect: the force is the one that makes `reference.u` the solution; leave it out");
  }
}

/// The fine run of one dimension that `reference` asks for is one of this case.
void check_misfit(const Case& problem, const Node& root) {
  const ReferenceKind kind = problem.reference.kind;
  const auto found = kind == ReferenceKind::piston_1d       ? misfit_of_piston(problem)
                     : kind == ReferenceKind::rotating_disk ? misfit_of_disk(problem)
                                                            : std::nullopt;
  if (found) fail(node_at(root, found->path).place, found->path, found->text);
}

/// What a run that goes less far would not meet.
const char* remedy_at(double t) {
  return t > 0 ? "let time.end be smaller, or take other numbers there" : "take other numbers there";
}

/// Where a gas takes data from the reference this has them.
void check_gas_data(const GivenGas& gas, const std::vector<Vec2>& points, double t, const Node& node,
                    const std::string& path) {
  for (const Vec2& x : points) {
    const exact::GasState q = gas(x, t);
    if (q.rho > 0 && q.p > 0 && std::isfinite(q.rho + q.p + q.v1 + q.v2)) continue;
    fail(node.place, path,
         fmt::format(
             "takes its data from `reference`, which has rho = {:.3g}, p = {:.3g} at ({:.6g}, {:.6g}), "
             "t = {:.4g}; {}",
             q.rho, q.p, x[0], x[1], t, remedy_at(t)));
  }
}

void check_gas(const Case& problem, const FluidSpec& fluid, const GivenGas& gas, const Node& root) {
  const Node& node = fluid_section_of(root, fluid.name);
  if (fluid.initial_from_reference)
    check_gas_data(gas, sample_points(fluid), 0, node_at(node, {"initial"}), fluid.path + ".initial");
  for (const Side side : all_sides) {
    if (!fluid.boundary[static_cast<std::size_t>(side)].from_reference) continue;
    for (int k = 0; k < times_of_known_places(fluid, side); ++k) {
      const double t = looked_at_time(problem, k);
      check_gas_data(gas, sample_points(fluid.grid, side, t), t, node_at(node, {"boundary", name_of(side)}),
                     fmt::format("{}.boundary.{}", fluid.path, name_of(side)));
    }
  }
  for (const GivenOnCurve& given : given_on_curves(fluid, node)) {
    if (!given.spec.from_reference) continue;
    for (int k = 0; k < looked_at_times; ++k) {
      const double t = looked_at_time(problem, k);
      check_gas_data(gas, given.points, t, given.node, given.path);
    }
  }
}

/// The same of a solid's displacement.
void check_solid_data(const GivenVector& u, const std::vector<Vec2>& points, double t, const Node& node,
                      const std::string& path) {
  for (const Vec2& x : points) {
    if (u(x, t).allFinite()) continue;
    fail(node.place, path,
         fmt::format("takes its data from `reference`, whose displacement is not finite at ({:.6g}, {:.6g}), "
                     "t = {:.4g}; {}",
                     x[0], x[1], t, remedy_at(t)));
  }
}

/// The law has a stress where the reference takes the body.
void check_solid_strain(const SolidSpec& solid, const GivenVector& u, double t, const Node& node,
                        const std::string& path) {
  for (const BodyCell& cell : sample_cells(solid)) {
    const std::string wrong = unbearable(solid, deformation_gradient(cell, u, t));
    if (wrong.empty()) continue;
    fail(node.place, path,
         fmt::format("{} in the cell at ({:.6g}, {:.6g}) of solid `{}`, t = {:.4g}; {}", wrong, cell.x[0],
                     cell.x[1], solid.name, t, remedy_at(t)));
  }
}

void check_solid(const Case& problem, const SolidSpec& solid, const GivenVector& u, const Node& root) {
  const Node& node = node_at(root, {"solids", solid.name});
  const std::string path = "solids." + solid.name;
  if (solid.initial_from_reference) {
    check_solid_data(u, sample_points(solid), 0, node_at(node, {"initial"}), path + ".initial");
    check_solid_strain(solid, u, 0, node_at(root, {"reference"}), "reference");
  }
  for (int k = 0; k < looked_at_times; ++k) {
    const double t = looked_at_time(problem, k);
    if (problem.reference.kind == ReferenceKind::manufactured)
      check_solid_strain(solid, u, t, node_at(root, {"reference", "u"}), "reference.u");
    if (const BoundarySpec* outline = on_outline(solid); outline != nullptr && outline->from_reference)
      check_solid_data(u, outline_points(solid.body_fitted.front().curve), t, node_of_outline(solid, root),
                       path_of_outline(solid));
    for (const Side side : all_sides) {
      if (solid.boundary[static_cast<std::size_t>(side)].from_reference)
        check_solid_data(u, sample_points(solid.grid, side), t, node_at(node, {"boundary", name_of(side)}),
                         fmt::format("{}.boundary.{}", path, name_of(side)));
    }
  }
}

/// What is taken from a reference that is known beforehand is there.
void check_data(const Case& problem, const Node& root) {
  if (problem.reference.computed()) return;
  GivenGas gas;
  GivenVector u;
  try {
    gas = reference_gas(problem.reference);
    u = reference_displacement(problem.reference);
  } catch (const UserMistake& mistake) {
    fail(node_at(root, {"reference"}).place, "", mistake.what());
  }
  for (const FluidSpec& fluid : problem.fluids)
    if (gas) check_gas(problem, fluid, gas, root);
  for (const SolidSpec& solid : problem.solids)
    if (u && is_continuum(solid.law)) check_solid(problem, solid, u, root);
}

}  // namespace

void check_reference(const Case& problem, const Node& root) {
  check_kind(problem, root);
  check_motion_of_solids(problem, root);
  check_takers(problem, root);
  check_misfit(problem, root);
  check_motion(problem, root);
  check_forces(problem, root);
  check_data(problem, root);
}

}  // namespace fsi
