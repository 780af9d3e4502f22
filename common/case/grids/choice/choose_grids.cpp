#include "common/case/grids/choice/choose_grids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/case/document/fluid_sections.hpp"
#include "common/case/document/reader.hpp"
#include "common/case/grids/block.hpp"
#include "common/case/grids/choice/choose_blunt.hpp"
#include "common/case/grids/choice/choose_corners.hpp"
#include "common/case/grids/choice/fit_grids.hpp"
#include "common/case/grids/choice/wall_strips.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/grids/no_grids_fit.hpp"
#include "common/case/grids/node_tools.hpp"
#include "common/case/grids/own_crossing.hpp"
#include "common/case/read/build.hpp"
#include "common/case/read/build_shape.hpp"
#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

using config::lacks;
using config::Node;
using config::number_node;
using config::word_node;

/// Does the file leave the grids of a solid open?
bool is_open(const Node& solid) {
  return solid.find("shape") != nullptr && lacks(solid.find("grid"), {"points", "spacing"});
}

/// What the file says of the grids of a body.
BodyWish wish_of(const Node& solid) {
  BodyWish wish;
  const auto number = [](const Node* section, const char* key) -> std::optional<double> {
    const Node* node = section == nullptr ? nullptr : section->find(key);
    return node == nullptr ? std::nullopt : node->number;
  };
  const Node* fitted = solid.find("body_fitted");
  if (const auto lines = number(fitted, "lines")) wish.lines = static_cast<int>(*lines);
  wish.line_spacing = number(fitted, "spacing");
  wish.growth = number(fitted, "growth").value_or(1);
  const Node& shape = *solid.find("shape");
  wish.curve_is_given = shape.find("points") != nullptr || shape.find("spacing") != nullptr;
  if (const Node* grid = solid.find("grid")) {
    const Node *x = grid->find("x"), *y = grid->find("y");
    if (x != nullptr && y != nullptr)
      wish.box = {*x->items[0].number, *x->items[1].number, *y->items[0].number, *y->items[1].number};
  }
  return wish;
}

void write_body(Node& solid, const BodyGrids& chosen) {
  const std::string place = solid.find("shape")->place;
  Node& shape = *solid.find("shape");
  if (lacks(&shape, {"points", "spacing"})) put(shape, "points", number_node(chosen.outline_points, place));
  Node& fitted = section_of(solid, "body_fitted");
  if (lacks(&fitted, {"lines"})) put(fitted, "lines", number_node(chosen.lines, place));
  if (lacks(&fitted, {"spacing", "map"}))  // `map` says itself where the lines are
    put(fitted, "spacing", number_node(chosen.line_spacing, place));
  Node& grid = section_of(solid, "grid");
  const auto pair = [&](double a, double b) {
    Node list{.kind = Node::Kind::list, .place = place, .entries = {}};
    list.items = {number_node(a, place), number_node(b, place)};
    return list;
  };
  if (grid.find("name") == nullptr) put(grid, "name", word_node("core", place));
  if (grid.find("x") == nullptr) {
    put(grid, "x", pair(chosen.core.x_a, chosen.core.x_b));
    put(grid, "y", pair(chosen.core.y_a, chosen.core.y_b));
  }
  put(grid, "points", pair(chosen.core.n1, chosen.core.n2));
}

/// Distance of points along an outline.
double spacing_of(const Node& shape, const CurveSpec& closely, double h) {
  const Node *points = shape.find("points"), *spacing = shape.find("spacing");
  if (spacing != nullptr) return *spacing->number;
  return points == nullptr ? h : closely.spacing * (closely.points() - 1) / (*points->number - 1);
}

std::string write_block(Node& solid, const std::string& name, const std::array<Vec2, 4>& corners, double h) {
  const std::string place = solid.find("shape")->place;
  const auto [n1, n2] = block_points(corners, h);
  Node points{.kind = Node::Kind::list, .place = place, .entries = {}};
  points.items = {number_node(n1, place), number_node(n2, place)};
  Node& grid = section_of(solid, "grid");
  put(grid, "kind", word_node("block", place));
  put(grid, "points", points);
  return fmt::format("solids.{}: one grid of {} x {} points from corner to corner", name, n1, n2);
}

std::string text_of(const std::string& solid, const BodyGrids& grids) {
  const GridSpec& core = grids.core;
  const auto range = [](double a, double b, int points) {
    const double spacing = (b - a) / (points - 1);
    const int digits = std::max({4, digits_for(a, spacing), digits_for(b, spacing)});
    return fmt::format("[{:.{}g}, {:.{}g}]", a, digits, b, digits);
  };
  return fmt::format(
      "solids.{}: {} points along its outline, {} lines from {:.3g} apart; grid {} x {} on {} x {}", solid,
      grids.outline_points, grids.lines, grids.line_spacing, core.n1, core.n2,
      range(core.x_a, core.x_b, core.n1), range(core.y_a, core.y_b, core.n2));
}

/// The core of an elastic body has its sides along the axes: its outline cannot end on a wall that slopes.
void refuse_slope(const CurveSpec& outline) {
  constexpr double level = 1e-6;
  if (outline.on.empty() || std::abs(outline.along[0][0] * outline.along[0][1]) <= level) return;
  throw NoGridsFit(
      {.cause = fmt::format(
           "an elastic body needs a wall that is level or upright to stand on, or an outline with four "
           "straight sides (`radius: 0`), and the wall of grid `{}` slopes",
           outline.on),
       .otherwise = "write `law: beam` for a thin one, `law: rigid`, or let it stand elsewhere"});
}

/// Of the rectangles of the gases, the largest width and the largest height; none where a gas has another grid or leaves them open.
std::optional<Vec2> largest_rectangle(Node& root) {
  Vec2 largest = Vec2::Zero();
  for (const FluidSection<Node>& fluid : fluid_sections(root)) {
    const Node* grid = fluid.node->find("grid");
    if (grid == nullptr) return std::nullopt;
    for (const int direction : {0, 1}) {
      const Node* range = grid->find(direction == 0 ? "x" : "y");
      if (range == nullptr || range->items.size() != 2 || !range->items[0].number || !range->items[1].number)
        return std::nullopt;
      largest[direction] = std::max(largest[direction], *range->items[1].number - *range->items[0].number);
    }
    if (grid->find("rotation") != nullptr) return std::nullopt;
  }
  if (largest.isZero()) return std::nullopt;  // a solid alone
  return largest;
}

/// Before anything is said of the points that grids in it would take.
void refuse_outgrown(const CurveSpec& outline, Node& root, const Node& shape, const std::string& path) {
  const std::optional<Vec2> room = largest_rectangle(root);
  if (!room) return;
  const auto n = static_cast<std::ptrdiff_t>(outline.points());
  const auto [left, right] = std::minmax_element(outline.x.begin(), outline.x.begin() + n);
  const auto [low, high] = std::minmax_element(outline.x.begin() + n, outline.x.end());
  const Vec2 size(*right - *left, *high - *low);
  constexpr double round_off = 1 + 1e-9;
  if (size[0] <= round_off * (*room)[0] && size[1] <= round_off * (*room)[1]) return;
  config::fail(
      shape.place, path,
      fmt::format(
          "the outline is {:.4g} x {:.4g} and no gas has room for it, {:.4g} x {:.4g} at the most: are its "
          "coordinates in another unit of length? write both in the same one, make it smaller or the "
          "gas's grid.x and grid.y larger",
          size[0], size[1], (*room)[0], (*room)[1]));
}

void choose_for_solids(Node& root, const Reader& reader, std::vector<std::string>& chosen) {
  Node* solids = root.find("solids");
  if (solids == nullptr) return;
  for (config::Entry& entry : solids->entries) {
    Node& solid = entry.value;
    if (!is_open(solid)) continue;
    const std::string path = fmt::format("solids.{}.shape", entry.key);
    const Node shape = *solid.find("shape");
    Node even = shape;
    std::erase_if(even.entries, [](const config::Entry& key) { return key.key == "weights"; });
    constexpr int samples = 1200;
    const Outline outline{
        .closely = build_curve(reader, even, path, samples),
        .with_points = [&](std::optional<int> points) { return build_curve(reader, shape, path, points); }};
    const std::string& law = solid.find("law")->text;
    const bool outline_only = !is_continuum(law);
    const double h = reader.scope().constants.at("h");
    refuse_own_crossing(outline.closely, shape, path);
    refuse_outgrown(outline.closely, root, shape, path);
    try {
      if (!outline_only && leaves_block_open(solid)) {
        if (const BlockCorners corners = block_corners(outline.closely); corners.at) {
          chosen.push_back(write_block(solid, entry.key, *corners.at, spacing_of(shape, outline.closely, h)));
          continue;
        }
      }
      if (!outline_only) refuse_slope(outline.closely);
      const BodyGrids grids = fit_body(outline, h, wish_of(solid), outline_only);
      write_body(solid, grids);
      chosen.push_back(text_of(entry.key, grids));
    } catch (const NoGridsFit& mistake) {
      NoGridsFit::Parts parts = mistake.parts();
      parts.place = shape.place;
      parts.key = path;
      parts.owner = "solids." + entry.key;
      throw NoGridsFit(std::move(parts));
    } catch (const UserMistake& mistake) {
      const std::string what = mistake.what();
      if (what.starts_with(shape.place.substr(0, shape.place.find(':')))) throw;  // it has its place already
      config::fail(shape.place, path, what);
    }
  }
}

/// A grid of the gas around every solid with a shape that has none. Several gases say themselves in which of
/// them a solid is.
void add_rings(Node& root) {
  Node* fluid = root.find("fluid");
  Node* solids = root.find("solids");
  if (fluid == nullptr || solids == nullptr) return;
  for (const config::Entry& solid : solids->entries) {
    const Node* shape = solid.value.find("shape");
    if (shape == nullptr) continue;
    const Node* own = fluid->find("body_fitted");
    const auto meets = [&](const Node& grid) {
      const Node* name = grid.find("solid");
      return name != nullptr && name->text == solid.key;
    };
    if (own != nullptr && std::ranges::any_of(own->items, meets)) continue;
    if (own == nullptr)
      put(*fluid, "body_fitted", {.kind = Node::Kind::list, .place = shape->place, .entries = {}});
    Node grid{.kind = Node::Kind::map, .place = shape->place, .entries = {}};
    put(grid, "name", word_node("around_" + solid.key, shape->place));
    put(grid, "solid", word_node(solid.key, shape->place));
    fluid->find("body_fitted")->items.push_back(std::move(grid));
  }
}

/// Does the file leave the points of the gas's rectangle open? A single grid says how many points it has.
bool is_background_open(const Node& fluid) {
  const Node* grid = fluid.find("grid");
  return grid != nullptr && grid->find("map") == nullptr && lacks(grid, {"points", "spacing"}) &&
         fluid.find("body_fitted") != nullptr;
}

/// Grids along curves of which the file does not say how deep they are.
std::vector<std::size_t> open_rings(const Node& list) {
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    if (lacks(&list.items[k], {"lines", "spacing", "map"})) open.push_back(k);
  }
  return open;
}

/// Of the curve of each grid of a gas.
std::vector<RingMotion> motions_of(const Case& draft, const FluidSpec& gas) {
  std::vector<RingMotion> motions;
  for (const BodyFittedSpec& ring : gas.body_fitted) {
    const auto solid = std::ranges::find(draft.solids, ring.solid, &SolidSpec::name);
    motions.push_back(ring.solid.empty() || solid == draft.solids.end() || solid->fixed ? RingMotion::still
                      : solid->law == rigid_law                                         ? RingMotion::carried
                                                : RingMotion::deforming);
  }
  return motions;
}

/// Makes the chosen points along the outlines of beams half as many again, where grids of a gas follow them: round their
/// ends cells are too long to turn. Says so; empty where none were chosen.
/// @param h spacing of the case: where points lie much closer it is not for want of them
std::vector<std::string> add_points(Node& root, const FluidSpec& gas, const std::vector<std::size_t>& open,
                                    double h) {
  constexpr double close = 0.25;
  std::vector<std::string> added;
  for (const std::size_t k : open) {
    Node* solid =
        gas.body_fitted[k].solid.empty() ? nullptr : root.find("solids")->find(gas.body_fitted[k].solid);
    if (solid == nullptr || solid->find("law")->text != beam_law) continue;
    Node* points = solid->find("shape") == nullptr ? nullptr : solid->find("shape")->find("points");
    if (points == nullptr || !points->chosen || gas.body_fitted[k].curve.spacing < close * h) continue;
    *points = number_node(std::round(1.5 * *points->number), points->place);
    added.push_back(fmt::format("solids.{}: {} points along its outline, for grids that hold while it moves",
                                gas.body_fitted[k].solid, points->text));
  }
  return added;
}

/// Grids that hold while the bodies move, with more points along their outlines where they need them.
GasGrids fit_with_points(Node& root, std::size_t index, const Scope& scope,
                         const std::vector<std::size_t>& open, bool finer, std::vector<std::string>& said) {
  constexpr int most_trials = 3;
  const auto fit = [&](const Case& draft) {
    const FluidSpec& gas = draft.fluids[index];
    return fit_rings(gas.grid, gas.body_fitted, open, motions_of(draft, gas), finer);
  };
  const Case draft = build_case(root, scope);
  const GasGrids first = fit(draft);
  if (first.lasting) return first;
  const Node solids = root.find("solids") == nullptr ? Node{} : *root.find("solids");
  for (int k = 0; k < most_trials; ++k) {
    const std::vector<std::string> added =
        add_points(root, draft.fluids[index], open, scope.constants.at("h"));
    if (added.empty()) break;
    const GasGrids more = fit(build_case(root, scope));
    if (!more.lasting) continue;
    said.insert(said.end(), added.begin(), added.end());
    return more;
  }
  if (root.find("solids") != nullptr) *root.find("solids") = solids;
  return first;
}

/// @param index of the gas among those of the case
void choose_for_gas(Node& root, std::size_t index, const Scope& scope, std::vector<std::string>& said) {
  const FluidSection<Node> fluid = fluid_sections(root)[index];
  Node* list = fluid.node->find("body_fitted");
  if (list == nullptr) return;
  const bool finer = is_background_open(*fluid.node);
  Node& background = *fluid.node->find("grid");
  if (finer) put(background, "spacing", number_node(scope.constants.at("h"), background.place));
  if (open_rings(*list).empty()) return;
  Case draft = build_case(root, scope);
  if (draft.fluids[index].grid.kind != GridSpec::Kind::rectangle) return;  // check says what is wrong with it
  if (add_wall_strips(*list, draft.fluids[index], open_rings(*list))) draft = build_case(root, scope);
  const std::vector<std::size_t> open = open_rings(*list);
  const FluidSpec& spec = draft.fluids[index];
  for (std::size_t k = 0; k < spec.body_fitted.size(); ++k) {
    const BodyFittedSpec& ring = spec.body_fitted[k];
    if (const Node* shape = list->items[k].find("shape"))
      refuse_own_crossing(ring.curve, *shape, fmt::format("{}.body_fitted[{}].shape", fluid.path, k));
    constexpr int most = 20'000;  // their distances from each other are looked at in pairs
    if (ring.curve.points() > most)
      config::fail(
          list->place, "body_fitted",
          fmt::format("an outline would have {} points, more than {}: is the body much larger than the "
                      "grid's spacing is meant for? take grid.factor smaller",
                      ring.curve.points(), most));
  }
  const GasGrids chosen = fit_with_points(root, index, scope, open, finer, said);
  if (finer) {
    put(background, "spacing", number_node(chosen.background, background.place));
    said.push_back(fmt::format("{}.grid: spacing {:.3g}", fluid.path, chosen.background));
  }
  for (std::size_t k = 0; k < open.size(); ++k) {
    Node& grid = list->items[open[k]];
    put(grid, "lines", number_node(chosen.rings[k].lines, grid.place));
    put(grid, "spacing", number_node(chosen.rings[k].spacing, grid.place));
    said.push_back(fmt::format("{}.body_fitted[{}] ({}): {} lines, {:.3g} apart", fluid.path, open[k],
                               grid.find("name")->text, chosen.rings[k].lines, chosen.rings[k].spacing));
  }
}

}  // namespace

std::vector<std::string> choose_grids(Node& root, const Scope& scope) {
  std::vector<std::string> chosen;
  choose_corners(root, Reader(root, scope), chosen);
  choose_blunt(root, Reader(root, scope), chosen);
  choose_for_solids(root, Reader(root, scope), chosen);
  add_rings(root);
  const std::size_t gases = fluid_sections(root).size();
  for (std::size_t k = 0; k < gases; ++k) choose_for_gas(root, k, scope, chosen);
  return chosen;
}

}  // namespace fsi
