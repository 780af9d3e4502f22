#include "common/case/check/check_beam.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/case/check/check_ends.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/choices.hpp"
#include "common/grid/geometry/outline.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// Places along the line at which its thickness is looked at.
constexpr int stations = 64;

/// On the polygon through the points of the line; part 0 .. 1 of them.
Vec2 on_line(const BeamSpec& beam, double part) {
  const double s = part * static_cast<double>(beam.line.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(s), beam.line.size() - 2);
  return beam.line[k] + (s - static_cast<double>(k)) * (beam.line[k + 1] - beam.line[k]);
}

/// The largest one.
double check_thickness(const SolidSpec& solid, const Node& beam) {
  if (solid.beam->thickness.uses("t"))
    fail(beam.find("thickness")->place, fmt::format("solids.{}.beam.thickness", solid.name),
         "must not depend on t: a beam keeps its thickness");
  double largest = 0;
  for (int k = 0; k < stations; ++k) {
    const Vec2 x = on_line(*solid.beam, (k + 0.5) / stations);
    const double d = solid.beam->thickness(x.x(), x.y(), 0);
    largest = std::max(largest, d);
    if (d > 0 && std::isfinite(d)) continue;
    fail(beam.find("thickness")->place, fmt::format("solids.{}.beam.thickness", solid.name),
         fmt::format("is {:.4g} at ({:.6g}, {:.6g}); let it be positive along the line [length]", d, x.x(),
                     x.y()));
  }
  return largest;
}

/// Is a given displacement none, as of what is clamped?
bool stays(const VectorExpressions& u) {
  const auto none = [](const Expression& f) {
    return !f.uses("x") && !f.uses("y") && !f.uses("r") && !f.uses("t") && f(0, 0, 0) == 0;
  };
  return none(u.c1) && none(u.c2);
}

/// The distance of a place from a side of a grid.
double distance_from_side(const GridSpec& grid, Side side, const Vec2& x) {
  constexpr int samples = 64;
  return grid::distance_to(points_on_side(grid, side, samples + 1), x);
}

/// The ends of the line that are nearer to this side than to any other.
std::vector<std::size_t> ends_at(const SolidSpec& solid, Side side) {
  std::vector<std::size_t> ends;
  for (const std::size_t end : {0U, 1U}) {
    const Vec2& x = end == 0 ? solid.beam->line.front() : solid.beam->line.back();
    const double own = distance_from_side(solid.grid, side, x);
    const auto is_nearer = [&](Side other) { return distance_from_side(solid.grid, other, x) < 0.999 * own; };
    if (std::ranges::none_of(all_sides, is_nearer)) ends.push_back(end);
  }
  return ends;
}

/// A side that is clamped says so of the ends of the line that are there.
void check_held_side(const SolidSpec& solid, Side side, const Node& node) {
  const BoundarySpec& spec = solid.boundary[static_cast<std::size_t>(side)];
  if (spec.kind == BoundaryKind::none || schema::solid_boundary(spec.kind).holds != Hold::motion) return;
  const std::string path = fmt::format("solids.{}.boundary.{}", solid.name, name_of(side));
  const std::vector<std::size_t> ends = ends_at(solid, side);
  if (ends.empty())
    fail(node.place, path, "clamps nothing: no end of the beam's line is at this side; write free here");
  const auto is_free = [&](std::size_t end) { return solid.beam->ends[end] == BeamEnd::free; };
  if (!std::ranges::all_of(ends, is_free)) return;
  fail(node.place, path,
       fmt::format(
           "clamps nothing: the {} end of the beam there is free; write `beam: {{ends: [{}]}}`, or free here",
           ends.front() == 1 ? "last" : "first", ends.front() == 1 ? ".., clamped" : "clamped, .."));
}

/// A wall keeps an end of a beam on it where the gas ends at that wall too (solid_solver/beam/skin.cpp): beside an
/// interface.
void check_wall(const SolidSpec& solid, Side side, const Node& node) {
  const BoundarySpec& spec = solid.boundary[static_cast<std::size_t>(side)];
  if (spec.kind == BoundaryKind::none || schema::solid_boundary(spec.kind).holds != Hold::normal) return;
  const auto meets_gas = [&](Side beside) {
    return solid.boundary[static_cast<std::size_t>(beside)].kind == BoundaryKind::interface;
  };
  if (!solid.body_fitted.empty() || std::ranges::any_of(sides_beside(side), meets_gas)) return;
  fail(node.place, fmt::format("solids.{}.boundary.{}", solid.name, name_of(side)),
       "holds nothing of a beam: no gas ends at this side; write free, and what holds the beam as "
       "`beam: {ends: [.., ..]}`");
}

/// A beam is held at its ends and loaded by gases and its body force: what else a side of its grid says would be
/// ignored.
void check_side(const SolidSpec& solid, Side side, const Node& node) {
  const BoundarySpec& spec = solid.boundary[static_cast<std::size_t>(side)];
  if (spec.kind == BoundaryKind::none) return;
  const bool held = schema::solid_boundary(spec.kind).holds == Hold::motion;
  const bool loaded = carries_load(spec),
             moved = held && (spec.from_reference || (spec.vector && !stays(*spec.vector)));
  if (!loaded && !moved) return;
  fail(
      node.place, fmt::format("solids.{}.boundary.{}", solid.name, name_of(side)),
      fmt::format("a beam cannot have its {} given at a side: {}; write free here, or take a law with a grid",
                  loaded ? "traction" : "motion",
                  loaded ? "gases and `body_force` load it" : "`beam: {ends: [..]}` says what holds it"));
}

/// Of the outline, or of the grid.
Eigen::AlignedBox2d box_of(const SolidSpec& solid) {
  Eigen::AlignedBox2d box;
  if (!solid.body_fitted.empty()) {
    const std::vector<double>& x = solid.body_fitted.front().curve.x;
    for (std::size_t k = 0; k < x.size() / 2; ++k) box.extend(Vec2(x[k], x[x.size() / 2 + k]));
    return box;
  }
  constexpr int along = 32;
  for (int k = 0; k <= along; ++k) {
    const double part = static_cast<double>(k) / along;
    for (const double end : {0.0, 1.0}) {
      box.extend(place(solid.grid, part, end, 0));
      box.extend(place(solid.grid, end, part, 0));
    }
  }
  return box;
}

void check_line(const SolidSpec& solid, const Node& beam, double thickness) {
  const Eigen::AlignedBox2d box = box_of(solid);
  for (const Vec2& x : solid.beam->line) {
    if (box.exteriorDistance(x) <= thickness) continue;
    fail(beam.find("line")->place, fmt::format("solids.{}.beam.line", solid.name),
         fmt::format("({:.6g}, {:.6g}) is not in the body, which lies in ({:.6g}, {:.6g}) .. ({:.6g}, "
                     "{:.6g}); the line "
                     "goes along the middle of the body",
                     x.x(), x.y(), box.min().x(), box.min().y(), box.max().x(), box.max().y()));
  }
}

/// Where both feet of the outline are the two sides of one section, an end of the line stands between them: the
/// section that holds the outline on the wall is that of the end.
void check_between_feet(const SolidSpec& solid, const Node& beam, double thickness) {
  const CurveSpec& curve = solid.body_fitted.front().curve;
  const std::size_t n = curve.x.size() / 2;
  const Vec2 foot(curve.x[0], curve.x[n]), other(curve.x[n - 1], curve.x[2 * n - 1]);
  constexpr double one_section = 4;  // thicknesses; the feet of an arch are farther apart
  if ((other - foot).norm() > one_section * thickness) return;
  const Vec2 middle = 0.5 * (foot + other);
  const bool last = (solid.beam->line.back() - middle).norm() < (solid.beam->line.front() - middle).norm();
  const Vec2& x = last ? solid.beam->line.back() : solid.beam->line.front();
  if ((x - middle).norm() <= thickness) return;
  fail(beam.find("line")->place, fmt::format("solids.{}.beam.line", solid.name),
       fmt::format("its {} end ({:.6g}, {:.6g}) is {:.3g} away from the foot of the outline, more than the "
                   "thickness, {:.3g}; let that end be ({:.6g}, {:.6g}), in the middle of the foot",
                   last ? "last" : "first", x.x(), x.y(), (x - middle).norm(), thickness, middle.x(),
                   middle.y()));
}

/// The end of the line that is nearest to an end of the outline.
void check_foot(const SolidSpec& solid, const Node& beam, std::size_t end) {
  const CurveSpec& curve = solid.body_fitted.front().curve;
  const std::size_t n = curve.x.size() / 2, k = end == 0 ? 0 : n - 1;
  const Vec2 x(curve.x[k], curve.x[n + k]);
  const bool last = (solid.beam->line.back() - x).norm() < (solid.beam->line.front() - x).norm();
  const BeamEnd kind = solid.beam->ends[last ? 1 : 0];
  if (kind == BeamEnd::clamped || kind == BeamEnd::guided) return;
  const Node* ends = beam.find("ends");
  fail(ends != nullptr ? ends->place : beam.place, fmt::format("solids.{}.beam.ends", solid.name),
       fmt::format(
           "the outline ends at ({:.6g}, {:.6g}) on a wall, and the {} end of the line there is {}: the "
           "section "
           "would {} and leave the wall, and the grid of the gas with it; write clamped, or guided (it moves "
           "across the line)",
           x.x(), x.y(), last ? "last" : "first", name_of(kind), kind == BeamEnd::free ? "move" : "turn"));
}

/// Where a side of the grid meets the gas, and this ends at a wall: that end stays on the wall by itself, or slides
/// along it.
void check_corner(const SolidSpec& solid, const FluidSpec& fluid, Side side, std::size_t end,
                  const Node& node) {
  const Side beside = sides_beside(side)[end];
  if (is_wall(solid.boundary[static_cast<std::size_t>(beside)])) return;
  const Vec2 x = side_point(solid.grid, side, end == 0 ? 0 : points_along(solid.grid, side) - 1);
  const std::vector<Vec2>& line = solid.beam->line;
  const bool last = (line.back() - x).norm() < (line.front() - x).norm();
  const BeamEnd kind = solid.beam->ends[last ? 1 : 0];
  if (kind == BeamEnd::clamped || kind == BeamEnd::guided) return;
  const std::string wall = wall_at(fluid, solid, x);
  if (wall.empty()) return;
  fail(node.find("boundary")->find(name_of(beside))->place,
       fmt::format("solids.{}.boundary.{}", solid.name, name_of(beside)),
       fmt::format(
           "the {} end of the beam is {} and stands at ({:.6g}, {:.6g}) on {}: its section would {} and "
           "leave the wall, and the grid of the gas with it; write `{}: slip_wall` (it slides along the "
           "wall), or let that end be clamped or guided",
           last ? "last" : "first", name_of(kind), x.x(), x.y(), wall,
           kind == BeamEnd::free ? "move" : "turn", name_of(beside)));
}

void check_beam_in_gases(const Case& problem, const SolidSpec& solid, const Node& node, double thickness) {
  const Node& beam = *node.find("beam");
  for (const FluidSpec& fluid : problem.fluids) {
    const std::optional<Side> side = solid.beam->closed ? std::nullopt : side_to(solid, fluid.name);
    if (!side) continue;
    for (const std::size_t end : {0U, 1U}) check_corner(solid, fluid, *side, end, node);
  }
  if (solid.body_fitted.empty() || solid.body_fitted.front().curve.closed() || solid.beam->closed) return;
  check_between_feet(solid, beam, thickness);
  for (const std::size_t end : {0U, 1U}) check_foot(solid, beam, end);
}

}  // namespace

void check_beams(const Case& problem, const Node& root) {
  for (const SolidSpec& solid : problem.solids) {
    if (solid.law != beam_law || !solid.beam) continue;
    const Node& node = *root.find("solids")->find(solid.name);
    const double thickness = check_thickness(solid, *node.find("beam"));
    const auto each_side = [&](const auto& check) {
      const Node* sides = node.find("boundary");
      for (const Side side : all_sides)
        if (const Node* own = sides == nullptr ? nullptr : sides->find(name_of(side)))
          check(solid, side, *own);
    };
    each_side(check_side);
    each_side(check_wall);
    check_line(solid, *node.find("beam"), thickness);
    if (problem.fluids.empty() && !problem.time.dt) {
      fail(root.find("time")->place, "time",
           "a beam without a gas has no largest step of its own; write `dt` [time]");
    }
    check_beam_in_gases(problem, solid, node, thickness);
    each_side(check_held_side);
  }
}

}  // namespace fsi
