#include "common/case/check/check_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/case/check/given/sample.hpp"
#include "common/case/document/node_at.hpp"
#include "common/case/grids/curve_side.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/case/schema/laws.hpp"
#include "common/grid/geometry/outline.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// The points of a curve, component-major.
std::vector<double> curve_through(const std::vector<Vec2>& points) {
  std::vector<double> x;
  for (const Vec2& point : points) x.push_back(point[0]);
  for (const Vec2& point : points) x.push_back(point[1]);
  return x;
}

/// All points of the rim of a grid at t = 0, the first one again at the end.
std::vector<double> rim_of(const GridSpec& grid) {
  std::vector<Vec2> points;
  const auto append = [&](Side side, bool backwards) {
    const int n = points_along(grid, side);
    for (int k = 0; k < n; ++k) points.push_back(side_point(grid, side, backwards ? n - 1 - k : k));
  };
  append(Side::bottom, false);
  append(Side::right, false);
  append(Side::top, true);
  append(Side::left, true);
  return curve_through(points);
}

/// Is x on this curve, up to round-off?
bool is_on(const std::vector<double>& curve, const Vec2& x) {
  constexpr double round_off = 1e-9;  // of the largest coordinate
  double largest = 0;
  for (const double coordinate : curve) largest = std::max(largest, std::fabs(coordinate));
  return grid::distance_to(curve, x) <= round_off * largest;
}

bool within(const std::vector<double>& rim, const Vec2& x) {
  return grid::encloses(rim, x) || is_on(rim, x);
}

bool within_rim(const GridSpec& grid, const Vec2& x) {
  return within(rim_of(grid), x);
}

void check_probe_in_gas(const FluidSpec& fluid, const Vec2& x, const Node& node, const std::string& path) {
  const std::string remedy = "; it would have no value there: move it into the gas";
  if (!within_rim(fluid.grid, x)) {
    fail(node.place, path,
         fmt::format("({:.6g}, {:.6g}) lies outside {}.grid at t = 0{}", x[0], x[1], fluid.path, remedy));
  }
  for (const BodyFittedSpec& spec : fluid.body_fitted) {
    if (!lies_behind(spec, fluid.grid, x)) continue;
    const std::string body = spec.solid.empty() ? fmt::format("behind the wall of grid `{}`", spec.name)
                                                : fmt::format("in solid `{}`", spec.solid);
    const std::string other = spec.solid.empty() ? "" : fmt::format(", or write `in: {}`", spec.solid);
    fail(node.place, path,
         fmt::format("({:.6g}, {:.6g}) lies {} at t = 0{}{}", x[0], x[1], body, remedy, other));
  }
}

bool is_in_continuum(const SolidSpec& solid, const Vec2& x) {
  const auto is_behind = [&](const BodyFittedSpec& spec) { return lies_behind(spec, solid.grid, x); };
  return within_rim(solid.grid, x) && std::ranges::none_of(fitted_grids(solid), is_behind);
}

/// A beam has its outline alone, closed by the wall on which it stands; rounded corners may leave the end of its line
/// outside.
bool is_in_beam(const SolidSpec& solid, const Vec2& x) {
  if (solid.beam && is_on(curve_through(solid.beam->line), x)) return true;
  if (fitted_grids(solid).empty()) return within_rim(solid.grid, x);
  const BodyFittedSpec& outline = solid.body_fitted.front();
  const CurveSpec& curve = outline.curve;
  if (curve.walls && curve.walls->front() != curve.walls->back()) return !lies_behind(outline, solid.grid, x);
  std::vector<Vec2> rim = outline_points(curve);
  rim.push_back(rim.front());
  return within(curve_through(rim), x);
}

void check_probe_in_solid(const SolidSpec& solid, const Vec2& x, const Node& node, const std::string& path) {
  if (solid.law == rigid_law || solid.law == external_law)
    return;  // the motion of the one is known everywhere
  if (solid.law == beam_law ? is_in_beam(solid, x) : is_in_continuum(solid, x)) return;
  fail(node.place, path,
       fmt::format(
           "({:.6g}, {:.6g}) lies outside solid `{}` in its reference configuration; move it into the "
           "body{}",
           x[0], x[1], solid.name,
           solid.body_fitted.empty() ? "" : ", within its `shape` as the points of the outline draw it"));
}

void check_rigid_side(const BoundarySpec& spec, bool fixed, const Node& node, const std::string& path) {
  if (schema::solid_boundary(spec.kind).holds == Hold::motion) {
    fail(node.place, path,
         fmt::format(
             "a rigid solid cannot have its motion given (or be clamped) at a side: {}; write free, or "
             "take a law that deforms",
             fixed ? "`motion: fixed` holds all of it"
                   : "it moves as a whole, as its section `motion` says, or not at all with "
                     "`motion: fixed`"));
  }
  if (carries_load(spec)) {
    fail(node.place, path,
         "a rigid solid cannot carry a load on a side of its own; write free, and the load as body_force");
  }
}

/// Neither a rigid body nor a beam.
void check_initial(const SolidSpec& solid, const Node& node) {
  if (solid.fixed && solid.initial_v)
    fail(node.find("initial")->place, fmt::format("solids.{}.initial.v", solid.name),
         "the body is fixed (`motion: fixed`) and has no velocity; leave one of them out");
  if (!solid.initial_from_reference && !solid.initial_u) return;
  fail(node.find("initial")->place, fmt::format("solids.{}.initial", solid.name),
       fmt::format("a {} may begin with `v`, and nothing else; leave the rest out",
                   solid.law == beam_law ? "beam" : "rigid solid"));
}

/// Whether all points of a side lie on the line through its ends.
bool is_straight(const GridSpec& grid, Side side) {
  constexpr double round_off = 1e-8;  // of its length
  const int last = points_along(grid, side) - 1;
  const Vec2 first = side_point(grid, side, 0), chord = side_point(grid, side, last) - first;
  for (int k = 1; k < last; ++k) {
    if (!(std::abs(cross(chord, side_point(grid, side, k) - first)) <= round_off * chord.squaredNorm()))
      return false;
  }
  return true;
}

/// Where a side lets a rigid body go: a straight way that is the same for all of them.
void check_ways(const SolidSpec& solid, const Node& boundary, const std::string& path) {
  constexpr double parallel = 1e-8;
  std::optional<Vec2> way;
  for (const Side side : sides_of_body(solid)) {
    const BoundarySpec& spec = solid.boundary[static_cast<std::size_t>(side)];
    if (solid.fixed || schema::solid_boundary(spec.kind).holds != Hold::normal) continue;
    const auto refuse = [&](const char* why) {
      fail(boundary.find(name_of(side))->place, fmt::format("{}.{}", path, name_of(side)), why);
    };
    if (!is_straight(solid.grid, side))
      refuse(
          "the body slides along a wall that is not straight, so that it cannot move; write `motion: fixed`, "
          "or free");
    const Vec2 along =
        (side_point(solid.grid, side, points_along(solid.grid, side) - 1) - side_point(solid.grid, side, 0))
            .normalized();
    if (way && std::abs(cross(*way, along)) > parallel)
      refuse(
          "this side and another one let the body slide along different walls, so that it cannot move; write "
          "`motion: fixed`, or free for one of them");
    way = along;
  }
}

bool slides(const SolidSpec& solid) {
  const auto holds_normal = [](const BoundarySpec& spec) {
    return schema::solid_boundary(spec.kind).holds == Hold::normal;
  };
  const auto of_body = [&](Side side) {
    return holds_normal(solid.boundary[static_cast<std::size_t>(side)]);
  };
  return solid.body_fitted.empty() ? std::ranges::any_of(sides_of_body(solid), of_body)
                                   : std::ranges::any_of(solid.body_fitted.front().boundary, holds_normal);
}

/// Directions along the walls that a body slides along.
std::vector<Vec2> ways_of(const SolidSpec& solid) {
  std::vector<Vec2> ways;
  const auto add = [&](const BoundarySpec& spec, const Vec2& along) {
    if (schema::solid_boundary(spec.kind).holds == Hold::normal) ways.push_back(along.normalized());
  };
  if (solid.body_fitted.empty()) {
    for (const Side side : sides_of_body(solid))
      add(solid.boundary[static_cast<std::size_t>(side)],
          side_point(solid.grid, side, points_along(solid.grid, side) - 1) - side_point(solid.grid, side, 0));
    return ways;
  }
  const BodyFittedSpec& fitted = solid.body_fitted.front();
  if (!fitted.curve.walls) return ways;
  for (const Side end : {Side::left, Side::right}) {
    const std::size_t k = at_upper_end(end) ? 1 : 0;
    const Vec2 along = direction_of((*fitted.curve.walls)[k]) == 0 ? Vec2(0, 1) : Vec2(1, 0);
    add(fitted.boundary[static_cast<std::size_t>(end)],
        fitted.curve.on.empty() ? along : fitted.curve.along[k]);
  }
  return ways;
}

/// A body between walls goes as it is told along them, and nowhere else.
void check_given_ways(const SolidSpec& solid, const Node& motion) {
  constexpr double parallel = 1e-8;
  for (const config::Entry& entry : motion.entries) {
    const Vec2 told = entry.key == "x" ? Vec2(1, 0) : Vec2(0, 1);
    for (const Vec2& way : ways_of(solid)) {
      if (entry.key != "rotation" && std::abs(cross(way, told)) <= parallel) continue;
      fail(entry.place, fmt::format("solids.{}.motion.{}", solid.name, entry.key),
           fmt::format("the body slides along a wall in the direction ({:.4g}, {:.4g}), which leaves it the "
                       "motion along the wall alone; leave `{}` out",
                       way.x(), way.y(), entry.key));
    }
  }
}

/// A wall leaves the motion along it alone.
void check_mounting(const SolidSpec& solid, const Node& node) {
  if (!slides(solid)) return;
  if (solid.mounting.moves_as_given()) check_given_ways(solid, *node.find("motion"));
  const auto refuse = [&](const Node& within, const std::string& path, const char* key) {
    const Node* given = within.find(key);
    if (given == nullptr) return;
    fail(given->place, fmt::format("{}.{}", path, key),
         fmt::format(
             "the body slides along a wall, which leaves it the motion along the wall alone; leave `{}` out",
             key));
  };
  const std::string path = "solids." + solid.name;
  for (const char* key : {"degrees_of_freedom", "pivot"}) refuse(node, path, key);
  for (const char* key : {"spring", "damper"}) {
    if (const Node* section = node.find(key)) refuse(*section, fmt::format("{}.{}", path, key), "rotation");
  }
}

void check_rigid(const SolidSpec& solid, const Node& node) {
  check_mounting(solid, node);
  const std::string path = fmt::format("solids.{}.boundary", solid.name);
  const Node* boundary = node.find("boundary");
  if (boundary == nullptr) return;
  for (const Side side : sides_of_body(solid))
    check_rigid_side(solid.boundary[static_cast<std::size_t>(side)], solid.fixed,
                     *boundary->find(name_of(side)), fmt::format("{}.{}", path, name_of(side)));
  check_ways(solid, *boundary, path);
}

/// What moves as sections or as a whole takes nothing at the points of its outline but a gas.
void check_free_outline(const Case& problem, const SolidSpec& solid, const Node& node) {
  if (!problem.fluids.empty() || solid.body_fitted.empty()) return;  // with a gas it must be an interface
  const BodyFittedSpec& outline = solid.body_fitted.front();
  const BoundarySpec& spec = outline.boundary[static_cast<std::size_t>(outline.side)];
  const Hold holds = schema::solid_boundary(spec.kind).holds;
  if (holds == Hold::others || (holds == Hold::nothing && !carries_load(spec))) return;
  fail(node_at(node, {"body_fitted", "boundary"}).place,
       fmt::format("solids.{}.body_fitted.boundary", solid.name),
       fmt::format("a {} takes no load, no motion and no wall at its outline: write free, and the load as "
                   "`body_force`",
                   solid.law == beam_law ? "beam" : "rigid solid"));
}

/// A rigid body has no waves that would limit a step: under a force of its own, or of what holds it, it would go from output to
/// output in one.
void check_step(const Case& problem, const SolidSpec& solid, const Node& root) {
  if (!problem.fluids.empty() || problem.time.dt || !solid.is_driven()) return;
  fail(
      root.find("time")->place, "time",
      fmt::format(
          "the rigid solid `{}` without a gas has no largest step of its own, with which to follow {}; write "
          "`dt` [time]",
          solid.name, solid.body_force ? "its `body_force`" : "what holds it"));
}

}  // namespace

void check_probe_places(const Case& problem, const Node& root) {
  for (std::size_t k = 0; k < problem.output.probes.size(); ++k) {
    const ProbeSpec& probe = problem.output.probes[k];
    const Node& node = *root.find("output")->find("probes")->items[k].find("x");
    const std::string path = fmt::format("output.probes[{}]", k);
    const Vec2 x(probe.x, probe.y);
    if (const FluidSpec* fluid = fluid_named(problem, probe.in)) {
      check_probe_in_gas(*fluid, x, node, path);
    } else {
      check_probe_in_solid(*std::ranges::find(problem.solids, probe.in, &SolidSpec::name), x, node, path);
    }
  }
}

void check_laws(const Case& problem, const Node& root) {
  for (const SolidSpec& solid : problem.solids) {
    const Node& node = *root.find("solids")->find(solid.name);
    if (solid.law == rigid_law || solid.law == beam_law) {
      check_initial(solid, node);
      check_free_outline(problem, solid, node);
    }
    if (solid.law == rigid_law) {
      check_rigid(solid, node);
      check_step(problem, solid, root);
    }
    if (!problem.reference.computed() || is_continuum(solid.law)) continue;
    fail(node.find("law")->place, fmt::format("solids.{}.law", solid.name),
         fmt::format(
             "reference `{}` is computed with a law of deformation, not with `{}`; write another law, or "
             "reference.kind: none, and leave out the errors in `expect`",
             name_of(problem.reference.kind), solid.law));
  }
}

}  // namespace fsi
