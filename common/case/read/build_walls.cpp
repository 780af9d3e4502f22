#include "common/case/read/build_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "common/case/document/fluid_sections.hpp"
#include "common/case/read/build_shape.hpp"
#include "common/core/input/suggest.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

std::optional<Side> side_called(const Node& node) {
  for (const Side side : all_sides) {
    if (node.text == name_of(side)) return side;
  }
  return std::nullopt;
}

/// The gases' grids along walls, by name.
const Node* grid_named(const Reader& reader, const std::string& name, std::vector<std::string>& others) {
  for (const auto& fluid : fluid_sections(reader.root())) {
    const Node* list = fluid.node->find("body_fitted");
    if (list == nullptr) continue;
    for (const Node& grid : list->items) {
      const Node* own = grid.find("name");
      if (own == nullptr || grid.find("shape") == nullptr) continue;
      if (own->text == name) return &grid;
      others.push_back(own->text);
    }
  }
  return nullptr;
}

/// The wall, seen closely, the gas to its right.
CurveSpec wall_closely(const Reader& reader, const Node& grid, const std::string& name) {
  Node shape = *grid.find("shape");
  std::erase_if(shape.entries, [](const config::Entry& key) { return key.key == "weights"; });
  constexpr int samples = 1200;
  CurveSpec wall = build_curve(reader, shape, fmt::format("the shape of grid `{}`", name), samples);
  bool inside = false;
  Reader::assign(grid, "inside", inside);
  if (!inside) return wall;
  const auto middle = wall.x.begin() + wall.points();
  std::reverse(wall.x.begin(), middle);
  std::reverse(middle, wall.x.end());
  return wall;
}

Vec2 point_of(const CurveSpec& curve, int k) {
  const auto at = static_cast<std::size_t>(k), n = static_cast<std::size_t>(curve.points());
  return {curve.x[at], curve.x[n + at]};
}

/// The stretch of a wall nearest to a position.
struct Foot {
  int segment = 0;
  double distance = 0;
  Vec2 along = Vec2::Zero(), x = Vec2::Zero();  ///< direction of the wall; the nearest point on it
};

Foot foot_on(const CurveSpec& wall, const Vec2& x) {
  Foot foot{.distance = INFINITY};
  for (int k = 0; k + 1 < wall.points(); ++k) {
    const Vec2 a = point_of(wall, k), along = point_of(wall, k + 1) - a;
    const double part = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vec2 on_wall = a + part * along;
    const double distance = (on_wall - x).norm();
    if (distance < foot.distance)
      foot = {.segment = k, .distance = distance, .along = along.normalized(), .x = on_wall};
  }
  return foot;
}

/// Ends of an outline that are near the wall, as six digits leave them, are put on it, in the direction that the
/// outline has there. The way is a small part of a spacing, of the case's and of the outline's points.
/// @returns whether it is near enough
bool put_on_wall(CurveSpec& curve, int end, const Foot& foot, double h) {
  constexpr double near = 1e-2, of_own = 0.2;
  if (!(foot.distance <= std::min(near * h, of_own * curve.spacing))) return false;
  const int beside = end == 0 ? 1 : end - 1;
  const Vec2 x = point_of(curve, end), along = (x - point_of(curve, beside)).normalized();
  const Vec2 across(-foot.along[1], foot.along[0]);
  constexpr double flattest = 0.2;  // where it comes down at a smaller slope the nearest point is taken
  const double slope = across.dot(along);
  const Vec2 on_wall = std::abs(slope) < flattest ? foot.x : Vec2(x - across.dot(x - foot.x) / slope * along);
  const auto at = static_cast<std::size_t>(end), n = static_cast<std::size_t>(curve.points());
  curve.x[at] = on_wall[0];
  curve.x[n + at] = on_wall[1];
  return true;
}

/// The side whose direction into the gas is nearest to a direction.
Side side_facing(const Vec2& inwards) {
  if (std::abs(inwards[0]) > std::abs(inwards[1])) return inwards[0] > 0 ? Side::left : Side::right;
  return inwards[1] > 0 ? Side::bottom : Side::top;
}

/// Where the wall bends between the feet, if it does.
std::optional<Vec2> bend_between(const CurveSpec& wall, const std::array<Foot, 2>& feet) {
  const auto [first, last] = std::minmax(feet[0].segment, feet[1].segment);
  constexpr double straight = 1e-9;
  for (int k = first + 1; k <= last; ++k) {
    const Vec2 here = point_of(wall, k), before = (here - point_of(wall, k - 1)).normalized(),
               after = (point_of(wall, k + 1) - here).normalized();
    if (std::abs(before[0] * after[1] - before[1] * after[0]) > straight) return here;
  }
  return std::nullopt;
}

}  // namespace

void read_walls(const Node& shape, const std::string& path, CurveSpec& curve) {
  const Node* walls = shape.find("walls");
  if (walls == nullptr) return;
  const std::string where = path + ".walls";
  if (walls->items.size() != 2) fail(walls->place, where, "must be two sides, [bottom, bottom]");
  const std::optional<Side> first = side_called(walls->items[0]), last = side_called(walls->items[1]);
  if (first && last) {
    curve.walls = std::array{*first, *last};
    return;
  }
  if (walls->items[0].text != walls->items[1].text) {
    fail(walls->place, where,
         "both ends stand on sides (left, right, bottom, top), or both on the wall of one grid: write its "
         "name "
         "twice");
  }
  curve.walls = std::array{Side::bottom, Side::bottom};
  curve.on = walls->items[0].text;
}

void stand_on_wall(const Reader& reader, const Node& shape, const std::string& path, CurveSpec& curve) {
  if (curve.on.empty()) return;
  const Node& walls = *shape.find("walls");
  const std::string where = path + ".walls";
  std::vector<std::string> others{"left", "right", "bottom", "top"};
  const Node* grid = grid_named(reader, curve.on, others);
  if (grid == nullptr) {
    fail(walls.place, where,
         fmt::format("there is no side and no grid with a `shape` in fluid.body_fitted {}{}",
                     in_ticks(curve.on), did_you_mean(curve.on, others)));
  }
  if (const Node* own = grid->find("shape")->find("walls")) {
    const bool on_sides =
        std::ranges::all_of(own->items, [](const Node& item) { return side_called(item).has_value(); });
    if (!on_sides)
      fail(walls.place, where,
           fmt::format(
               "grid {} stands on another wall itself; only walls that end on sides, or are closed, carry "
               "bodies",
               in_ticks(curve.on)));
  }
  const CurveSpec wall = wall_closely(reader, *grid, curve.on);
  std::array<Foot, 2> feet;
  const std::array ends{point_of(curve, 0), point_of(curve, curve.points() - 1)};
  for (const std::size_t end : {0U, 1U}) {
    feet[end] = foot_on(wall, ends[end]);
    const int at = end == 0 ? 0 : curve.points() - 1;
    if (!put_on_wall(curve, at, feet[end], reader.scope().constants.at("h"))) {
      fail(walls.place, where,
           fmt::format(
               "an end of the outline, ({:.6g}, {:.6g}), is {:.3g} from the wall of grid {}; let it end "
               "there, the nearest point is ({:.9g}, {:.9g})",
               ends[end][0], ends[end][1], feet[end].distance, in_ticks(curve.on), feet[end].x[0],
               feet[end].x[1]));
    }
  }
  if (const auto bend = bend_between(wall, feet)) {
    fail(walls.place, where,
         fmt::format(
             "the wall of grid {} bends at ({:.6g}, {:.6g}), between the ends of the outline; let the body "
             "stand on a straight part of it, or draw wall and body as one outline",
             in_ticks(curve.on), (*bend)[0], (*bend)[1]));
  }
  for (const std::size_t end : {0U, 1U}) {
    const Vec2 along = feet[0].along;
    curve.along[end] = along;
    (*curve.walls)[end] = side_facing({along[1], -along[0]});
  }
}

}  // namespace fsi
