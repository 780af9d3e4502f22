#include "common/case/check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/case/check/check_ends.hpp"
#include "common/case/check/check_expectations.hpp"
#include "common/case/check/check_geometry.hpp"
#include "common/case/check/check_meeting.hpp"
#include "common/case/check/check_overlap.hpp"
#include "common/case/check/check_places.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/types.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// Node of a dotted key; the deepest one that exists.
const Node& at(const Node& root, std::initializer_list<std::string_view> keys) {
  const Node* node = &root;
  for (const std::string_view key : keys) {
    const Node* next = node->find(key);
    if (next == nullptr) break;
    node = next;
  }
  return *node;
}

/// The cells of a sample have positive area: a map that folds costs one look, not a run.
void check_grid(const GridSpec& grid, const Node& node, const std::string& path) {
  constexpr int samples = 64;  // in each direction
  const int step1 = std::max(1, (grid.n1 - 1) / samples);
  const int step2 = std::max(1, (grid.n2 - 1) / samples);
  for (int j = 0; j + 1 < grid.n2; j += step2) {
    for (int i = 0; i + 1 < grid.n1; i += step1) {
      const Vec2 a = position(grid, i, j, 0);
      const Vec2 along1 = position(grid, i + 1, j, 0) - a;
      const Vec2 along2 = position(grid, i, j + 1, 0) - a;
      const double area = along1[0] * along2[1] - along1[1] * along2[0];
      if (area > 0 && std::isfinite(area)) continue;
      fail(node.place, path,
           fmt::format("the grid folds at point ({}, {}) at t = 0, near ({:.4g}, {:.4g}); change `map`", i, j,
                       a[0], a[1]));
    }
  }
}

/// A sample of points of a grid at t = 0: of all of it, or of one side.
std::vector<Vec2> sample_points(const GridSpec& grid, std::optional<Side> side = {}) {
  constexpr int samples = 8;  // in each direction
  std::vector<Vec2> points;
  for (int b = 0; b <= samples; ++b) {
    if (side) {
      points.push_back(side_point(grid, *side, b * (points_along(grid, *side) - 1) / samples));
      continue;
    }
    for (int a = 0; a <= samples; ++a) {
      points.push_back(position(grid, a * (grid.n1 - 1) / samples, b * (grid.n2 - 1) / samples, 0));
    }
  }
  return points;
}

/// Density and pressure are positive and everything is finite at t = 0 at the points.
void check_state(const GasExpressions& state, const std::vector<Vec2>& points, const Node& node,
                 const std::string& path) {
  for (const Vec2& x : points) {
    const auto check = [&](const Expression& quantity, const char* name, bool must_be_positive) {
      const double value = quantity(x[0], x[1], 0);
      if (std::isfinite(value) && (value > 0 || !must_be_positive)) return;
      const Node* own = node.find(name);
      fail(own == nullptr ? node.place : own->place, fmt::format("{}.{}", path, name),
           fmt::format("is {} at ({:.4g}, {:.4g}), t = 0; must be {}", value, x[0], x[1],
                       must_be_positive ? "> 0" : "finite"));
    };
    check(state.rho, "rho", true);
    check(state.p, node.find("p") != nullptr ? "p" : "T", true);
    check(state.v1, "v", false);
    check(state.v2, "v", false);
  }
}

void check_fluid(const Case& problem, const Node& root) {
  const FluidSpec& fluid = *problem.fluid;
  const Node& node = at(root, {"fluid"});
  check_grid(fluid.grid, at(node, {"grid"}), "fluid.grid");
  check_overlap({.background = fluid.grid, .body_fitted = fluid.body_fitted, .owner = node, .path = "fluid"});
  const std::vector<Vec2> everywhere = sample_points(fluid.grid);
  if (fluid.initial) check_state(*fluid.initial, everywhere, at(node, {"initial"}), "fluid.initial");
  if (problem.reference.fluid)
    check_state(*problem.reference.fluid, everywhere, at(root, {"reference", "fluid"}), "reference.fluid");
  for (const Side side : all_sides) {
    const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
    if (!spec.state) continue;
    check_state(*spec.state, sample_points(fluid.grid, side), at(node, {"boundary", name_of(side), "state"}),
                fmt::format("fluid.boundary.{}.state", name_of(side)));
  }
}

std::vector<std::string> solid_names(const Case& problem) {
  std::vector<std::string> names;
  for (const SolidSpec& solid : problem.solids) names.push_back(solid.name);
  return names;
}

/// The side of a body that is an interface; for the gas, that to `solid`.
std::vector<Side> interface_sides(const std::array<BoundarySpec, 4>& boundary,
                                  const std::string& solid = "") {
  std::vector<Side> sides;
  for (const Side side : all_sides) {
    const BoundarySpec& spec = boundary[static_cast<std::size_t>(side)];
    if (spec.kind == BoundaryKind::interface && spec.solid == solid) sides.push_back(side);
  }
  return sides;
}

/// A solid with a shape of its own meets the gas along its outline.
void check_outline(const Case& problem, const SolidSpec& solid, const Node& root) {
  const BodyFittedSpec& outline = solid.body_fitted.front();
  const Node& node = at(root, {"solids", solid.name, "body_fitted", "boundary"});
  const std::string path = fmt::format("solids.{}.body_fitted.boundary", solid.name);
  const bool meets = outline.boundary[static_cast<std::size_t>(outline.side)].kind == BoundaryKind::interface;
  if (!problem.fluid) {
    if (meets) fail(node.place, path, "an interface, but the case has no gas; write free, for example");
    return;
  }
  const auto grids = std::ranges::count(problem.fluid->body_fitted, solid.name, &BodyFittedSpec::solid);
  const Node& gas = at(root, {"fluid", "body_fitted"});
  if (!meets) fail(node.place, path, "must be an interface: the case has a gas");
  if (grids > 1)
    fail(gas.place, "fluid.body_fitted",
         fmt::format("{} grids meet solid `{}`; keep one", grids, solid.name));
}

void check_interfaces(const Case& problem, const Node& root) {
  const std::vector<std::string> names = solid_names(problem);
  if (problem.fluid) {
    for (const Side side : all_sides) {
      const BoundarySpec& spec = problem.fluid->boundary[static_cast<std::size_t>(side)];
      if (spec.kind != BoundaryKind::interface ||
          std::find(names.begin(), names.end(), spec.solid) != names.end())
        continue;
      fail(at(root, {"fluid", "boundary", name_of(side), "solid"}).place,
           fmt::format("fluid.boundary.{}", name_of(side)),
           fmt::format("there is no solid {}{}", in_ticks(spec.solid), did_you_mean(spec.solid, names)));
    }
  }
  for (const SolidSpec& solid : problem.solids) {
    if (!solid.body_fitted.empty()) {
      check_outline(problem, solid, root);
      continue;
    }
    const std::vector<Side> own = interface_sides(solid.boundary);
    const std::string path = fmt::format("solids.{}.boundary", solid.name);
    const Node& place = at(root, {"solids", solid.name, "boundary"});
    const std::vector<Side> gas =
        problem.fluid ? interface_sides(problem.fluid->boundary, solid.name) : std::vector<Side>{};
    const auto fitted =
        problem.fluid ? std::ranges::count(problem.fluid->body_fitted, solid.name, &BodyFittedSpec::solid)
                      : 0;
    if (own.empty() && !problem.fluid) continue;
    if (own.empty())
      fail(place.place, path,
           "no side is an interface, yet the case has a gas; write `interface` on the side that meets it");
    const std::string own_path = fmt::format("{}.{}", path, name_of(own.front()));
    if (own.size() > 1) fail(place.place, path, "two sides are interfaces; a solid meets the gas along one");
    if (fitted + std::ssize(gas) > 1 && fitted > 0) {
      fail(at(root, {"fluid", "body_fitted"}).place, "fluid.body_fitted",
           fmt::format("solid `{}` is met more than once; keep one", solid.name));
    }
    if (fitted == 1) continue;
    if (gas.empty()) {
      fail(at(place, {name_of(own.front())}).place, own_path,
           fmt::format("the interface has no partner; write {{kind: interface, solid: {}}} on a side of "
                       "fluid.boundary",
                       solid.name));
    }
    if (gas.size() > 1) {
      fail(at(root, {"fluid", "boundary", name_of(gas[1])}).place, "fluid.boundary",
           fmt::format("two sides meet solid `{}`; keep one", solid.name));
    }
    check_periods_meet(problem, solid, gas.front(), own.front(), place);
    check_sides_meet(problem, solid, gas.front(), own.front(),
                     at(root, {"fluid", "boundary", name_of(gas.front())}));
  }
}

/// Whether the reference describes the gas, or the solids.
bool describes(const ReferenceSpec& reference, bool gas) {
  if (reference.kind != "expressions" && reference.kind != "manufactured") return true;
  return gas ? reference.fluid.has_value() : reference.u.has_value();
}

/// A body that starts from the reference is described there.
void check_start(const ReferenceSpec& reference, bool gas, const std::string& owner, const Node& node) {
  if (describes(reference, gas)) return;
  fail(node.place, owner + ".initial",
       fmt::format("takes its data from `reference`, which has no `{}`; add it there, or give the state here",
                   gas ? "fluid" : "u"));
}

void check_reference(const Case& problem, const Node& root) {
  if (problem.reference.kind == "riemann" && !problem.solids.empty())
    fail(at(root, {"reference", "kind"}).place, "reference",
         "`riemann` is a solution for a gas alone; leave it out");
  if (!problem.reference.u) {
    for (const auto& [key, is_there] :
         {std::pair{"v", problem.reference.v.has_value()}, std::pair{"P", problem.reference.P.has_value()}}) {
      if (is_there)
        fail(at(root, {"reference", key}).place, fmt::format("reference.{}", key),
             "goes with `u`, which is missing");
    }
  }
  const auto need = [&](const BoundarySpec& spec, bool is_gas, const std::string& owner, Side side,
                        const Node& node) {
    if (!spec.from_reference) return;
    const std::string path = fmt::format("{}.boundary.{}", owner, name_of(side));
    if (problem.reference.kind == "piston_1d" || problem.reference.kind == "rotating_disk") {
      fail(node.place, path,
           fmt::format("reference `{}` is known at output times only; give the boundary data here",
                       problem.reference.kind));
    }
    if (!describes(problem.reference, is_gas))
      fail(node.place, path,
           fmt::format("takes its data from `reference`, which has no `{}`", is_gas ? "fluid" : "u"));
  };
  if (problem.fluid && problem.fluid->initial_from_reference)
    check_start(problem.reference, true, "fluid", at(root, {"fluid", "initial"}));
  for (const SolidSpec& solid : problem.solids) {
    if (solid.initial_from_reference)
      check_start(problem.reference, false, "solids." + solid.name,
                  at(root, {"solids", solid.name, "initial"}));
  }
  for (const Side side : all_sides) {
    const auto index = static_cast<std::size_t>(side);
    if (problem.fluid)
      need(problem.fluid->boundary[index], true, "fluid", side,
           at(root, {"fluid", "boundary", name_of(side)}));
    for (const SolidSpec& solid : problem.solids) {
      need(solid.boundary[index], false, "solids." + solid.name, side,
           at(root, {"solids", solid.name, "boundary", name_of(side)}));
    }
  }
}

/// Points where a solid meets the gas at t = 0.
std::vector<Vec2> meeting_points(const SolidSpec& solid) {
  std::vector<Vec2> points;
  if (!solid.body_fitted.empty()) {
    const CurveSpec& curve = solid.body_fitted.front().curve;
    const auto n = static_cast<std::size_t>(curve.points());
    for (std::size_t k = 0; k < n; ++k) points.emplace_back(curve.x[k], curve.x[n + k]);
  }
  for (const Side side : interface_sides(solid.boundary)) {
    for (int k = 0; k < points_along(solid.grid, side); ++k)
      points.push_back(side_point(solid.grid, side, k));
  }
  return points;
}

/// A chosen solution of gas and solid and a given path of the interface belong together.
void check_motion(const Case& problem, const Node& root) {
  const ReferenceSpec& reference = problem.reference;
  const bool chosen = reference.kind == "manufactured" && problem.fluid && !problem.solids.empty();
  if (!problem.interface.motion) {
    if (!chosen) return;
    fail(at(root, {"reference"}).place, "reference",
         "kind manufactured for gas and solid needs the path of the interface; write interface: {motion: "
         "[.., ..]}");
  }
  const Node& node = at(root, {"interface", "motion"});
  if (!chosen || !reference.fluid || !reference.u) {
    fail(node.place, "interface.motion",
         "goes with `reference: {kind: manufactured, fluid: .., u: ..}` only; leave it out: the solid moves "
         "it");
  }
  constexpr double tolerance = 1e-9;
  for (const SolidSpec& solid : problem.solids) {
    for (const Vec2& x : meeting_points(solid)) {
      const Vec2 start(problem.interface.motion->c1(x[0], x[1], 0),
                       problem.interface.motion->c2(x[0], x[1], 0));
      if ((start - x).norm() <= tolerance * (1 + x.norm())) continue;
      fail(node.place, "interface.motion",
           fmt::format("must be (x, y) at t = 0, but ({:.6g}, {:.6g}) goes to ({:.6g}, {:.6g})", x[0], x[1],
                       start[0], start[1]));
    }
  }
}

/// The scheme without added mass is not there where the gas's answer is part of the solid's motion.
void check_projection(const Case& problem, const Node& root) {
  if (problem.interface.projection != Projection::traditional || !problem.fluid) return;
  for (const SolidSpec& solid : problem.solids) {
    if (is_continuum(solid.law) || solid.law == external_law) continue;
    fail(at(root, {"interface", "projection"}).place, "interface.projection",
         fmt::format("traditional is not there for the {} `{}`, which is moved together with the gas's "
                     "answer to it; write simplified or full, which are the same for it",
                     solid.law == beam_law ? "beam" : "rigid solid", solid.name));
  }
  if (!problem.time.multirate || problem.solids.empty()) return;
  fail(
      at(root, {"time", "multirate"}).place, "time.multirate",
      "does not go with `interface.projection: traditional`, whose substeps would be closed with the solid's "
      "impedance; write false");
}

void check_probes(const Case& problem, const Node& root) {
  std::vector<std::string> places = solid_names(problem);
  if (problem.fluid) places.emplace_back("fluid");
  for (std::size_t k = 0; k < problem.output.probes.size(); ++k) {
    const ProbeSpec& probe = problem.output.probes[k];
    const Node& node = at(root, {"output", "probes"}).items[k];
    if (std::find(places.begin(), places.end(), probe.in) == places.end()) {
      fail(node.find("in")->place, fmt::format("output.probes[{}].in", k),
           fmt::format("{} is neither `fluid` nor a solid{}", in_ticks(probe.in),
                       did_you_mean(probe.in, places)));
    }
    const auto before = problem.output.probes.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::ranges::find(problem.output.probes.begin(), before, probe.name, &ProbeSpec::name) != before)
      fail(node.find("name")->place, fmt::format("output.probes[{}].name", k),
           fmt::format("there are two probes {}; choose another name", in_ticks(probe.name)));
  }
}

/// The grid of a solid is its reference configuration.
void check_solid_grid(const SolidSpec& solid, const Node& node) {
  const std::string path = fmt::format("solids.{}.grid", solid.name);
  for (const char* key : {"shake", "shake_seed"}) {
    if (const Node* own = node.find(key))
      fail(own->place, fmt::format("{}.{}", path, key), "the grid of a solid lies still; leave it out");
  }
  if (solid.grid.moving)
    fail(at(node, {"map"}).place, path + ".map",
         "must not depend on t: the grid of a solid is its reference configuration");
  check_grid(solid.grid, node, path);
}

}  // namespace

void check_case(const Case& problem, const Node& root) {
  if (!problem.fluid && problem.solids.empty()) {
    fail(root.place, "", "the case has neither `fluid` nor `solids`; write at least one");
  }
  if (!problem.fluid && problem.solids.size() > 1) {
    fail(at(root, {"solids"}).place, "solids",
         "several solids without a gas have nothing in common; write one case for each");
  }
  check_geometry(problem, root);
  check_laws(problem, root);
  if (problem.fluid) check_fluid(problem, root);
  for (std::size_t k = 0; k < problem.solids.size(); ++k) {
    const SolidSpec& solid = problem.solids[k];
    if (solid.name == "fluid" || solid.name == "coupler") {
      fail(at(root, {"solids"}).entries[k].place, "solids",
           fmt::format("`{}` is the name of another program; choose another", solid.name));
    }
    check_solid_grid(solid, at(root, {"solids", solid.name, "grid"}));
    if (!is_continuum(solid.law)) continue;  // need their outline only
    check_overlap({.background = solid.grid,
                   .body_fitted = solid.body_fitted,
                   .owner = at(root, {"solids", solid.name}),
                   .path = "solids." + solid.name});
  }
  check_reference(problem, root);
  check_interfaces(problem, root);
  check_held_ends(problem, root);
  check_motion(problem, root);
  check_projection(problem, root);
  check_probes(problem, root);
  check_probe_places(problem, root);
  check_expectations(problem, root);
}

}  // namespace fsi
