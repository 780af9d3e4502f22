#include "common/case/read/build_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "common/case/document/fluid_sections.hpp"
#include "common/case/grids/curve_side.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/read/build_walls.hpp"
#include "common/case/shapes/every_shape.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/input/text_file.hpp"
#include "common/grid/shapes/blunted.hpp"
#include "common/grid/shapes/plane_curve.hpp"
#include "common/grid/shapes/spline.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

grid::PlaneCurve curve_of(const Node& shape, bool closed, const std::string& path) {
  const std::string& kind = shape.find("kind")->text;
  const auto number = std::ranges::find(shapes::shape_names, kind) - shapes::shape_names.begin();
  if (!closed && !shapes::shape_facts[static_cast<std::size_t>(number)].may_be_open)
    fail(shape.find("walls")->place, path + ".walls", fmt::format("a {} has no ends; leave them out", kind));
  const grid::Curve ends = closed ? grid::Curve::closed : grid::Curve::open;
  return shapes::curve_of(kind, {.node = shape, .path = path, .ends = ends});
}

/// The curve, its sharpest ends cut off.
grid::PlaneCurve blunted_curve(const Reader& reader, const Node& shape, bool closed,
                               const std::string& path) {
  const grid::PlaneCurve curve = curve_of(shape, closed, path);
  double width = usual_blunt * reader.scope().constants.at("h");
  Reader::assign(shape, "blunt", width);
  return grid::blunted(curve, width);
}

std::vector<grid::PointWeight> weights_of(const Node& shape) {
  std::vector<grid::PointWeight> weights;
  if (const Node* list = shape.find("weights")) {
    for (const Node& item : list->items) {
      weights.push_back(
          {*item.find("strength")->number, *item.find("sharpness")->number, *item.find("place")->number});
    }
  }
  return weights;
}

int count_of(const Reader& reader, const Node& shape, double length, bool closed, const std::string& path) {
  const Node *points = shape.find("points"), *spacing = shape.find("spacing");
  if (points != nullptr && spacing != nullptr)
    fail(spacing->place, path, "give `points` or `spacing`, one of them");
  if (points != nullptr) return static_cast<int>(*points->number);
  const double h = spacing != nullptr ? *spacing->number : reader.scope().constants.at("h");
  constexpr double fewest = 8, most = 1e4;
  const double cells = std::round(length / h);
  if (!(cells >= fewest && cells <= most)) {
    fail(spacing != nullptr ? spacing->place : shape.place, path,
         fmt::format("points {:.4g} apart on a {} of length {:.4g} are {:.4g}; {} to {} are possible", h,
                     closed ? "closed curve" : "curve", length, cells, fewest, most));
  }
  return static_cast<int>(cells) + 1;
}

/// The rectangle of the gas that a curve bounds, x_a, x_b, y_a, y_b, where the case has one: of several gases
/// the one whose rectangle is nearest to the curve's first point.
std::optional<std::array<double, 4>> gas_rectangle(const Reader& reader, const CurveSpec& curve) {
  std::optional<std::array<double, 4>> nearest;
  double least = std::numeric_limits<double>::infinity();
  const Vec2 point(curve.x.front(), curve.x[curve.x.size() / 2]);
  for (const auto& section : fluid_sections(reader.root())) {
    const Node* grid = section.node->find("grid");
    const Node *x = grid == nullptr ? nullptr : grid->find("x"),
               *y = grid == nullptr ? nullptr : grid->find("y");
    if (x == nullptr || y == nullptr) continue;
    const std::array rectangle{*x->items[0].number, *x->items[1].number, *y->items[0].number,
                               *y->items[1].number};
    const Vec2 inside(std::clamp(point[0], rectangle[0], std::max(rectangle[0], rectangle[1])),
                      std::clamp(point[1], rectangle[2], std::max(rectangle[2], rectangle[3])));
    const double distance = (point - inside).norm();
    if (!(distance < least)) continue;
    least = distance;
    nearest = rectangle;
  }
  return nearest;
}

/// What a solid's `body_fitted` and an entry of the gas's have in common.
BodyFittedSpec build_fitted(const Reader& reader, const Node* node, CurveSpec curve,
                            const std::string& name) {
  BodyFittedSpec grid;
  grid.name = name;
  grid.curve = std::move(curve);
  grid.spacing = reader.scope().constants.at("h");
  if (node == nullptr) return grid;
  Reader::assign(*node, "lines", grid.lines);
  Reader::assign(*node, "spacing", grid.spacing);
  Reader::assign(*node, "growth", grid.growth);
  Reader::assign(*node, "concave_smoothing", grid.concave_smoothing);
  if (const Node* map = node->find("map")) {
    grid.map = reader.vector(*map);
    for (const char* key : {"spacing", "growth", "concave_smoothing"}) {
      if (const Node* own = node->find(key))
        fail(own->place, key,
             "belongs to a grid that is marched from its curve; `map` says where its lines are");
    }
    if (grid.map->c1.uses("t") || grid.map->c2.uses("t"))
      fail(map->place, "map", "must not depend on t: the grid moves with its curve");
  }
  return grid;
}

/// The curve's side gets its own condition, the ends of an open curve those of the walls they slide on.
void assign_boundaries(BodyFittedSpec& grid, const BoundarySpec& on_curve,
                       const std::array<BoundarySpec, 4>& background) {
  grid.boundary.fill({.kind = BoundaryKind::none});
  grid.boundary[static_cast<std::size_t>(grid.side)] = on_curve;
  if (grid.curve.closed()) {
    for (const Side side : {Side::left, Side::right}) {
      grid.boundary[static_cast<std::size_t>(side)].kind = BoundaryKind::periodic;
    }
    return;
  }
  for (const Side side : {Side::left, Side::right}) {
    const auto end = static_cast<std::size_t>(side);
    grid.boundary[end] = background[static_cast<std::size_t>((*grid.curve.walls)[end])];
  }
}

/// The ends of curves that stand on the wall of another grid get that wall's condition.
void assign_ends_on_walls(std::vector<BodyFittedSpec>& grids) {
  for (BodyFittedSpec& grid : grids) {
    const auto wall = std::ranges::find(grids, grid.curve.on, &BodyFittedSpec::name);
    if (grid.curve.on.empty() || wall == grids.end()) continue;
    for (const Side side : {Side::left, Side::right})
      grid.boundary[static_cast<std::size_t>(side)] = wall->boundary[static_cast<std::size_t>(wall->side)];
  }
}

/// What holds on the curve.
BoundarySpec boundary_or(const Reader& reader, const Owner& owner, const Node* node, const std::string& path,
                         BoundaryKind fallback) {
  const Node* boundary = node == nullptr ? nullptr : node->find("boundary");
  if (boundary == nullptr) return {.kind = fallback};
  BoundarySpec spec = build_boundary(reader, owner, *boundary, path + ".boundary");
  if (spec.kind == BoundaryKind::periodic)
    fail(boundary->place, path + ".boundary", "a curve has no opposite side with which it could be periodic");
  if (spec.kind == BoundaryKind::interface && owner.is_gas)
    fail(boundary->place, path + ".boundary",
         "the gas meets a solid along that solid's outline; write `solid: NAME` in place of `shape`");
  return spec;
}

const SolidSpec& solid_named(const std::vector<SolidSpec>& solids, const Node& name,
                             const std::string& path) {
  const auto found = std::ranges::find(solids, name.text, &SolidSpec::name);
  if (found != solids.end()) return *found;
  std::vector<std::string> names;
  for (const SolidSpec& solid : solids) names.push_back(solid.name);
  fail(name.place, path + ".solid",
       fmt::format("there is no solid {}{}", in_ticks(name.text), did_you_mean(name.text, names)));
}

/// Number of points a grid at a solid has of its own.
std::optional<int> own_points(const Node& node) {
  const Node* points = node.find("points");
  return points == nullptr ? std::nullopt : std::optional(static_cast<int>(*points->number));
}

/// The outline of a solid, with points of its own where the grid at it asks for them.
CurveSpec outline_of(const Reader& reader, const Node& node, const SolidSpec& solid) {
  const std::optional<int> points = own_points(node);
  if (!points) return solid.body_fitted.front().curve;
  const Node& shape = *reader.root().find("solids")->find(solid.name)->find("shape");
  return build_curve(reader, shape, fmt::format("solids.{}.shape", solid.name), points);
}

/// The gas's grid at a solid: along its outline, or from wall to wall along its interface side, in the
/// order of the side's points.
BodyFittedSpec build_grid_at_solid(const Reader& reader, const Owner& owner, const Node& node,
                                   const std::string& path, const SolidSpec& solid) {
  const std::string name = node.find("name")->text;
  CurveSpec curve{.x = {}, .spacing = reader.scope().constants.at("h")};
  read_walls(node, path, curve);
  if (!solid.body_fitted.empty()) {
    if (curve.walls)
      fail(node.find("walls")->place, path + ".walls", "the outline of the solid has its own; leave it out");
    BodyFittedSpec grid = build_fitted(reader, &node, outline_of(reader, node, solid), name);
    grid.side = Side::top;
    return grid;
  }
  const std::optional<Side> meets = side_to(solid, owner.name);
  if (!meets || !curve.walls) {
    fail(
        node.place, path,
        fmt::format(
            "solid {} has no `shape`: a grid along its interface side needs that side and `walls: [.., ..]`, "
            "the sides of the background on which its ends lie",
            in_ticks(solid.name)));
  }
  const Side side = *meets;
  curve.x = points_on_side(solid.grid, side, own_points(node).value_or(points_along(solid.grid, side)));
  BodyFittedSpec grid = build_fitted(reader, &node, std::move(curve), name);
  grid.side = side == Side::right || side == Side::bottom ? Side::top : Side::bottom;
  return grid;
}

BodyFittedSpec build_gas_grid(const Reader& reader, const Owner& owner, const Node& node,
                              const std::string& path, const std::vector<SolidSpec>& solids) {
  const Node *solid = node.find("solid"), *shape = node.find("shape");
  if ((solid == nullptr) == (shape == nullptr))
    fail(node.place, path, "give `solid` or `shape`, one of them");
  const std::string name = node.find("name")->text;
  if (solid != nullptr) {
    for (const char* key : {"boundary", "inside"}) {
      if (const Node* own = node.find(key))
        fail(own->place, path, fmt::format("`{}` belongs to `shape`; a solid's outline has its own", key));
    }
    BodyFittedSpec grid = build_grid_at_solid(reader, owner, node, path, solid_named(solids, *solid, path));
    grid.solid = solid->text;
    return grid;
  }
  for (const char* key : {"walls", "points"}) {
    if (const Node* own = node.find(key))
      fail(own->place, fmt::format("{}.{}", path, key),
           "belongs to a grid at a solid; write it into `shape`");
  }
  bool inside = false;
  Reader::assign(node, "inside", inside);
  BodyFittedSpec grid = build_fitted(reader, &node, build_curve(reader, *shape, path + ".shape"), name);
  grid.side = inside ? Side::bottom : Side::top;
  return grid;
}

}  // namespace

CurveSpec build_curve(const Reader& reader, const Node& shape, const std::string& path,
                      std::optional<int> wanted) {
  CurveSpec result;
  read_walls(shape, path, result);
  try {
    const grid::PlaneCurve curve = blunted_curve(reader, shape, result.closed(), path);
    const double length = grid::length_of(curve);
    const int points = wanted ? *wanted : count_of(reader, shape, length, result.closed(), path);
    const std::vector<double> s = grid::distribute(curve, points, weights_of(shape));
    result.x = grid::points_at(curve, s);
    result.corners = grid::corners_among(curve, s);
    result.spacing = length / (points - 1);
    put_body_to_the_left(result, gas_rectangle(reader, result));
  } catch (const UserMistake& mistake) {
    const std::string what = mistake.what();
    if (what.starts_with(shape.place.substr(0, shape.place.find(':')))) throw;  // it has its place already
    fail(shape.place, path, what);
  }
  stand_on_wall(reader, shape, path, result);
  return result;
}

std::vector<BodyFittedSpec> build_outline_grid(const Reader& reader, const Owner& owner,
                                               const std::array<BoundarySpec, 4>& boundary) {
  const Node *shape = owner.node.find("shape"), *node = owner.node.find("body_fitted");
  if (shape == nullptr) {
    if (node != nullptr)
      fail(node->place, owner.path + ".body_fitted", "belongs to `shape`, which is missing");
    return {};
  }
  BodyFittedSpec grid =
      build_fitted(reader, node, build_curve(reader, *shape, owner.path + ".shape"), "outline");
  grid.side = Side::bottom;
  const std::string path = owner.path + ".body_fitted";
  assign_boundaries(grid, boundary_or(reader, owner, node, path, BoundaryKind::interface), boundary);
  return {std::move(grid)};
}

std::vector<BodyFittedSpec> build_fitted_grids(const Reader& reader, const Owner& owner,
                                               const std::array<BoundarySpec, 4>& boundary,
                                               const std::vector<SolidSpec>& solids) {
  std::vector<BodyFittedSpec> result;
  const Node* list = owner.node.find("body_fitted");
  if (list == nullptr) return result;
  for (std::size_t k = 0; k < list->items.size(); ++k) {
    const Node& node = list->items[k];
    const std::string path = fmt::format("{}.body_fitted[{}]", owner.path, k);
    BodyFittedSpec grid = build_gas_grid(reader, owner, node, path, solids);
    BoundarySpec on_curve = boundary_or(reader, owner, &node, path, BoundaryKind::slip_wall);
    if (!grid.solid.empty()) on_curve = {.kind = BoundaryKind::interface, .solid = grid.solid};
    assign_boundaries(grid, on_curve, boundary);
    if (std::ranges::find(result, grid.name, &BodyFittedSpec::name) != result.end()) {
      fail(node.find("name")->place, path + ".name",
           fmt::format("there are two grids {}; choose another name", in_ticks(grid.name)));
    }
    result.push_back(std::move(grid));
  }
  assign_ends_on_walls(result);
  return result;
}

namespace {

/// The unit that the first lines of a file name for its columns where it is not m, as x_mm, x [mm] and x/mm do; "": none.
std::string unit_of_columns(const std::string& text) {
  static const std::regex column(R"((^|[^a-z])x[a-z0-9]*\s*[_/(\[]\s*(um|µm|mm|cm|km|in|ft)([^a-z]|$))",
                                 std::regex::icase);
  std::istringstream lines(text);
  constexpr std::string_view number = "+-.0123456789";
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first != std::string::npos && number.find(line[first]) != std::string_view::npos) break;
    constexpr std::size_t longest = 200;  // of a heading
    line.resize(std::min(line.size(), longest));
    if (std::smatch found; std::regex_search(line, found, column)) return found[2];
  }
  return "";
}

/// `through: [[x, y], ..]` in the place of `file: NAME` in the shape at `owner`.
void inline_points(Node& shape, const std::string& owner, const std::string& folder, bool in_metres) {
  for (config::Entry& entry : shape.entries) {
    if (entry.key != "file" || !entry.value.is_scalar()) continue;
    if (shape.find("through") != nullptr)
      fail(entry.value.place, owner + ".file",
           "goes in the place of `through`, which is given too; leave out one of them");
    const std::string path = (std::filesystem::path(folder) / entry.value.text).string();
    const TextFile file = read_text_file(path, config::longest_file);
    if (!file.trouble.empty()) {
      fail(entry.value.place, owner + ".file",
           fmt::format("{} {}; its path counts from the folder of the case file", in_ticks(path),
                       file.trouble));
    }
    if (const std::string unit = unit_of_columns(file.text); in_metres && !unit.empty()) {
      fail(entry.value.place, owner + ".file",
           fmt::format(
               "the heading of {} says {}, but with `units: SI` its numbers are metres: write them so, "
               "and m in the heading (`fsi new NAME --outline FILE` does)",
               in_ticks(path), unit));
    }
    Node list{.kind = Node::Kind::list, .place = entry.value.place, .entries = {}};
    const std::vector<Vec2> points = grid::points_from_csv(file.text, path);
    if (points.size() > config::most_items) {
      fail(entry.value.place, owner + ".file",
           fmt::format("{} has {} points; at most {} are possible: keep one in {}", in_ticks(path),
                       points.size(), config::most_items, (points.size() - 1) / config::most_items + 1));
    }
    for (const Vec2& point : points) {
      Node pair{.kind = Node::Kind::list, .place = entry.value.place, .entries = {}};
      for (const double x : {point[0], point[1]}) {
        pair.items.push_back({.kind = Node::Kind::scalar,
                              .place = entry.value.place,
                              .text = fmt::format("{}", x),
                              .entries = {}});
      }
      list.items.push_back(std::move(pair));
    }
    entry = {.key = "through", .place = entry.place, .value = std::move(list)};
  }
}

}  // namespace

void inline_point_files(Node& root, const std::string& folder) {
  const Node* units = root.find("units");
  const bool in_metres = units != nullptr && units->text == "SI";
  if (Node* solids = root.find("solids")) {
    for (config::Entry& solid : solids->entries) {
      if (Node* shape = solid.value.find("shape"))
        inline_points(*shape, fmt::format("solids.{}.shape", solid.key), folder, in_metres);
    }
  }
  for (const FluidSection<Node>& fluid : fluid_sections(root)) {
    Node* grids = fluid.node->find("body_fitted");
    if (grids == nullptr) continue;
    for (std::size_t k = 0; k < grids->items.size(); ++k) {
      if (Node* shape = grids->items[k].find("shape"))
        inline_points(*shape, fmt::format("{}.body_fitted[{}].shape", fluid.path, k), folder, in_metres);
    }
  }
}

}  // namespace fsi
