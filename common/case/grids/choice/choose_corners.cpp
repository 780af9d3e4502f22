#include "common/case/grids/choice/choose_corners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "common/case/grids/block.hpp"
#include "common/case/grids/node_tools.hpp"
#include "common/case/read/build_shape.hpp"
#include "common/case/schema/laws.hpp"
#include "common/grid/shapes/smoothed_polygon.hpp"

namespace fsi {

namespace {

using config::Node;

/// A polygon as the file lists it.
struct Listed {
  std::vector<Vec2> corners;
  bool closed = true;

  std::size_t edges() const { return closed ? corners.size() : corners.size() - 1; }
  Vec2 edge(std::size_t k) const { return corners[(k + 1) % corners.size()] - corners[k]; }
  /// Has the edge a corner at both of its ends? The first and last one of an open polygon end on walls.
  bool between_corners(std::size_t k) const { return closed || (k > 0 && k + 1 < edges()); }
};

/// Nothing where the file says itself how the corners are, or the shape is no polygon.
std::optional<Listed> left_open(const Node& shape) {
  const Node* corners = shape.find("corners");
  if (corners == nullptr || shape.find("radius") != nullptr || shape.find("sharpness") != nullptr)
    return std::nullopt;
  Listed polygon{.corners = {}, .closed = shape.find("walls") == nullptr};
  for (const Node& pair : corners->items)
    polygon.corners.emplace_back(*pair.items[0].number, *pair.items[1].number);
  return polygon;
}

/// The shortest edge between two corners, in widths of the usual rounding.
double shortest_in_widths(const Listed& polygon) {
  double total = 0, shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.edges(); ++k) {
    const double length = polygon.edge(k).norm();
    total += length;
    if (polygon.between_corners(k)) shortest = std::min(shortest, length);
  }
  const double width = total / grid::SmoothedPolygon{}.sharpness;
  return shortest / width;
}

/// It turns the same way at all of its corners.
bool is_convex(const Listed& polygon) {
  double least = 0, most = 0;
  for (std::size_t k = 0; k + (polygon.closed ? 0 : 1) < polygon.edges(); ++k) {
    const Vec2 in = polygon.edge(k), out = polygon.edge((k + 1) % polygon.edges());
    const double turn = in[0] * out[1] - in[1] * out[0];
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  return least == 0 || most == 0;
}

/// An elastic body with sharp corners has one grid from corner to corner, or none.
bool becomes_block(const Reader& reader, const Node& shape, const std::string& path) {
  constexpr int samples = 1200;
  return block_corners(build_curve(reader, shape, path, samples)).at.has_value();
}

}  // namespace

void choose_corners(Node& root, const Reader& reader, std::vector<std::string>& chosen) {
  Node* solids = root.find("solids");
  if (solids == nullptr) return;
  for (config::Entry& entry : solids->entries) {
    Node* shape = entry.value.find("shape");
    const std::optional<Listed> polygon = shape == nullptr ? std::nullopt : left_open(*shape);
    constexpr double separate = 2;  // widths between two bends that are not one
    if (!polygon || !is_convex(*polygon) || shortest_in_widths(*polygon) >= separate) continue;
    Node sharp = *shape;
    config::put(sharp, "radius", config::number_node(0, shape->place));
    const std::string path = fmt::format("solids.{}.shape", entry.key);
    if (is_continuum(entry.value.find("law")->text) &&
        (!leaves_block_open(entry.value) || !becomes_block(reader, sharp, path)))
      continue;
    *shape = std::move(sharp);
    chosen.push_back(fmt::format(
        "{}: radius 0, sharp corners: its shortest edge is thinner than the usual rounding", path));
  }
}

}  // namespace fsi
