#include "common/case/grids/overlap_advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/case/grids/composite_from_case.hpp"
#include "common/core/failure.hpp"
#include "common/grid/geometry/near_curves.hpp"
#include "common/grid/geometry/outline.hpp"

namespace fsi {

namespace {

using config::Node;

/// Rules of docs/theory_grids.md, "Grids in a body".
constexpr double core_by_depth = 0.2;
constexpr int fewest_lines = 5;

grid::Bend bend_of(const BodyFittedSpec& spec) {
  return grid::sharpest_bend(spec.curve.x, spec.curve.closed() ? grid::Curve::closed : grid::Curve::open,
                             spec.side == Side::bottom ? 1 : -1, spec.curve.corners);
}

double spacing_of(const GridSpec& grid) {
  return std::max((grid.x_b - grid.x_a) / (grid.n1 - 1), (grid.y_b - grid.y_a) / (grid.n2 - 1));
}

/// The same rectangle with points as far apart as `spacing` of the case file puts them.
GridSpec refined(GridSpec grid, double spacing) {
  grid.n1 = static_cast<int>(std::round((grid.x_b - grid.x_a) / spacing)) + 1;
  grid.n2 = static_cast<int>(std::round((grid.y_b - grid.y_a) / spacing)) + 1;
  return grid;
}

std::vector<BodyFittedSpec> with_lines(std::vector<BodyFittedSpec> specs, int lines) {
  for (BodyFittedSpec& spec : specs) spec.lines = std::min(spec.lines, lines);
  return specs;
}

/// The spacing of the background, rounded down to two digits, that connects the grids.
std::optional<double> finer_background(const OverlapCheck& check) {
  const double now = spacing_of(check.background);
  for (const double part : {0.85, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2}) {
    const double unit = std::pow(10, std::floor(std::log10(part * now)) - 1);
    const double spacing = std::floor(part * now / unit) * unit;
    const auto connects_at = [&](double h) {
      return connects(refined(check.background, h), check.body_fitted);
    };
    constexpr double margin = 0.9;  // no lucky hit: a finer one does, too
    if (connects_at(spacing) && connects_at(margin * spacing)) return spacing;
  }
  return std::nullopt;
}

/// Lines of a grid that is as deep as its curve's bends allow.
int lines_by_radius(const BodyFittedSpec& spec) {
  const double deepest = depth_by_radius * bend_of(spec).radius;
  BodyFittedSpec grid = spec;
  while (grid.lines > fewest_lines && depth_of(grid) > deepest) --grid.lines;
  return grid.lines;
}

/// The number of lines, if fewer do.
std::optional<int> fewer_lines(const OverlapCheck& check) {
  int most = fewest_lines, lines = fewest_lines;
  for (const BodyFittedSpec& spec : check.body_fitted) {
    most = std::max(most, spec.lines - 1);
    lines = std::max(lines, lines_by_radius(spec));
  }
  for (lines = std::min(lines, most); lines >= fewest_lines; --lines) {
    if (connects(check.background, with_lines(check.body_fitted, lines))) return lines;
  }
  return std::nullopt;
}

std::string name_of_curve(const BodyFittedSpec& spec) {
  return spec.solid.empty() ? fmt::format("the shape of grid `{}`", spec.name)
                            : fmt::format("solid `{}`", spec.solid);
}

Vec2 without_noise(const Vec2& x, double unit) {
  return (unit * (x / unit).array().round() + 0.0).matrix();  // + 0: no -0
}

/// Two curves in the gas between which there is less than nothing can be computed with.
std::optional<Advice> almost_touching(const OverlapCheck& check, const Node& list) {
  const double least = grid::NearCurves::fewest_cells * spacing_of(check.background);
  for (std::size_t k = 1; k < check.body_fitted.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) {
      const BodyFittedSpec &a = check.body_fitted[k], &b = check.body_fitted[l];
      const grid::Gap gap = grid::gap_between(a.curve.x, b.curve.x);
      constexpr double touching = 1e-6;  // one stands on the other
      if (gap.distance >= least || gap.distance <= touching * least) continue;
      const Vec2 x = without_noise(gap.x, 1e-2 * least);
      constexpr double margin = 1.05;  // of the three digits
      return Advice{.node = list.items[k],
                    .path = fmt::format("{}.body_fitted[{}]", check.path, k),
                    .text = fmt::format("move them {:.3g} apart, {} of a cell of {}.grid", margin * least,
                                        grid::NearCurves::fewest_cells, check.path),
                    .fact = fmt::format("{} and {} are {:.3g} apart at ({:.6g}, {:.6g})", name_of_curve(a),
                                        name_of_curve(b), gap.distance, x[0], x[1]),
                    .missing = least - gap.distance};
    }
  }
  return std::nullopt;
}

/// Two curves in the gas nearer to each other than their grids are deep.
std::optional<Advice> too_near(const OverlapCheck& check, const Node& list) {
  const double h = spacing_of(check.background);
  std::optional<Advice> advice;
  double shortest = 0;
  for (std::size_t k = 1; k < check.body_fitted.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l) {
      const BodyFittedSpec &a = check.body_fitted[k], &b = check.body_fitted[l];
      if (a.curve.on == b.name || b.curve.on == a.name) continue;  // one stands on the other
      const grid::Gap gap = grid::gap_between(a.curve.x, b.curve.x);
      const double needed = depth_of(a) + depth_of(b) + 2 * h;
      if (needed - gap.distance <= shortest) continue;
      shortest = needed - gap.distance;
      const Vec2 x = without_noise(gap.x, 1e-6 * h);
      advice.emplace(Advice{
          .node = list.items[k],
          .path = fmt::format("{}.body_fitted[{}]", check.path, k),
          .text = fmt::format("move them {:.3g} apart", needed),
          .fact = fmt::format("{} and {} are {:.3g} apart at ({:.6g}, {:.6g}), and their grids are {:.3g} "
                              "and {:.3g} deep",
                              name_of_curve(a), name_of_curve(b), gap.distance, x[0], x[1], depth_of(a),
                              depth_of(b)),
          .missing = shortest});
    }
  }
  return advice;
}

/// A closed curve nearer to a side of the gas's rectangle than its grid is deep.
std::optional<Advice> too_near_to_side(const OverlapCheck& check, const Node& list) {
  const GridSpec& gas = check.background;
  const double h = spacing_of(gas);
  for (std::size_t k = 0; k < check.body_fitted.size(); ++k) {
    const BodyFittedSpec& spec = check.body_fitted[k];
    if (!spec.curve.closed()) continue;
    const auto n = static_cast<std::size_t>(spec.curve.points());
    double distance = std::numeric_limits<double>::infinity();
    Vec2 nearest = Vec2::Zero();
    for (std::size_t m = 0; m < n; ++m) {
      const double x = spec.curve.x[m], y = spec.curve.x[n + m];
      const double here = std::min({x - gas.x_a, gas.x_b - x, y - gas.y_a, gas.y_b - y});
      if (here < distance) distance = here, nearest = {x, y};
    }
    if (distance >= depth_of(spec) + 2 * h) continue;
    const Vec2 x = without_noise(nearest, 1e-6 * h);
    return Advice{.node = list.items[k],
                  .path = fmt::format("{}.body_fitted[{}]", check.path, k),
                  .text = fmt::format("leave {:.3g} between them", depth_of(spec) + 2 * h),
                  .fact = fmt::format(
                      "{} is {:.3g} from the rim of {}.grid at ({:.6g}, {:.6g}), and its grid is {:.3g} deep",
                      name_of_curve(spec), distance, check.path, x[0], x[1], depth_of(spec)),
                  .missing = depth_of(spec) + 2 * h - distance};
  }
  return std::nullopt;
}

/// A curve that bends more sharply than its grid is deep.
std::optional<Advice> too_sharp(const OverlapCheck& check, const Node& place, const std::string& path) {
  for (const BodyFittedSpec& spec : check.body_fitted) {
    const grid::Bend bend = bend_of(spec);
    if (depth_of(spec) <= depth_by_radius * bend.radius) continue;
    return Advice{.node = place,
                  .path = path,
                  .text = fmt::format(
                      "give it `lines` and a `spacing` with which it is at most {} of that radius deep, "
                      "(lines - 1) * spacing = {:.2g}, or round the curve more",
                      depth_by_radius, depth_by_radius * bend.radius),
                  .fact = fmt::format("grid `{}` is {:.3g} deep, and its curve bends with a radius of {:.3g} "
                                      "at ({:.6g}, {:.6g})",
                                      spec.name, depth_of(spec), bend.radius, bend.x[0], bend.x[1])};
  }
  return std::nullopt;
}

/// Grids that connect with a finer background: that is the remedy, fewer lines the other one.
std::optional<Advice> by_trial(const OverlapCheck& check, const Node& place, const std::string& path) {
  const std::optional<double> spacing = finer_background(check);
  const std::optional<int> lines = fewer_lines(check);
  const Node& grid = *check.owner.find("grid");
  const std::string fewer = lines ? fmt::format("`lines: {}` in {}.body_fitted", *lines, check.path) : "";
  if (!spacing && !lines) return std::nullopt;
  if (!spacing) return Advice{.node = place, .path = path, .text = "write " + fewer, .tried = true};
  return Advice{.node = grid,
                .path = check.path + ".grid",
                .text = fmt::format("write `spacing: {:.2g}` (now {:.3g}), or `points` to match{}{}",
                                    *spacing, spacing_of(check.background), lines ? ", or " : "", fewer),
                .fact = "the points of `grid` are too far apart for the grid along the outline",
                .tried = true};
}

/// The file gives the grids of this solid, and `choose_grids` would have chosen others.
bool gives_grids(const OverlapCheck& check) {
  const Node* points = check.owner.find("grid")->find("points");
  return points == nullptr || points->items.empty() || !points->items.front().chosen;
}

/// For grids that are given.
Advice other_numbers(const OverlapCheck& check, const Node& place, const std::string& path) {
  if (const auto advice = by_trial(check, place, path)) return *advice;
  if (const auto advice = too_sharp(check, place, path)) return *advice;
  return {.node = place,
          .path = path,
          .text = fmt::format("change `lines`, `spacing` or the shape; points of {}.grid about {} of the "
                              "depth of the grid along the outline apart leave room for both",
                              check.path, core_by_depth)};
}

Advice advice_for_solid(const OverlapCheck& check, const Node& shape) {
  if (!gives_grids(check)) {
    return {.node = shape,
            .path = check.path + ".shape",
            .text = "round it more, there and where it meets a wall",
            .fact = "no grids inside this outline were found that fit"};
  }
  const Node* fitted = check.owner.find("body_fitted");
  return other_numbers(check, fitted != nullptr ? *fitted : shape,
                       fmt::format("{}.{}", check.path, fitted != nullptr ? "body_fitted" : "shape"));
}

/// Does the file leave the lines of this grid of the gas open?
bool is_chosen(const Node& grid) {
  const Node* spacing = grid.find("spacing");
  return spacing != nullptr && spacing->chosen;
}

/// Lines that are too far apart for a bend, so that they fold before anything else is seen of them: closer
/// ones with which all grids connect, on a finer background where it takes that.
std::optional<Advice> closer_lines(const OverlapCheck& check, const Node& list) {
  std::vector<BodyFittedSpec> specs = check.body_fitted;
  std::vector<std::string> written;
  std::size_t first = specs.size();
  for (std::size_t k = 0; k < specs.size(); ++k) {
    if (is_chosen(list.items[k])) continue;
    const BodyFittedSpec sound = with_sound_lines(specs[k]);
    if (sound.spacing >= specs[k].spacing) continue;
    first = std::min(first, k);
    specs[k] = sound;
    written.push_back(fmt::format("`spacing: {:.2g}` for grid `{}`, with `lines: {}`", sound.spacing,
                                  sound.name, sound.lines));
  }
  if (written.empty()) return std::nullopt;
  if (!connects(check.background, specs)) {
    const auto spacing = finer_background(
        {.background = check.background, .body_fitted = specs, .owner = check.owner, .path = check.path});
    if (!spacing) return std::nullopt;
    written.push_back(fmt::format("`spacing: {:.2g}` in {}.grid", *spacing, check.path));
  }
  return Advice{.node = list.items[first],
                .path = fmt::format("{}.body_fitted[{}]", check.path, first),
                .text = fmt::format("write {}", fmt::join(written, ", and ")),
                .tried = true};
}

}  // namespace

Advice advice_for(const OverlapCheck& check) {
  if (const Node* shape = check.owner.find("shape")) return advice_for_solid(check, *shape);
  const Node& list = *check.owner.find("body_fitted");
  const std::string path = check.path + ".body_fitted";
  if (const auto touching = almost_touching(check, list)) return *touching;
  if (const auto closer = closer_lines(check, list)) return *closer;
  const auto to_other = too_near(check, list), to_side = too_near_to_side(check, list);
  if (to_side && (!to_other || to_side->missing > to_other->missing)) return *to_side;
  if (to_other) return *to_other;
  if (!std::ranges::all_of(list.items, is_chosen)) {
    if (const auto advice = by_trial(check, list, path)) return *advice;
  }
  if (const auto advice = too_sharp(check, list, path)) return *advice;
  return {.node = list, .path = path, .text = "round the curve more there, or leave it more room"};
}

}  // namespace fsi
