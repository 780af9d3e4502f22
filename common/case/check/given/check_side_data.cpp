#include "common/case/check/given/check_side_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// A side of a gas or a solid, or a curve, with the place where the case speaks of it.
struct GivenSide {
  const BoundarySpec& spec;
  const Node& node;
  std::string path;

  /// Of a key of its section, or its own where a word says it all.
  const Node& node_of(const std::string& key) const { return node_at(node, {key}); }
  std::string path_of(const std::string& key) const {
    return node.find(key) == nullptr ? path : fmt::format("{}.{}", path, key);
  }
};

/// A point of a side of a solid, its neighbour inside, and the direction of the side there.
struct SidePoint {
  Vec2 x, inner, along;
};

GivenSide given_side(Side side, const BoundarySpec& spec, const Node& boundary, const std::string& path) {
  return {.spec = spec,
          .node = node_at(boundary, {name_of(side)}),
          .path = fmt::format("{}.{}", path, name_of(side))};
}

[[noreturn]] void fail_at_side(const GivenSide& side, const std::string& key, const std::string& values,
                               const Vec2& x, double t) {
  fail(side.node_of(key).place, side.path_of(key),
       fmt::format("is {} at ({:.6g}, {:.6g}), t = {:.4g}; must be finite", values, x[0], x[1], t));
}

void check_values(const GivenSide& side, const Vec2& x, double t) {
  const auto check = [&](const std::string& key, const VectorExpressions& given) {
    const double c1 = given.c1(x[0], x[1], t), c2 = given.c2(x[0], x[1], t);
    if (!std::isfinite(c1) || !std::isfinite(c2))
      fail_at_side(side, key, fmt::format("({}, {})", c1, c2), x, t);
  };
  const BoundarySpec& spec = side.spec;
  if (spec.vector) check("value", *spec.vector);
  if (spec.velocity) check("velocity", *spec.velocity);
  for (const auto& [key, given] : spec.vectors) check(key, given);
  for (const auto& [key, given] : spec.fields) {
    const double value = given(x[0], x[1], t);
    if (!std::isfinite(value)) fail_at_side(side, key, fmt::to_string(value), x, t);
  }
}

/// Do the displacement and the velocity that a side is given belong together anywhere, where it moves? Formulas may have
/// bends at which differences are not their rate.
void check_rate(const Case& problem, const GivenSide& side, const std::vector<SidePoint>& points) {
  if (!side.spec.vector || !side.spec.velocity) return;
  constexpr double tolerance = 0.2, short_time = 1e-6;
  const GivenVector u = given_by(*side.spec.vector), v = given_by(*side.spec.velocity);
  const double dt = short_time * problem.time.end;
  std::string apart;
  Vec2 where;
  double when = 0;
  for (int k = 1; k + 1 < looked_at_times; ++k) {
    const double t = looked_at_time(problem, k);
    for (const SidePoint& point : points) {
      const Vec2 rate = (u(point.x, t + dt) - u(point.x, t - dt)) / (2 * dt), given = v(point.x, t);
      const double speed = std::max(rate.norm(), given.norm());
      if (speed == 0) continue;
      if ((rate - given).norm() <= tolerance * speed) return;
      if (!apart.empty()) continue;
      apart = fmt::format("({:.3g}, {:.3g}), but `value` moves there with ({:.3g}, {:.3g})", given[0],
                          given[1], rate[0], rate[1]);
      where = point.x;
      when = t;
    }
  }
  if (apart.empty()) return;
  fail(side.node_of("velocity").place, side.path_of("velocity"),
       fmt::format("is {} (at ({:.6g}, {:.6g}), t = {:.4g}); leave it out, and it is the rate of `value`",
                   apart, where[0], where[1], when));
}

/// What is wrong with the first cell where a side begins with another displacement than the body, or "".
std::string wrong_in_first_cell(const SolidSpec& solid, const SidePoint& point, const Vec2& of_side,
                                const GivenVector& u) {
  const Vec2 inwards = point.inner - point.x;
  return unbearable(
      solid, Mat2::Identity() + (u(point.inner, 0) - of_side) * inwards.transpose() / inwards.squaredNorm());
}

/// A displacement that does not begin where the body does is a jump over the first cell, which must bear it.
void check_jump(const SolidSpec& solid, const GivenSide& side, const SidePoint& point, const GivenVector& u) {
  if (schema::solid_boundary(side.spec.kind).holds != Hold::motion || !side.spec.vector || !u) return;
  const Vec2 of_side = given_by(*side.spec.vector)(point.x, 0), own = u(point.x, 0);
  const std::string wrong = wrong_in_first_cell(solid, point, of_side, u);
  if (wrong.empty()) return;
  fail(side.node_of("value").place, side.path_of("value"),
       fmt::format(
           "{} at once in the cell at ({:.6g}, {:.6g}): it begins with ({:.3g}, {:.3g}), and the solid with "
           "({:.3g}, {:.3g}); let it grow from there, or let `initial.u` be the same there",
           wrong, point.x[0], point.x[1], of_side[0], of_side[1], own[0], own[1]));
}

/// The same of a body that begins beside the wall along which it slides.
void check_jump_to_wall(const SolidSpec& solid, const GivenSide& side, const SidePoint& point,
                        const GivenVector& u) {
  if (schema::solid_boundary(side.spec.kind).holds != Hold::normal || !u) return;
  constexpr double round_off = 1e-12;
  const Vec2 own = u(point.x, 0), on_wall = point.along * point.along.dot(own);
  if ((own - on_wall).norm() <= round_off * point.x.norm()) return;
  const std::string wrong = wrong_in_first_cell(solid, point, on_wall, u);
  if (wrong.empty()) return;
  fail(side.node.place, side.path,
       fmt::format(
           "{} at once in the cell at ({:.6g}, {:.6g}): the wall holds the body across it, which begins with "
           "({:.3g}, {:.3g}); let `initial.u` lead along the wall there, or be zero",
           wrong, point.x[0], point.x[1], own[0], own[1]));
}

/// The points of a side of the grid of a solid, or of its outline, at which its data are looked at.
std::vector<SidePoint> points_of(const GridSpec& grid, Side side) {
  constexpr int samples = 16;
  std::vector<SidePoint> points;
  const int n = points_along(grid, side);
  for (int b = 0; b <= samples; ++b) {
    const int k = b * (n - 1) / samples;
    const Vec2 along =
        side_point(grid, side, std::min(k + 1, n - 1)) - side_point(grid, side, std::max(k - 1, 0));
    points.push_back(
        {.x = side_point(grid, side, k), .inner = inner_point(grid, side, k), .along = along.normalized()});
  }
  return points;
}

std::vector<SidePoint> points_of(const BodyFittedSpec& fitted) {
  constexpr std::size_t samples = 64;
  const std::vector<Vec2> outline = outline_points(fitted.curve);
  std::vector<SidePoint> points;
  for (std::size_t k = 0; k + 1 < outline.size(); k += std::max<std::size_t>(1, outline.size() / samples)) {
    const Vec2 along = (outline[k + 1] - outline[k]).normalized();
    const Vec2 inwards(-along[1], along[0]);  // the body is to the left
    points.push_back({.x = outline[k], .inner = outline[k] + fitted.spacing * inwards, .along = along});
  }
  return points;
}

void check_solid_side(const Case& problem, const SolidSpec& solid, const GivenSide& side,
                      const std::vector<SidePoint>& points) {
  const GivenVector u = initial_displacement(problem, solid);
  for (int k = 0; k < looked_at_times; ++k)
    for (const SidePoint& point : points) check_values(side, point.x, looked_at_time(problem, k));
  check_rate(problem, side, points);
  for (const SidePoint& point : points) {
    check_jump(solid, side, point, u);
    check_jump_to_wall(solid, side, point, u);
  }
}

void check_sides_of_solid(const Case& problem, const SolidSpec& solid, const Node& node) {
  const std::string path = "solids." + solid.name;
  if (!fitted_grids(solid).empty()) {
    const BodyFittedSpec& outline = solid.body_fitted.front();
    check_solid_side(problem, solid,
                     {.spec = outline.boundary[static_cast<std::size_t>(outline.side)],
                      .node = node_at(node, {"body_fitted", "boundary"}),
                      .path = path + ".body_fitted.boundary"},
                     points_of(outline));
    return;
  }
  for (const Side side : all_sides)
    check_solid_side(problem, solid,
                     given_side(side, solid.boundary[static_cast<std::size_t>(side)],
                                node_at(node, {"boundary"}), path + ".boundary"),
                     points_of(solid.grid, side));
}

void check_sides_of_gas(const Case& problem, const FluidSpec& fluid, const Node& node) {
  for (const Side side : all_sides) {
    const GivenSide given = given_side(side, fluid.boundary[static_cast<std::size_t>(side)],
                                       node_at(node, {"boundary"}), fluid.path + ".boundary");
    for (int k = 0; k < times_of_known_places(fluid, side); ++k) {
      const double t = looked_at_time(problem, k);
      for (const Vec2& x : sample_points(fluid.grid, side, t)) check_values(given, x, t);
    }
  }
  for (const GivenOnCurve& on_curve : given_on_curves(fluid, node)) {
    const GivenSide given{.spec = on_curve.spec, .node = on_curve.node, .path = on_curve.path};
    for (int k = 0; k < looked_at_times; ++k)
      for (const Vec2& x : on_curve.points) check_values(given, x, looked_at_time(problem, k));
  }
}

}  // namespace

void check_side_data(const Case& problem, const Node& root) {
  for (const FluidSpec& fluid : problem.fluids)
    check_sides_of_gas(problem, fluid, fluid_section_of(root, fluid.name));
  for (const SolidSpec& solid : problem.solids)
    if (is_continuum(solid.law)) check_sides_of_solid(problem, solid, node_at(root, {"solids", solid.name}));
}

}  // namespace fsi
