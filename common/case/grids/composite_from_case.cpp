#include "common/case/grids/composite_from_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/failure.hpp"
#include "common/grid/geometry/near_curves.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/geometry/quality.hpp"

namespace fsi {

namespace {

grid::Curve ends_of(const BodyFittedSpec& spec) {
  return spec.curve.closed() ? grid::Curve::closed : grid::Curve::open;
}

Vec2 direction_along(Side wall) {
  return direction_of(wall) == 0 ? Vec2(0, 1) : Vec2(1, 0);
}

/// Fluxes through the curve need cells on its other side.
void check_corners(const BodyFittedSpec& spec, ConstFieldView x) {
  const auto corner = grid::crowded_corner(x, spec.side);
  if (!corner) return;
  throw UserMistake(fmt::format(
      "grid \"{}\": its curve turns too sharply at ({:.4g}, {:.4g}) for the distance of its lines; write "
      "at most `spacing: {:.2g}` for it",
      spec.name, corner->x[0], corner->x[1], corner->spacing));
}

/// The ends of a grid that stands on a wall lie on it, as far as the grid is deep.
void check_feet(const BodyFittedSpec& spec, const std::vector<BodyFittedSpec>& specs, ConstFieldView x) {
  const auto wall = std::ranges::find(specs, spec.curve.on, &BodyFittedSpec::name);
  if (spec.curve.on.empty() || wall == specs.end()) return;
  constexpr double close = 1e-6;
  for (const int i : {0, x.layout.n1 - 1}) {
    for (int j = 0; j < x.layout.n2; ++j) {
      const Vec2 end(x(0, i, j), x(1, i, j));
      if (grid::distance_to(wall->curve.x, end) <= close * wall->curve.spacing) continue;
      throw UserMistake(
          fmt::format("grid \"{}\" reaches ({:.4g}, {:.4g}) along the wall of grid \"{}\", which bends "
                      "before; let the body stand "
                      "farther from the bend, or make the grid less deep with a smaller `spacing`",
                      spec.name, end[0], end[1], wall->name));
    }
  }
}

}  // namespace

grid::CartesianGrid background_of(const GridSpec& spec) {
  return {.name = spec.name,
          .n1 = spec.n1,
          .n2 = spec.n2,
          .x_a = spec.x_a,
          .x_b = spec.x_b,
          .y_a = spec.y_a,
          .y_b = spec.y_b};
}

grid::GridDescription grid_of(const BodyFittedSpec& spec) {
  if (spec.map) {
    const bool from_last = spec.side == Side::top;
    return {.name = spec.name,
            .n1 = spec.curve.points(),
            .n2 = spec.lines,
            .mapping =
                [map = *spec.map, from_last](double r1, double r2, double t) {
                  const double s = from_last ? 1 - r2 : r2;
                  return Vec2(map.c1.at_parameters(r1, s, t), map.c2.at_parameters(r1, s, t));
                },
            .periodic1 = spec.curve.closed()};
  }
  grid::HyperbolicGrid march{.name = spec.name,
                             .points = spec.curve.points(),
                             .lines = spec.lines,
                             .curve = spec.side,
                             .ends = ends_of(spec),
                             .spacing = spec.spacing,
                             .growth = spec.growth,
                             .concave_smoothing = spec.concave_smoothing};
  march.blend = 2 * spec.lines;  // over twice the depth, where points are as far apart as lines
  if (spec.curve.walls) {
    for (std::size_t end : {0U, 1U}) {
      march.walls[end] =
          spec.curve.on.empty() ? direction_along((*spec.curve.walls)[end]) : spec.curve.along[end];
    }
  }
  grid::GridDescription description = grid::marched_from(march, spec.curve.x);
  description.follows = false;
  return description;
}

std::vector<grid::BodyFittedGrid> bodies_of(const std::vector<BodyFittedSpec>& specs) {
  std::vector<grid::BodyFittedGrid> bodies;
  for (const BodyFittedSpec& spec : specs) {
    const auto wall = std::ranges::find(specs, spec.curve.on, &BodyFittedSpec::name);
    const bool stands = !spec.curve.on.empty() && wall != specs.end();
    bodies.push_back({.name = spec.name,
                      .n1 = spec.curve.points(),
                      .n2 = spec.lines,
                      .curve = spec.side,
                      .ends = ends_of(spec),
                      .wall = stands ? static_cast<int>(wall - specs.begin()) + 1 : 0,
                      .of = spec.solid.empty() ? "" : fmt::format("body `{}`", spec.solid)});
  }
  return bodies;
}

namespace {

struct StartingGrids {
  std::vector<grid::MovingGrid> grids;
  grid::NearCurves near;
};

StartingGrids start(const std::vector<BodyFittedSpec>& specs) {
  std::vector<grid::MovingGrid> grids;
  std::vector<grid::MovingGrid*> pointers;
  for (const BodyFittedSpec& spec : specs) {
    grids.emplace_back(grid_of(spec), 0);
    if (!spec.map) check_corners(spec, grids.back().x());
    check_feet(spec, specs, grids.back().x());
  }
  for (grid::MovingGrid& grid : grids) pointers.push_back(&grid);
  grid::NearCurves near = leave_room(pointers, bodies_of(specs), 0);
  return {std::move(grids), std::move(near)};
}

}  // namespace

std::vector<grid::MovingGrid> grids_at_start(const std::vector<BodyFittedSpec>& specs) {
  return start(specs).grids;
}

void connect_once(const GridSpec& background, const std::vector<BodyFittedSpec>& specs) {
  const auto [grids, near] = start(specs);
  std::vector<ConstFieldView> views;
  for (const grid::MovingGrid& grid : grids) views.push_back(grid.x());
  grid::CompositeGrid composite(background_of(background), bodies_of(specs));
  report_too_near(near, composite, 0);
  composite.connect(views, 0);
  const grid::OverlapRecord& worst = composite.record();
  if (worst.amplification <= grid::CompositeGrid::sound_amplification) return;
  throw NumbersBroke(fmt::format(
      "t = 0, grid \"{}\", point ({}, {}) at ({:.6g}, {:.6g}): it and points of other grids interpolate from "
      "each "
      "other so that errors arrive {:.3g} times as large (up to {:.3g} is sound): the overlap is too small",
      composite.name(worst.grid), worst.i, worst.j, worst.x[0], worst.x[1], worst.amplification,
      grid::CompositeGrid::sound_amplification));
}

bool connects(const GridSpec& background, const std::vector<BodyFittedSpec>& specs) {
  try {
    connect_once(background, specs);
    return true;
  } catch (const Failure&) {
    return false;
  }
}

}  // namespace fsi
