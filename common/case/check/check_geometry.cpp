#include "common/case/check/check_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "common/case/document/fluid_sections.hpp"
#include "common/case/grids/block.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/grids/no_grids_fit.hpp"
#include "common/case/grids/own_crossing.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/component_major.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/shapes/blunted.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// A curve of the case, and where the file describes it.
struct CheckedOutline {
  const CurveSpec& curve;
  std::string name;  ///< "solid `disk`"
  const Node& node;
  std::string path;
  Side side;              ///< of the grid fitted to it; bottom: the domain is to the left of the curve
  std::string grid = {};  ///< of the gas

  Vec2 point(std::size_t k) const { return vector_at(curve.x, k); }
  /// Is a position on the other side of the curve than the domain? Known of closed curves.
  bool behind(const Vec2& x) const {
    return curve.closed() && grid::encloses(curve.x, x) == (side == Side::top);
  }
};

CheckedOutline outline_of(const SolidSpec& solid, const Node& root) {
  return {.curve = solid.body_fitted.front().curve,
          .name = fmt::format("solid `{}`", solid.name),
          .node = *root.find("solids")->find(solid.name)->find("shape"),
          .path = fmt::format("solids.{}.shape", solid.name),
          .side = Side::bottom};
}

/// The curves that bound the gas within its rectangle.
std::vector<CheckedOutline> outlines_in_gas(const Case& problem, const FluidSpec& fluid, const Node& root) {
  std::vector<CheckedOutline> outlines;
  const std::vector<BodyFittedSpec>& grids = fluid.body_fitted;
  for (std::size_t k = 0; k < grids.size(); ++k) {
    const auto solid = std::ranges::find(problem.solids, grids[k].solid, &SolidSpec::name);
    if (solid != problem.solids.end() && !solid->body_fitted.empty()) {
      const CheckedOutline own = outline_of(*solid, root);
      outlines.push_back({grids[k].curve, own.name, own.node, own.path, grids[k].side, grids[k].name});
      continue;
    }
    const Node& node = fluid_section_of(root, fluid.name).find("body_fitted")->items[k];
    const Node* shape = node.find("shape");
    const std::string path = fmt::format("{}.body_fitted[{}]", fluid.path, k);
    outlines.push_back({.curve = grids[k].curve,
                        .name = grids[k].solid.empty() ? fmt::format("grid `{}`", grids[k].name)
                                                       : fmt::format("solid `{}`", grids[k].solid),
                        .node = shape != nullptr ? *shape : node,
                        .path = shape != nullptr ? path + ".shape" : path,
                        .side = grids[k].side,
                        .grid = grids[k].name});
  }
  return outlines;
}

/// A position for messages, its round-off taken away.
Vec2 rounded(const Vec2& x) {
  constexpr double unit = 1e-9;
  return (unit * (x / unit).array().round() + 0.0).matrix();  // + 0: no -0
}

/// How far a curve goes beyond one side of a rectangle.
struct Excess {
  double distance = 0;
  Side side = Side::left;
  Vec2 x = Vec2::Zero();
};

Excess largest_excess(const CheckedOutline& outline, const GridSpec& grid) {
  Excess worst;
  const auto n = static_cast<std::size_t>(outline.curve.points());
  for (const Side side : all_sides) {
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 x = outline.point(k);
      const double beyond = (x[direction_of(side)] - end_of(grid, side)) * (at_upper_end(side) ? 1 : -1);
      if (beyond > worst.distance) worst = {beyond, side, rounded(x)};
    }
  }
  return worst;
}

bool holds(const GridSpec& box, const Vec2& x) {
  return x[0] >= box.x_a && x[0] <= box.x_b && x[1] >= box.y_a && x[1] <= box.y_b;
}

/// The section that describes an outline: solids.NAME or that of the gas.
std::string owner_of(const CheckedOutline& outline) {
  return outline.path.substr(
      0, outline.path.rfind(outline.path.starts_with("solids.") ? ".shape" : ".body_fitted"));
}

bool is_upright(const GridSpec& grid) {
  return grid.kind == GridSpec::Kind::rectangle && grid.rotation == 0;
}

/// Round-off of points that stand on a wall.
double tolerance(const GridSpec& grid) {
  constexpr double part = 1e-6;  // of a cell
  return part * std::min((grid.x_b - grid.x_a) / grid.n1, (grid.y_b - grid.y_a) / grid.n2);
}

/// The corners of a polygon without a `radius`, whose rounding may take the outline where they are not.
std::vector<Vec2> corners_smoothed(const CheckedOutline& outline) {
  std::vector<Vec2> corners;
  const Node* list = outline.node.find("corners");
  if (list == nullptr || outline.node.find("radius") != nullptr) return corners;
  for (const Node& pair : list->items) corners.emplace_back(*pair.items[0].number, *pair.items[1].number);
  return corners;
}

void check_within_gas(const CheckedOutline& outline, const FluidSpec& fluid) {
  const GridSpec& gas = fluid.grid;
  const Excess excess = largest_excess(outline, gas);
  if (excess.distance <= tolerance(gas)) return;
  if (const std::vector<Vec2> corners = corners_smoothed(outline);
      !corners.empty() && std::ranges::all_of(corners, [&](const Vec2& x) { return holds(gas, x); })) {
    throw NoGridsFit(
        {.place = outline.node.place,
         .key = outline.path,
         .cause = fmt::format("its corners are rounded so far that the outline reaches ({:.6g}, {:.6g}), "
                              "{:.4g} beyond the {} side of {}.grid",
                              excess.x[0], excess.x[1], excess.distance, name_of(excess.side), fluid.path),
         .otherwise = "round them less with a `radius`",
         .owner = owner_of(outline)});
  }
  fail(outline.node.place, outline.path,
       fmt::format("the outline of {} reaches ({:.6g}, {:.6g}), {:.4g} beyond the {} side of {}.grid, {} = "
                   "{:.4g}; make it smaller, move it, or let the rectangle of {}.grid hold it",
                   outline.name, excess.x[0], excess.x[1], excess.distance, name_of(excess.side), fluid.path,
                   direction_of(excess.side) == 0 ? "x" : "y", end_of(gas, excess.side), fluid.path));
}

/// The ends of an open curve stand on the sides it names.
void check_ends(const CheckedOutline& outline, const FluidSpec& fluid) {
  const GridSpec& gas = fluid.grid;
  if (outline.curve.closed() || !outline.curve.on.empty()) return;
  const auto last = static_cast<std::size_t>(outline.curve.points()) - 1;
  for (const std::size_t end : {0U, 1U}) {
    const Side wall = (*outline.curve.walls)[end];
    const Vec2 x = outline.point(end == 0 ? 0 : last);
    const double distance = std::abs(x[direction_of(wall)] - end_of(gas, wall));
    if (distance <= tolerance(gas)) continue;
    fail(outline.node.place, outline.path,
         fmt::format(
             "an end of the outline of {}, ({:.6g}, {:.6g}), is {:.4g} from the {} side of {}.grid, {} = "
             "{:.4g}, on which `walls` has it stand; let it end there, or write the "
             "name of the grid along the wall on which it stands",
             outline.name, x[0], x[1], distance, name_of(wall), fluid.path,
             direction_of(wall) == 0 ? "x" : "y", end_of(gas, wall)));
  }
}

/// The outline's bounds, rounded outwards.
std::array<double, 2> bounds(const CheckedOutline& outline, int direction) {
  const std::vector<double>& x = outline.curve.x;
  const std::ptrdiff_t points = outline.curve.points();
  const auto first = x.begin() + direction * points;
  const auto [low, high] = std::minmax_element(first, first + points);
  const double unit = std::pow(10, std::floor(std::log10(*high - *low)) - 2);
  constexpr double round_off = 1e-6;
  return {std::floor(*low / unit + round_off) * unit, std::ceil(*high / unit - round_off) * unit};
}

void check_core(const SolidSpec& solid, const Node& root) {
  const CheckedOutline outline = outline_of(solid, root);
  const Excess excess = largest_excess(outline, solid.grid);
  const Node& grid = *root.find("solids")->find(solid.name)->find("grid");
  const Node* points = grid.find("points");
  const bool chosen = points != nullptr && !points->items.empty() && points->items.front().chosen;
  if (excess.distance <= tolerance(solid.grid) || chosen) return;  // the gas says where a chosen one ends
  const auto [x_a, x_b] = bounds(outline, 0);
  const auto [y_a, y_b] = bounds(outline, 1);
  fail(
      grid.place, fmt::format("solids.{}.grid", solid.name),
      fmt::format("this box does not hold the outline of the solid: `shape` reaches ({:.6g}, {:.6g}), {:.4g} "
                  "beyond its {} side; write at least x: [{:.10g}, {:.10g}], y: [{:.10g}, {:.10g}]",
                  excess.x[0], excess.x[1], excess.distance, name_of(excess.side), x_a, x_b, y_a, y_b));
}

/// How deep the points of a curve are behind another one, and where.
Excess deepest(const CheckedOutline& outline, const CheckedOutline& other) {
  Excess worst;
  const auto n = static_cast<std::size_t>(outline.curve.points());
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 x = outline.point(k);
    if (!other.behind(x)) continue;
    const double depth = grid::distance_to(other.curve.x, x);
    if (depth > worst.distance) worst = {.distance = depth, .x = rounded(x)};
  }
  return worst;
}

/// The points of a curve without its ends, which may stand on the other one.
std::vector<double> between_ends(const CheckedOutline& outline, const CheckedOutline& other) {
  std::vector<double> x = outline.curve.x;
  if (outline.curve.on.empty() || outline.curve.on != other.grid) return x;
  const auto n = static_cast<std::ptrdiff_t>(x.size() / 2);
  for (const std::ptrdiff_t end : {2 * n - 1, n, n - 1, std::ptrdiff_t{0}}) x.erase(x.begin() + end);
  return x;
}

void check_apart(const CheckedOutline& outline, const CheckedOutline& other) {
  const auto crossing = grid::crossing_of(between_ends(outline, other), between_ends(other, outline));
  const bool within = outline.behind(other.point(0)) || other.behind(outline.point(0));
  if (!crossing && !within) return;
  Excess overlap = deepest(outline, other);
  if (const Excess back = deepest(other, outline); back.distance > overlap.distance) overlap = back;
  if (overlap.distance == 0) {
    const Vec2 x = crossing ? crossing->x : outline.point(0);
    fail(outline.node.place, outline.path,
         fmt::format(
             "the outline of {} is on that of {} at ({:.6g}, {:.6g}); move them apart, by the depth of the "
             "grids of the gas around them",
             outline.name, other.name, x[0], x[1]));
  }
  fail(outline.node.place, outline.path,
       fmt::format("the outline of {} overlaps that of {} by {:.3g} at ({:.6g}, {:.6g}); move them apart, by "
                   "this and the depth of the grids of the gas around them",
                   outline.name, other.name, overlap.distance, overlap.x[0], overlap.x[1]));
}

/// ", as two of the 4 listed ones are cut off ..": a corner that is cut off is two.
std::string corners_cut_off(const CheckedOutline& outline) {
  const Node* listed = outline.node.find("corners");
  if (listed == nullptr || !outline.curve.closed()) return "";
  const std::size_t cut =
      outline.curve.corners.size() - std::min(outline.curve.corners.size(), listed->items.size());
  if (cut == 0) return "";
  constexpr double degree = std::numbers::pi / 180;
  return fmt::format(
      ", {} more than are listed: where an outline turns by more than {:.0f} degrees the corner is cut off, "
      "a face as "
      "wide as `blunt`, and counts twice",
      cut, grid::largest_fan / degree);
}

/// What keeps a body from having one grid from corner to corner.
std::string why_no_block(const CheckedOutline& outline) {
  const BlockCorners corners = block_corners(outline.curve);
  if (corners.at) return "";
  return fmt::format(" but in one with four straight sides: {}{}", corners.why_not, corners_cut_off(outline));
}

/// Grids fan around corners on the outside; on the inside their lines would meet.
void check_corners_inside(const CheckedOutline& outline) {
  if (outline.curve.corners.empty()) return;
  const Vec2 x = rounded(outline.point(static_cast<std::size_t>(outline.curve.corners.front())));
  NoGridsFit::Parts parts{
      .place = outline.node.place,
      .key = outline.path,
      .cause =
          fmt::format("the outline has a sharp corner at ({:.6g}, {:.6g}), around which no grid inside an "
                      "elastic body can be laid{}",
                      x[0], x[1], why_no_block(outline)),
      .otherwise = "round the outline there",
      .owner = owner_of(outline)};
  if (outline.node.find("corners") == nullptr)
    parts.choices = {{.words = "leave out `corner_angle`, which makes it smooth",
                      .left_out = {outline.path + ".corner_angle"}}};
  throw NoGridsFit(std::move(parts));
}

/// Between corners, values cannot be carried from the points of one side to those of another.
void check_same_points(const Case& problem, const FluidSpec& fluid, const Node& root) {
  for (std::size_t k = 0; k < fluid.body_fitted.size(); ++k) {
    const auto solid = std::ranges::find(problem.solids, fluid.body_fitted[k].solid, &SolidSpec::name);
    if (solid == problem.solids.end() || !is_block(*solid)) continue;
    const Node& node = fluid_section_of(root, fluid.name).find("body_fitted")->items[k];
    if (const Node* points = node.find("points"))
      fail(points->place, fmt::format("{}.body_fitted[{}].points", fluid.path, k),
           fmt::format("solid `{}` and the gas have the same points, from corner to corner; leave it out",
                       solid->name));
  }
}

/// The side of a block that stands on a wall is held.
void check_foot(const SolidSpec& solid, const Case& problem, const Node& root) {
  const std::optional<std::array<Side, 2>>& walls = solid.body_fitted.front().curve.walls;
  if (!is_block(solid) || !walls) return;
  const Side foot = walls->front();
  const BoundaryKind kind = solid.boundary[static_cast<std::size_t>(foot)].kind;
  const bool open = kind == BoundaryKind::none && problem.fluids.empty();
  if (!open && kind != BoundaryKind::periodic) return;
  const Node& node = *root.find("solids")->find(solid.name);
  const Node* boundary = node.find("boundary");
  fail(boundary != nullptr ? boundary->place : node.place, fmt::format("solids.{}.boundary", solid.name),
       fmt::format(
           "the body stands on its {0} side, which needs a condition of its own; write `{0}: clamped` or "
           "`{0}: slip_wall`",
           name_of(foot)));
}

/// The gas has the points of a block's sides, and its lines lean at corners towards the side whose points are farther
/// apart: with cells 4.6 times as long as wide a bar's folded at the first touch of a shock, with 3.1 they held.
void check_cells_at_corners(const SolidSpec& solid, const Case& problem, const Node& root) {
  if (!is_block(solid) || problem.fluids.empty()) return;
  constexpr double longest = 3;
  const auto& at = solid.grid.corners;
  const double along = ((at[1] - at[0]).norm() + (at[2] - at[3]).norm()) / (2 * (solid.grid.n1 - 1));
  const double across = ((at[3] - at[0]).norm() + (at[2] - at[1]).norm()) / (2 * (solid.grid.n2 - 1));
  if (std::max(along, across) <= longest * std::min(along, across)) return;
  const Node& node = *root.find("solids")->find(solid.name);
  const Node* grid = node.find("grid");
  fail(grid != nullptr ? grid->place : node.place, fmt::format("solids.{}.grid", solid.name),
       fmt::format(
           "cells {:.3g} x {:.3g}: at sharp corners beside a gas they may be {:g} times as long as wide at "
           "most; write `points` for more alike ones, or leave out `grid`, which is then chosen",
           along, across, longest));
}

/// Sharp corners of a body that hardly changes its volume: a stretch of areas that differences at a corner are wrong
/// by is a tension of lambda times as much there. Free blocks ran at lambda / mu = 199 and broke at 499, on every
/// grid (docs/theory_grids.md, "Corners").
void check_volume_changes_at_corners(const SolidSpec& solid, const Node& root) {
  constexpr double most = 200;
  if (!is_block(solid) || solid.lambda <= most * solid.mu) return;
  const Node& node = *root.find("solids")->find(solid.name);
  const Node* shape = node.find("shape");
  const CheckedOutline outline = outline_of(solid, root);
  double shortest = std::numeric_limits<double>::infinity();  // of the sides between corners
  for (std::size_t k = 1; k < outline.curve.corners.size(); ++k) {
    const auto at = [&](std::size_t c) {
      return outline.point(static_cast<std::size_t>(outline.curve.corners[c]));
    };
    shortest = std::min(shortest, (at(k) - at(k - 1)).norm());
  }
  fail(shape != nullptr ? shape->place : node.place, fmt::format("solids.{}.shape", solid.name),
       fmt::format(
           "with sharp corners a body must change its volume more easily than with lambda / mu = {:.4g} "
           "({:g} at most, a Poisson's ratio of 0.4975); write `radius: {:.2g}`, or another material",
           solid.lambda / solid.mu, most, 0.25 * shortest));
}

}  // namespace

void check_geometry(const Case& problem, const Node& root) {
  for (const SolidSpec& solid : problem.solids) {
    if (solid.body_fitted.empty()) continue;
    refuse_own_crossing(solid.body_fitted.front().curve,
                        *root.find("solids")->find(solid.name)->find("shape"),
                        fmt::format("solids.{}.shape", solid.name));
    const bool has_core = is_continuum(solid.law) && !is_block(solid);
    check_foot(solid, problem, root);
    check_volume_changes_at_corners(solid, root);
    check_cells_at_corners(solid, problem, root);
    if (has_core) check_corners_inside(outline_of(solid, root));
    if (has_core && is_upright(solid.grid)) check_core(solid, root);
  }
  for (const FluidSpec& fluid : problem.fluids) {
    check_same_points(problem, fluid, root);
    const std::vector<CheckedOutline> outlines = outlines_in_gas(problem, fluid, root);
    for (const CheckedOutline& outline : outlines) {
      refuse_own_crossing(outline.curve, outline.node, outline.path);
      if (!is_upright(fluid.grid)) continue;
      check_within_gas(outline, fluid);
      check_ends(outline, fluid);
    }
    for (std::size_t k = 1; k < outlines.size(); ++k) {
      for (std::size_t l = 0; l < k; ++l) check_apart(outlines[k], outlines[l]);
    }
  }
}

}  // namespace fsi
