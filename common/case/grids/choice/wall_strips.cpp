#include "common/case/grids/choice/wall_strips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/case/grids/curve_side.hpp"
#include "common/case/grids/node_tools.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/core/component_major.hpp"
#include "common/core/failure.hpp"
#include "common/grid/geometry/outline.hpp"

namespace fsi {

namespace {

using config::Node;

/// A body nearer than that to a wall, in spacings of the background: more than grids of eight lines are deep.
constexpr double near = 10;

/// And so near that no gas fits between them: it is meant to stand there.
constexpr double touching = 0.5;

double end_of_box(const GridSpec& box, Side side) {
  if (direction_of(side) == 0) return at_upper_end(side) ? box.x_b : box.x_a;
  return at_upper_end(side) ? box.y_b : box.y_a;
}

/// How near a curve comes to a side, and the place on that side that it is nearest to.
struct Approach {
  double distance = std::numeric_limits<double>::infinity();
  Vec2 foot = Vec2::Zero();
};

Approach approach_to(const CurveSpec& curve, const GridSpec& box, Side side) {
  const int across = direction_of(side);
  const double wall = end_of_box(box, side), inwards = at_upper_end(side) ? -1 : 1;
  Approach nearest;
  for (std::size_t k = 0; k < static_cast<std::size_t>(curve.points()); ++k) {
    Vec2 foot = vector_at(curve.x, k);
    const double distance = inwards * (foot[across] - wall);
    if (distance >= nearest.distance) continue;
    foot[across] = wall;
    nearest = {.distance = distance, .foot = foot};
  }
  return nearest;
}

/// Whether the gas comes to a place on the rim next to the body of ring `own`: it does not behind the curve of another
/// grid, and a curve that lies along the rim has a grid there.
bool gas_comes_to(const Vec2& foot, const FluidSpec& fluid, std::size_t own, double cell) {
  constexpr double round_off = 1e-6;  // of a cell
  for (std::size_t k = 0; k < fluid.body_fitted.size(); ++k) {
    const BodyFittedSpec& other = fluid.body_fitted[k];
    if (k == own) continue;
    if (grid::distance_to(other.curve.x, foot) <= round_off * cell) return false;
    if (lies_behind(other, fluid.grid, foot)) return false;
  }
  return true;
}

bool has_an_end_on(const CurveSpec& curve, Side side) {
  return curve.walls && std::ranges::find(*curve.walls, side) != curve.walls->end();
}

void refuse_touching(const BodyFittedSpec& ring, const Node& item, Side side, double distance) {
  throw UserMistake(config::located(
      item.place, fmt::format("solids.{}.shape", ring.solid),
      fmt::format(
          "the outline of solid `{0}` comes within {2:.3g} of the {1} side of the gas, less than half a "
          "cell; if it stands there, write `walls: [{1}, {1}]` into the shape, with its first and its "
          "last point on that side (a circle or an ellipse has no such points: draw it as a polygon or a "
          "spline); if not, move it away, or take grid.factor greater",
          ring.solid, name_of(side), std::max(distance, 0.0))));
}

/// A side and the curve whose body comes nearest to it.
struct NearBody {
  Side side{};
  const Node* body = nullptr;  ///< none is near
  double distance = std::numeric_limits<double>::infinity();
};

/// The curve whose body is near to a wall that has no grid of its own.
NearBody body_near(const Node& list, const FluidSpec& fluid, const std::vector<std::size_t>& open,
                   Side side) {
  NearBody nearest{.side = side};
  const GridSpec& box = fluid.grid;
  const double across = (box.x_b - box.x_a) / (box.n1 - 1), up = (box.y_b - box.y_a) / (box.n2 - 1);
  const double cell = std::min(across, up), spacing = std::max(across, up);
  for (const std::size_t k : open) {
    const BodyFittedSpec& ring = fluid.body_fitted[k];
    if (!ring.curve.closed() || ring.side != Side::top) continue;
    const auto [distance, foot] = approach_to(ring.curve, box, side);
    if (!(distance < near * spacing) || !gas_comes_to(foot, fluid, k, cell)) continue;
    if (std::abs(distance) < touching * cell && !ring.solid.empty())
      refuse_touching(ring, list.items[k], side, distance);
    if (distance > 0 && distance < nearest.distance) nearest = {side, &list.items[k], distance};
  }
  return nearest;
}

Node list_of(std::vector<Node> items, const std::string& place) {
  Node list{.kind = Node::Kind::list, .place = place, .entries = {}};
  list.items = std::move(items);
  return list;
}

/// From one end of the side to the other.
Node strip_along(const GridSpec& box, Side side, const std::string& place) {
  const bool upright = direction_of(side) == 0;
  const double wall = end_of_box(box, side);
  const auto corner = [&](double along) {
    const Node a = config::number_node(upright ? wall : along, place),
               b = config::number_node(upright ? along : wall, place);
    return list_of({a, b}, place);
  };
  const auto word = [&](Side end) { return config::word_node(name_of(end), place); };
  Node shape{.kind = Node::Kind::map, .place = place, .entries = {}};
  put(shape, "kind", config::word_node("polygon", place));
  put(shape, "corners",
      list_of({corner(upright ? box.y_a : box.x_a), corner(upright ? box.y_b : box.x_b)}, place));
  put(shape, "walls",
      list_of({word(upright ? Side::bottom : Side::left), word(upright ? Side::top : Side::right)}, place));
  Node strip{.kind = Node::Kind::map, .place = place, .entries = {}};
  put(strip, "name", config::word_node(fmt::format("along_{}", name_of(side)), place));
  put(strip, "shape", shape);
  put(strip, "boundary", config::word_node("slip_wall", place));
  return strip;
}

}  // namespace

bool add_wall_strips(Node& body_fitted, const FluidSpec& fluid, const std::vector<std::size_t>& open) {
  const auto has_name = [&](const std::string& name) {
    return std::ranges::find(fluid.body_fitted, name, &BodyFittedSpec::name) != fluid.body_fitted.end();
  };
  std::vector<NearBody> near_bodies;
  for (const Side side : {Side::bottom, Side::top, Side::left, Side::right}) {
    const bool is_wall = schema::gas_boundary(fluid.boundary[static_cast<std::size_t>(side)].kind).is_wall;
    if (!is_wall || has_name(fmt::format("along_{}", name_of(side)))) continue;
    if (std::ranges::any_of(fluid.body_fitted,
                            [side](const BodyFittedSpec& ring) { return has_an_end_on(ring.curve, side); }))
      continue;
    const NearBody found = body_near(body_fitted, fluid, open, side);
    if (found.body != nullptr) near_bodies.push_back(found);
  }
  // Strips do not meet in corners: along x = const or along y = const, where the nearest body is.
  std::ranges::stable_sort(near_bodies, {}, &NearBody::distance);
  std::vector<Node> strips;
  for (const NearBody& near_body : near_bodies) {
    if (direction_of(near_body.side) == direction_of(near_bodies.front().side))
      strips.push_back(strip_along(fluid.grid, near_body.side, near_body.body->place));
  }
  body_fitted.items.insert(body_fitted.items.end(), strips.begin(), strips.end());
  return !strips.empty();
}

}  // namespace fsi
