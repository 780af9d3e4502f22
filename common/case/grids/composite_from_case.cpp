#include "common/case/grids/composite_from_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/case/grids/no_grids_fit.hpp"
#include "common/core/failure.hpp"
#include "common/grid/geometry/near_curves.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/geometry/quality.hpp"

namespace fsi {

namespace {

grid::Curve ends_of(const BodyFittedSpec& spec) {
  return spec.curve.closed() ? grid::Curve::closed : grid::Curve::open;
}

/// To two digits.
double rounded_down(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::floor(value / unit * (1 + 1e-12)) * unit;
}

Vec2 direction_along(Side wall) {
  return direction_of(wall) == 0 ? Vec2(0, 1) : Vec2(1, 0);
}

/// Do curve and wall meet at less than 35 degrees, with the grid between them?
bool comes_down_flat(const BodyFittedSpec& spec, const Vec2& wall, std::size_t end) {
  const auto n = static_cast<std::size_t>(spec.curve.points());
  const auto at = [&](std::size_t k) { return Vec2(spec.curve.x[k], spec.curve.x[n + k]); };
  const Vec2 away = end == 0 ? Vec2(at(1) - at(0)) : Vec2(at(n - 2) - at(n - 1));
  const Vec2 left(-away[1], away[0]);  // of the curve at its first end, right of it at its last one
  const Vec2 inwards = (end == 0) == (spec.side == Side::bottom) ? left : Vec2(-left);
  const Vec2 along = inwards.dot(wall) > 0 ? wall : Vec2(-wall);
  constexpr double cosine = 0.82;
  return away.dot(along) > cosine * away.norm() * along.norm();
}

std::optional<grid::CrowdedCorner> crowded_at_corners(const BodyFittedSpec& spec, ConstFieldView x) {
  const bool yields = spec.curve.elastic_corners && spec.side == Side::top;
  const double least = yields ? grid::least_share_of_elastic_corners : grid::least_share_of_turns;
  return grid::most_crowded_corner(x, spec.side, spec.curve.corners, least);
}

/// What is wrong with the ghost lines behind a curve, through which fluxes go and from which values are
/// continued.
std::optional<std::string> trouble_behind(const BodyFittedSpec& spec, ConstFieldView x) {
  auto corner = grid::crowded_corner(x, spec.side);
  if (!corner) corner = grid::most_crowded_bend(x, spec.side, spec.curve.corners);
  if (const auto sharp = crowded_at_corners(spec, x); sharp && sharp->part < 1) corner = sharp;
  if (corner && corner->part < 1) {
    return fmt::format("its curve turns too sharply at ({:.6g}, {:.6g}) for the distance of its lines",
                       corner->x[0], corner->x[1]);
  }
  const grid::SlantedLine line = grid::most_slanted_line(x, spec.side);
  if (line.slant <= grid::largest_slant) return std::nullopt;
  return fmt::format(
      "at ({:.6g}, {:.6g}) {} for the distance of its lines, {:.2g} times that of its points", line.x[0],
      line.x[1],
      spec.curve.walls ? "its curve is too flat on the wall" : "its lines lean too far over the curve",
      line.slant);
}

bool holds(const BodyFittedSpec& spec) {
  try {
    return !trouble_behind(spec, grid::MovingGrid(grid_of(spec), 0).x());
  } catch (const Failure&) {
    return false;
  }
}

/// The same grid with the first distance of lines from an estimate on that holds, as deep as it was if that
/// does, less deep if not.
BodyFittedSpec first_that_holds(const BodyFittedSpec& spec, double estimate) {
  BodyFittedSpec tried = spec;
  tried.spacing = rounded_down(estimate);
  constexpr int most_trials = 12;
  for (int k = 0; k < most_trials; ++k, tried.spacing = rounded_down(0.93 * tried.spacing)) {
    for (const double share : {1.0, 0.7, 0.5}) {
      tried.lines = lines_to(share * depth_of(spec), tried.spacing, spec.growth);
      if (holds(tried)) return tried;
    }
  }
  tried.spacing = rounded_down(estimate);
  return tried;
}

constexpr double margin_of_estimate = 0.95;  // shares are not quite in proportion to distances

void check_behind(const BodyFittedSpec& spec, ConstFieldView x) {
  if (const auto trouble = trouble_behind(spec, x)) throw Diverged(*trouble, {.grid = spec.name});
}

/// An end of a grid lies on a wall, as far as the grid is deep.
void check_foot(const BodyFittedSpec& spec, const CurveSpec& wall, ConstFieldView x, int i) {
  constexpr double close = 1e-6;
  const auto at = [&](int line) {
    const int j = spec.side == Side::bottom ? line : x.layout.n2 - 1 - line;
    return Vec2(x(0, i, j), x(1, i, j));
  };
  int line = 0;
  while (line < x.layout.n2 && grid::distance_to(wall.x, at(line)) <= close * wall.spacing) ++line;
  if (line == x.layout.n2) return;
  const Vec2 end = at(line);
  const double room = (at(std::max(line - 1, 0)) - at(0)).norm();
  const std::string less = room > 0
                               ? fmt::format(", or make the grid less deep, with `spacing: {:.2g}` at most",
                                             0.99 * room / depth_of(spec.lines, spec.growth))
                               : "";
  throw NoGridsFit(
      {.cause = fmt::format(
           "grid \"{}\" reaches ({:.6g}, {:.6g}) along the wall of grid \"{}\", which bends before",
           spec.name, end[0], end[1], spec.curve.on),
       .otherwise = "let the body stand farther from the bend" + less});
}

/// The ends of a grid that stands on a wall lie on it.
void check_feet(const BodyFittedSpec& spec, const std::vector<BodyFittedSpec>& specs, ConstFieldView x) {
  const auto wall = std::ranges::find(specs, spec.curve.on, &BodyFittedSpec::name);
  if (spec.curve.on.empty() || wall == specs.end()) return;
  for (const int i : {0, x.layout.n1 - 1}) check_foot(spec, wall->curve, x, i);
}

}  // namespace

double depth_of(int lines, double growth) {
  double depth = 0, step = 1;
  for (int line = 1; line < lines; ++line, step *= growth) depth += step;
  return depth;
}

double depth_of(const BodyFittedSpec& spec) {
  if (!spec.map) return spec.spacing * depth_of(spec.lines, spec.growth);
  const Vec2 across(spec.map->c1.at_parameters(0, 1, 0) - spec.map->c1.at_parameters(0, 0, 0),
                    spec.map->c2.at_parameters(0, 1, 0) - spec.map->c2.at_parameters(0, 0, 0));
  return across.norm();
}

int lines_to(double depth, double spacing, double growth) {
  constexpr int fewest = 5, most = 100;
  constexpr double round_off = 1e-6;
  int lines = fewest;
  while (lines < most && spacing * depth_of(lines, growth) < depth * (1 - round_off)) ++lines;
  return lines;
}

BodyFittedSpec with_sound_lines(const BodyFittedSpec& spec) {
  constexpr double any = std::numeric_limits<double>::infinity();
  if (spec.map) return spec;
  constexpr double close = 0.05;  // of the points' distance: such lines hardly ever meet
  BodyFittedSpec thin = spec;
  thin.spacing = close * spec.curve.spacing;
  thin.lines = 5;
  double part = any;
  try {
    const grid::MovingGrid grid(grid_of(thin), 0);
    const auto bend = grid::most_crowded_bend(grid.x(), spec.side, spec.curve.corners);
    const auto corner = crowded_at_corners(spec, grid.x());
    const double slant = grid::most_slanted_line(grid.x(), spec.side).slant;
    part = std::min({bend ? bend->part : any, corner ? corner->part : any,
                     slant > 0 ? grid::largest_slant / slant : any});
  } catch (const Failure&) {  // another check says why no grid can be marched from this curve
    return spec;
  }
  const double estimate = margin_of_estimate * part * thin.spacing;
  return estimate < spec.spacing ? first_that_holds(spec, estimate) : spec;
}

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
      march.flat_ends[end] = comes_down_flat(spec, *march.walls[end], end);
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
    if (!spec.map) check_behind(spec, grids.back().x());
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
  throw Diverged(fmt::format("it and points of other grids interpolate from each other so that errors arrive "
                             "{:.3g} times as large (up to {:.3g} is sound): the overlap is too small",
                             worst.amplification, grid::CompositeGrid::sound_amplification),
                 {.t = 0,
                  .grid = composite.name(worst.grid),
                  .point = {worst.i, worst.j},
                  .position = {worst.x[0], worst.x[1]}});
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
