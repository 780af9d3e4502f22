#include "common/case/check/check_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "common/case/check/given/given.hpp"
#include "common/case/check/given/sample.hpp"
#include "common/case/document/fluid_sections.hpp"
#include "common/case/document/node_at.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

constexpr double same = 1e-6;  ///< of the length of a side: more than round-off in a formula leaves

double length_of(const std::vector<Vec2>& side) {
  return (side.back() - side.front()).norm();
}

void check_mirror(const std::vector<Vec2>& first, const std::vector<Vec2>& now, double t, const Node& node,
                  const std::string& path) {
  const double length = length_of(first);
  if (!(length > 0)) fail(node.place, path, "a mirror is a straight line with two ends; write slip_wall");
  const Vec2 along = (first.back() - first.front()) / length;
  for (const Vec2& x : now) {
    const Vec2 from = x - first.front();
    const double off = std::abs(along[0] * from[1] - along[1] * from[0]);
    if (off <= same * length) continue;
    fail(node.place, path,
         fmt::format("a mirror is straight and moves along itself only; ({:.6g}, {:.6g}), t = {:.4g}, lies "
                     "{:.3g} off the line through its ends at t = 0; write slip_wall",
                     x[0], x[1], t, off));
  }
}

/// Sides of a grid that are opposite to each other.
struct Pair {
  Side low, high;
};
constexpr Pair pairs[] = {{.low = Side::left, .high = Side::right}, {.low = Side::bottom, .high = Side::top}};

void check_pair(const GridSpec& grid, const Pair& pair, double t, const Node& node, const std::string& path) {
  const std::vector<Vec2> start = sample_points(grid, pair.low, 0);
  const Vec2 period = sample_points(grid, pair.high, 0).front() - start.front();
  const std::vector<Vec2> low = sample_points(grid, pair.low, t), high = sample_points(grid, pair.high, t);
  for (std::size_t k = 0; k < low.size(); ++k) {
    const Vec2 here = high[k] - low[k];
    if ((here - period).norm() <= same * length_of(start)) continue;
    fail(node.place, path,
         fmt::format("two periodic sides lie all the time as far from each other, in one direction: ({:.6g}, "
                     "{:.6g}) at their first points, but ({:.6g}, {:.6g}) at ({:.6g}, {:.6g}), t = {:.4g}; "
                     "write another map, or another kind of side",
                     period[0], period[1], here[0], here[1], low[k][0], low[k][1], t));
  }
}

/// `times_of`: at how many times the places of a side are known.
void check_periods(const GridSpec& grid, const std::function<int(Side)>& times_of, const Case& problem,
                   const Node& node, const std::string& path) {
  for (const Pair& pair : pairs) {
    if (!grid.periodic[static_cast<std::size_t>(direction_of(pair.low))]) continue;
    for (int k = 0; k < times_of(pair.low); ++k) {
      check_pair(grid, pair, looked_at_time(problem, k), node_at(node, {"boundary", name_of(pair.low)}),
                 fmt::format("{}.boundary.{}", path, name_of(pair.low)));
    }
  }
}

bool is_mirror(const BoundarySpec& boundary) {
  return boundary.kind == BoundaryKind::symmetry;
}

/// Sides of the gas's own grid.
void check_straight_sides(const Case& problem, const FluidSpec& fluid, const Node& node) {
  for (const Side side : all_sides) {
    if (!is_mirror(fluid.boundary[static_cast<std::size_t>(side)])) continue;
    const std::vector<Vec2> first = sample_points(fluid.grid, side, 0);
    for (int k = 0; k < times_of_known_places(fluid, side); ++k) {
      const double t = looked_at_time(problem, k);
      check_mirror(first, sample_points(fluid.grid, side, t), t, node_at(node, {"boundary", name_of(side)}),
                   fmt::format("{}.boundary.{}", fluid.path, name_of(side)));
    }
  }
}

/// The grid of a list that has this name; the list itself where the file gives none.
const Node& grid_named(const Node& list, const std::string& name) {
  const auto has_name = [&](const Node& grid) { return node_at(grid, {"name"}).text == name; };
  const auto found = std::ranges::find_if(list.items, has_name);
  return found == list.items.end() ? list : *found;
}

/// Curves that are walls of the gas.
void check_straight_curves(const FluidSpec& fluid, const Node& list) {
  for (const BodyFittedSpec& grid : fluid.body_fitted) {
    if (!grid.solid.empty() || !is_mirror(grid.boundary[static_cast<std::size_t>(grid.side)])) continue;
    const std::vector<Vec2> points = outline_points(grid.curve);
    check_mirror(points, points, 0, node_at(grid_named(list, grid.name), {"boundary"}),
                 fmt::format("{}.body_fitted.{}.boundary", fluid.path, grid.name));
  }
}

}  // namespace

void check_images(const Case& problem, const Node& root) {
  for (const FluidSpec& fluid : problem.fluids) {
    const Node& node = fluid_section_of(root, fluid.name);
    check_straight_sides(problem, fluid, node);
    check_straight_curves(fluid, node_at(node, {"body_fitted"}));
    const auto times_of = [&](Side side) { return times_of_known_places(fluid, side); };
    check_periods(fluid.grid, times_of, problem, node, fluid.path);
  }
  for (const SolidSpec& solid : problem.solids)
    check_periods(
        solid.grid, [](Side) { return 1; }, problem, node_at(root, {"solids", solid.name}),
        "solids." + solid.name);
}

}  // namespace fsi
