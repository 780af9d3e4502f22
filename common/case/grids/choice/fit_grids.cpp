#include "common/case/grids/choice/fit_grids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "common/case/grids/composite_from_case.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/grids/no_grids_fit.hpp"
#include "common/core/failure.hpp"
#include "common/grid/geometry/outline.hpp"
#include "common/grid/geometry/quality.hpp"

namespace fsi {

namespace {

/// Rules of docs/theory_grids.md, "Grids in a body".
constexpr double depth_by_thickness = 0.35;  ///< two grids along the outline and a core between them
constexpr double curve_by_radius = 0.5;      ///< points along a bend: three to a quarter of a circle
constexpr int usual_lines = 8;

grid::Curve ends_of(const CurveSpec& curve) {
  return curve.closed() ? grid::Curve::closed : grid::Curve::open;
}

/// Outline, seen closely.
struct Measures {
  double length = 0;
  grid::Bend inwards, outwards;  ///< sharpest bend towards the body's inside and towards the gas
  grid::Gap thickness;

  explicit Measures(const CurveSpec& curve)
      : length(curve.spacing * (curve.points() - 1)),
        inwards(grid::sharpest_bend(curve.x, ends_of(curve), 1, curve.corners)),
        outwards(grid::sharpest_bend(curve.x, ends_of(curve), -1, curve.corners)),
        thickness(grid::narrowest(curve.x, ends_of(curve), 1)) {}

  /// The deepest grid along the outline that leaves room for a core.
  double depth() const {
    return std::min(depth_by_radius * inwards.radius, depth_by_thickness * thickness.distance);
  }
};

/// A chosen number has six digits.
double as_written(double value) {
  return std::stod(fmt::format("{:.6g}", value));
}

/// A chosen coordinate, where points are `spacing` apart: far from the origin six digits would not place it.
double coordinate_as_written(double value, double spacing) {
  return std::stod(fmt::format("{:.{}g}", value, std::max(6, digits_for(value, spacing))));
}

/// Two coordinates with points c apart between them that hold the curve: an end with a wall is that wall.
void span_core(const CurveSpec& curve, int direction, double c, GridSpec& core) {
  const auto n = static_cast<std::ptrdiff_t>(curve.points());
  const auto first = curve.x.begin() + direction * n;
  const auto [low, high] = std::minmax_element(first, first + n);
  std::array<std::optional<double>, 2> wall;  // at the lower and the upper end
  if (curve.walls) {
    for (const std::size_t end : {0U, 1U}) {
      const Side side = (*curve.walls)[end];
      if (direction_of(side) == direction)
        wall[at_upper_end(side) ? 1 : 0] = end == 0 ? *first : *(first + n - 1);
    }
  }
  double a = wall[0].value_or(*low - 0.5 * c), b = wall[1].value_or(*high + 0.5 * c);
  const int cells = std::max(4, static_cast<int>(std::ceil((b - a) / c * (1 - 1e-9))));
  const double excess = cells * c - (b - a);
  if (!wall[0]) a = coordinate_as_written(a - (wall[1] ? excess : 0.5 * excess), c);
  if (!wall[1]) b = coordinate_as_written(a + cells * c, c);
  (direction == 0 ? core.x_a : core.y_a) = a;
  (direction == 0 ? core.x_b : core.y_b) = b;
  (direction == 0 ? core.n1 : core.n2) = cells + 1;
}

GridSpec core_around(const CurveSpec& curve, double c, const BodyWish& wish) {
  GridSpec core;
  core.name = "core";
  if (!wish.box) {
    span_core(curve, 0, c, core);
    span_core(curve, 1, c, core);
    return core;
  }
  const auto [x_a, x_b, y_a, y_b] = *wish.box;
  core.x_a = x_a, core.x_b = x_b, core.y_a = y_a, core.y_b = y_b;
  core.n1 = std::max(5, static_cast<int>(std::ceil((x_b - x_a) / c * (1 - 1e-9))) + 1);
  core.n2 = std::max(5, static_cast<int>(std::ceil((y_b - y_a) / c * (1 - 1e-9))) + 1);
  return core;
}

constexpr double most_points = 4e6;  ///< of the core of a body

/// What takes more points than there can be: h itself, a bend or a waist.
[[noreturn]] void too_fine(const Measures& outline, double points, bool as_coarse_as_h) {
  const bool bend =
      depth_by_radius * outline.inwards.radius < depth_by_thickness * outline.thickness.distance;
  const Vec2& x = bend ? outline.inwards.x : outline.thickness.x;
  const std::string cause = fmt::format("grids inside this outline would take {:.2g} points", points);
  if (as_coarse_as_h) {
    throw NoGridsFit({.cause = fmt::format("{} h apart, more than {:.2g}", cause, most_points),
                      .otherwise = fmt::format("take grid.factor smaller, {:.2g} times what it is",
                                               0.9 * std::sqrt(most_points / points))});
  }
  throw NoGridsFit(
      {.cause = fmt::format("{}: {} at ({:.6g}, {:.6g})", cause,
                            bend ? fmt::format("it bends with a radius of {:.3g}", outline.inwards.radius)
                                 : fmt::format("it is only {:.3g} thick", outline.thickness.distance),
                            x[0], x[1]),
       .otherwise = bend ? "round it more" : "make it thicker"});
}

/// Grids of a depth, and how close their points are.
struct Trial {
  double depth, core, curve;
  int lines;
};

BodyGrids grids_of(const Outline& curves, const Trial& trial, const BodyWish& wish, const Measures& outline) {
  BodyGrids grids;
  grids.lines = wish.lines.value_or(trial.lines);
  grids.line_spacing =
      as_written(wish.line_spacing.value_or(trial.depth / depth_of(grids.lines, wish.growth)));
  const double along = std::round(outline.length / trial.curve) + 1, most = 20 * std::sqrt(most_points);
  const std::string smaller = fmt::format("take grid.factor {:.2g} times what it is", most / along / 8);
  if (along > most)
    throw NoGridsFit(
        {.cause = fmt::format("this outline would take {:.2g} points", along), .otherwise = smaller});
  grids.outline_points = std::max(9, static_cast<int>(along));
  const CurveSpec curve =
      curves.with_points(wish.curve_is_given ? std::nullopt : std::optional(grids.outline_points));
  grids.outline_points = curve.points();
  grids.core = core_around(curve, trial.core, wish);
  return grids;
}

bool connects(const Outline& curves, const BodyGrids& grids, const BodyWish& wish) {
  BodyFittedSpec ring;
  ring.name = "outline";
  ring.curve = curves.with_points(wish.curve_is_given ? std::nullopt : std::optional(grids.outline_points));
  ring.side = Side::bottom;
  ring.lines = grids.lines;
  ring.spacing = grids.line_spacing;
  ring.growth = wish.growth;
  return connects(grids.core, {ring});
}

/// Curves that leave the rectangle connect with no grids.
bool reaches_beyond(const GridSpec& box, const std::vector<BodyFittedSpec>& rings) {
  constexpr double round_off = 1e-6;  // of a cell, of points that stand on a side
  if (box.rotation != 0) return false;
  const double tolerance = round_off * std::min((box.x_b - box.x_a) / box.n1, (box.y_b - box.y_a) / box.n2);
  return std::ranges::any_of(rings, [&](const BodyFittedSpec& ring) {
    const auto n = static_cast<std::ptrdiff_t>(ring.curve.points());
    const auto [left, right] = std::minmax_element(ring.curve.x.begin(), ring.curve.x.begin() + n);
    const auto [low, high] = std::minmax_element(ring.curve.x.begin() + n, ring.curve.x.end());
    return *left < box.x_a - tolerance || *right > box.x_b + tolerance || *low < box.y_a - tolerance ||
           *high > box.y_b + tolerance;
  });
}

/// How deep a ring may be: for bends and bays of its own curve, and between it and others; and how far apart
/// its lines at most, for its bends and its ends on walls. And how thick the body is.
struct Room {
  double own = 0, between = 0, spacing = 0, body = 0;
};

/// From a closed curve to the rim of a rectangle.
double distance_to_rim(const CurveSpec& curve, const GridSpec& box) {
  double distance = std::numeric_limits<double>::infinity();
  const auto n = static_cast<std::size_t>(curve.points());
  for (std::size_t k = 0; k < n; ++k) {
    const double x = curve.x[k], y = curve.x[n + k];
    distance = std::min({distance, x - box.x_a, box.x_b - x, y - box.y_a, box.y_b - y});
  }
  return distance;
}

bool stands_on(const BodyFittedSpec& ring, const BodyFittedSpec& wall) {
  return !ring.curve.on.empty() && ring.curve.on == wall.name;
}

/// The distance of lines that a curve holds, if it is less than usual.
double sound_spacing(const BodyFittedSpec& ring) {
  const double sound = with_sound_lines(ring).spacing;
  return sound < ring.spacing ? sound : std::numeric_limits<double>::infinity();
}

std::vector<Room> rooms_of(const GridSpec& background, const std::vector<BodyFittedSpec>& rings) {
  std::vector<Room> rooms;
  for (const BodyFittedSpec& ring : rings) {
    const CurveSpec& curve = ring.curve;
    const double to_gas = ring.side == Side::top ? -1 : 1;
    Room room{.own = std::min(0.5 * grid::narrowest(curve.x, ends_of(curve), to_gas).distance,
                              grid::sharpest_bend(curve.x, ends_of(curve), to_gas, curve.corners).radius),
              .between = std::numeric_limits<double>::infinity(),
              .spacing = sound_spacing(ring),
              .body = grid::narrowest(curve.x, ends_of(curve), -to_gas).distance};
    for (const BodyFittedSpec& other : rings) {
      if (&other != &ring && !stands_on(ring, other) && !stands_on(other, ring))
        room.between = std::min(room.between, 0.5 * grid::gap_between(curve.x, other.curve.x).distance);
    }
    if (curve.closed() && ring.side == Side::top)
      room.between = std::min(room.between, distance_to_rim(curve, background));
    rooms.push_back(room);
  }
  return rooms;
}

/// The open rings with so many lines, to a part of the depth there is room for on a background of spacing h.
struct RingTrial {
  int lines;
  double part, h;
  bool apart;  ///< rings of two bodies do not reach into each other
};

std::vector<RingGrid> with_lines(std::vector<BodyFittedSpec>& rings, const std::vector<std::size_t>& open,
                                 const std::vector<Room>& rooms, const RingTrial& trial) {
  std::vector<RingGrid> result;
  for (const std::size_t k : open) {
    const double h = trial.h, usual = depth_of(usual_lines, rings[k].growth) * h;
    double depth = std::min(usual, rooms[k].own);
    if (trial.apart) depth = std::min(depth, rooms[k].between - h);
    depth = trial.part * std::max(depth, 2 * h);
    BodyFittedSpec& ring = rings[k];
    ring.lines = trial.lines;
    ring.spacing = as_written(std::min(h, depth / depth_of(trial.lines, ring.growth)));
    if (const double sound = rooms[k].spacing; ring.spacing > sound) {
      // Less deep first: many close lines to the full depth run together before a side between two bends.
      const double share = trial.lines == usual_lines ? 0.7 : 1;
      ring.spacing = as_written(sound);
      ring.lines = lines_to(share * depth, sound, ring.growth);
    }
    result.push_back({ring.lines, ring.spacing});
  }
  return result;
}

GridSpec with_spacing(GridSpec grid, double h) {
  grid.n1 = static_cast<int>(std::round((grid.x_b - grid.x_a) / h)) + 1;
  grid.n2 = static_cast<int>(std::round((grid.y_b - grid.y_a) / h)) + 1;
  return grid;
}

/// Given lines that meet those from the other side of the body leave no room for a core, whatever the rest is.
bool given_lines_meet(const BodyWish& wish, const Measures& outline) {
  return wish.lines && wish.line_spacing &&
         depth_of(*wish.lines, wish.growth) * *wish.line_spacing >= 0.5 * outline.thickness.distance;
}

}  // namespace

BodyGrids fit_body(const Outline& curves, double h, const BodyWish& wish, bool outline_only) {
  const Measures outline(curves.closely);
  const double usual = depth_of(usual_lines, wish.growth) * h, room = outline.depth();
  const double bend = std::min(outline.inwards.radius, outline.outwards.radius);
  Trial trial{.depth = usual, .core = h, .curve = std::min(h, curve_by_radius * bend), .lines = usual_lines};
  if (outline_only || given_lines_meet(wish, outline)) return grids_of(curves, trial, wish, outline);
  if (room < usual)
    trial = {.depth = room, .core = std::min(h, room / 4.5), .curve = trial.curve, .lines = 7};
  constexpr double finer = 0.85;
  constexpr int most_trials = 24;
  BodyGrids grids;
  for (int k = 0; k < most_trials; ++k) {
    grids = grids_of(curves, trial, wish, outline);
    const double points = static_cast<double>(grids.core.n1) * grids.core.n2;
    if (points > most_points && k == 0) too_fine(outline, points, trial.core >= h);
    if (points > most_points) break;  // it is not for want of points
    if (connects(curves, grids, wish)) return grids;
    // A finer core first; then a grid less deep, whose lines do not run into each other.
    trial.core *= finer;
    if (k % 2 == 1) trial.depth *= finer;
    if (k % 4 == 3) trial.curve *= finer;
  }
  return grids;  // check says what is wrong with them
}

namespace {

/// The last two lines of a ring interpolate themselves. Those before them must hold donors for points of the background
/// as far as two by two of its spacing h from a hole, which they are somewhere on the way of a body that moves.
int last_donor_line(const BodyFittedSpec& ring) {
  return ring.lines - 3;
}
double depth_of_donors(double h) {
  constexpr double two_by_two = 2.83;  // points
  return two_by_two * h;
}

/// Of the last donors, from the curve: along the walls that an open one stands on, or wherever they are nearest to it.
double depth_of_last_donors(const BodyFittedSpec& ring, ConstFieldView x, bool wherever) {
  double depth = std::numeric_limits<double>::infinity();
  const int line = last_donor_line(ring), j = ring.side == Side::top ? x.layout.n2 - 1 - line : line;
  const int last = x.layout.n1 - 1;
  for (int i = 0; i <= last; i += wherever ? 1 : last) {
    if (!wherever && ring.curve.closed()) break;
    depth = std::min(depth, grid::distance_to(ring.curve.x, Vec2(x(0, i, j), x(1, i, j))));
  }
  return depth;
}

/// What the rings of a gas are chosen for.
struct RingSearch {
  const GridSpec& background;
  std::vector<BodyFittedSpec> rings;
  const std::vector<std::size_t>& open;
  const std::vector<RingMotion>& motions;
  std::vector<Room> rooms;
  double spacing;        ///< of the background
  bool lasting = false;  ///< the grids are to hold while the bodies move too

  GridSpec grid(double part, double h) const { return part == 1 ? background : with_spacing(background, h); }
  double spacing_of(double part) const { return part == 1 ? spacing : as_written(part * spacing); }

  /// With the rings as they are now.
  bool holds(const GridSpec& grid, double h) const {
    const auto ends_early = [&](std::size_t k) {
      const BodyFittedSpec& ring = rings[k];
      return motions[k] != RingMotion::still &&
             ring.spacing * depth_of(last_donor_line(ring) + 1, ring.growth) < depth_of_donors(h);
    };
    if (lasting && std::ranges::any_of(open, ends_early)) return false;
    return connects(grid, rings) && (!lasting || lasts(h));
  }

  /// At a foot that leans, lines along the wall are less deep than they are long; above the end of a thin body, whose
  /// holes are points beside it, they lie closer. Cells that are slanted or narrow at t = 0 fold when their curve deforms.
  bool lasts(double h) const {
    constexpr double sound = 0.25;  // grid::cell_quality
    const std::vector<grid::MovingGrid> grids = grids_at_start(rings);
    return std::ranges::all_of(open, [&](std::size_t k) {
      if (motions[k] == RingMotion::still) return true;
      const ConstFieldView x = grids[k].x();
      const bool is_thin = rooms[k].body < h;
      return depth_of_last_donors(rings[k], x, is_thin) >= depth_of_donors(h) + (is_thin ? 0.5 * h : 0) &&
             (motions[k] == RingMotion::carried || grid::cell_quality(x) >= sound);
    });
  }

  /// The first lines that hold on a background with a part of the given spacing.
  std::optional<GasGrids> lines_for(double part) {
    const double h = spacing_of(part);
    std::vector<std::vector<RingGrid>> tried;
    for (const bool apart : {false, true}) {
      for (const double share : {1.0, 0.85, 0.7, 0.55}) {
        for (const int lines : {usual_lines, 6}) {
          const std::vector<RingGrid> chosen = with_lines(rings, open, rooms, {lines, share, h, apart});
          if (std::ranges::find(tried, chosen) != tried.end()) continue;
          tried.push_back(chosen);
          if (holds(grid(part, h), h)) return GasGrids{h, chosen};
        }
      }
    }
    return {};
  }

  std::vector<RingGrid> usual() { return with_lines(rings, open, rooms, {usual_lines, 1, spacing, false}); }

  std::optional<GasGrids> first(bool finer) {
    for (const double part : {1.0, 0.85, 0.7, 0.6, 0.5, 0.4, 0.3}) {
      if (part < 1 && !finer) return {};
      if (std::optional<GasGrids> found = lines_for(part)) return found;
    }
    // The background alone becomes finer, before grids as deep as they are on the coarse one.
    const std::vector<RingGrid> chosen = usual();
    for (const double part : {0.85, 0.7, 0.6, 0.5, 0.4, 0.3}) {
      const double h = spacing_of(part);
      if (holds(grid(part, h), h)) return GasGrids{h, chosen};
    }
    return {};
  }
};

}  // namespace

GasGrids fit_rings(const GridSpec& background, const std::vector<BodyFittedSpec>& given,
                   const std::vector<std::size_t>& open, const std::vector<RingMotion>& motions, bool finer) {
  RingSearch search{.background = background,
                    .rings = given,
                    .open = open,
                    .motions = motions,
                    .rooms = rooms_of(background, given),
                    .spacing = (background.x_b - background.x_a) / (background.n1 - 1)};
  if (reaches_beyond(background, given)) return {search.spacing, search.usual()};
  for (const bool lasting : {true, false}) {
    search.lasting = lasting;
    if (std::optional<GasGrids> found = search.first(finer))
      return {found->background, found->rings, lasting};
  }
  return {search.spacing, search.usual()};
}

}  // namespace fsi
