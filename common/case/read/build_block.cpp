#include "common/case/read/build_block.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/case/grids/block.hpp"
#include "common/case/grids/no_grids_fit.hpp"
#include "common/case/grids/node_tools.hpp"
#include "common/case/read/build_shape.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// Of a body; its width is looked for among all pairs of them.
constexpr int most_points_around = 20'000;

std::array<int, 2> points_of_block(const Node& grid, const std::array<Vec2, 4>& corners,
                                   const std::string& path) {
  const Node *points = grid.find("points"), *spacing = grid.find("spacing");
  if ((points == nullptr) == (spacing == nullptr))
    fail(grid.place, path, "give `points: [.., ..]` or `spacing`, one of them");
  if (spacing != nullptr) return block_points(corners, *spacing->number);
  return {static_cast<int>(*points->items[0].number), static_cast<int>(*points->items[1].number)};
}

/// Points or spacing of a grid, as they are written.
struct PointsAlone {
  std::string key;
  std::vector<std::string> values;

  std::string text() const {
    return key == "spacing" ? "spacing: " + values[0] : fmt::format("points: [{}]", fmt::join(values, ", "));
  }
  PointsAlone turned() const { return {key, {values.rbegin(), values.rend()}}; }
};

/// Nothing of a grid that says where it is.
std::optional<PointsAlone> points_alone(const Node& grid) {
  if (!grid.is_map() || !config::lacks(&grid, {"x", "y", "map", "kind"})) return std::nullopt;
  if (const Node* spacing = grid.find("spacing")) return PointsAlone{"spacing", {spacing->text}};
  const Node* points = grid.find("points");
  if (points == nullptr || points->items.size() != 2) return std::nullopt;
  return PointsAlone{"points", {points->items[0].text, points->items[1].text}};
}

OtherChoice as_block(const PointsAlone& points, const std::string& owner, bool sharpened) {
  OtherChoice choice{
      .words = fmt::format("write `grid: {{kind: block, {}}}`, from corner to corner of `shape`{}",
                           points.text(), sharpened ? ", and its corners sharp, `radius: 0`" : ""),
      .written = {{owner + ".grid.kind", "block"}}};
  for (std::size_t k = 0; points.key == "points" && k < points.values.size(); ++k)
    choice.written.emplace_back(fmt::format("{}.grid.points.{}", owner, k), points.values[k]);
  if (sharpened) {
    choice.written.emplace_back(owner + ".shape.radius", "0");
    choice.left_out.push_back(owner + ".shape.sharpness");
  }
  return choice;
}

GridSpec build_block(const Reader& reader, const Owner& owner, const Node& node) {
  const std::string path = owner.path + ".grid";
  const Node* shape = owner.node.find("shape");
  if (shape == nullptr)
    fail(node.place, path, "a block lies between the sides of a `shape`, which is missing");
  if (const Node* turn = node.find("rotation"))
    fail(turn->place, path + ".rotation", "a block lies as its `shape` does; leave it out");
  constexpr int samples = 1200;
  const BlockCorners corners = block_corners(build_curve(reader, *shape, owner.path + ".shape", samples));
  if (!corners.at)
    fail(node.place, path,
         fmt::format(
             "`kind: block` is for an outline of four straight sides with sharp corners, but {}; leave "
             "out `grid`, which is then chosen",
             corners.why_not));
  GridSpec grid;
  grid.kind = GridSpec::Kind::block;
  grid.name = owner.name;
  grid.corners = *corners.at;
  Reader::assign(node, "name", grid.name);
  const auto [n1, n2] = points_of_block(node, *corners.at, path);
  if (2 * (n1 + n2) > most_points_around)
    fail(
        node.place, path,
        fmt::format(
            "{} x {} points are more than {} around the body; take a larger spacing (or grid.factor smaller)",
            n1, n2, most_points_around));
  grid.n1 = n1;
  grid.n2 = n2;
  return grid;
}

}  // namespace

void refuse_points_of_no_rectangle(const Node& root) {
  const Node* solids = root.find("solids");
  if (solids == nullptr || !solids->is_map()) return;
  for (const config::Entry& solid : solids->entries) {
    const Node *shape = solid.value.find("shape"), *grid = solid.value.find("grid");
    const std::optional<PointsAlone> points =
        shape == nullptr || grid == nullptr ? std::nullopt : points_alone(*grid);
    if (!points) continue;
    const std::string owner = "solids." + solid.key;
    throw NoGridsFit(
        {.place = grid->place,
         .key = owner + ".grid",
         .cause = fmt::format("`{}` says not where: `x` and `y` of a rectangle around `shape` are missing",
                              points->text()),
         .otherwise = "give `x: [.., ..]` and `y: [.., ..]` too",
         .owner = owner,
         .choices = {as_block(*points, owner, false), as_block(*points, owner, true),
                     as_block(points->turned(), owner, false), as_block(points->turned(), owner, true)}});
  }
}

GridSpec build_solid_grid(const Reader& reader, const Owner& owner) {
  const Node* node = owner.node.find("grid");
  const Node* kind = node == nullptr ? nullptr : node->find("kind");
  return kind != nullptr && kind->text == "block" ? build_block(reader, owner, *node)
                                                  : build_grid(reader, owner);
}

void complete_block(const Node& node, const std::string& path, SolidSpec& solid) {
  if (!is_block(solid)) return;
  if (const Node* fitted = node.find("body_fitted")) {
    for (const config::Entry& entry : fitted->entries) {
      if (entry.key == "boundary") continue;
      fail(entry.place, fmt::format("{}.body_fitted.{}", path, entry.key),
           "belongs to a grid along the outline, but a block has one grid; leave it out");
    }
  }
  BodyFittedSpec& outline = solid.body_fitted.front();
  outline.curve = block_outline(solid.grid, outline.curve);
  for (const Side side : sides_along(outline.curve))
    solid.boundary[static_cast<std::size_t>(side)] = outline.boundary[static_cast<std::size_t>(outline.side)];
}

}  // namespace fsi
