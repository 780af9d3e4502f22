#include "common/case/check/check_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/case/grids/composite_from_case.hpp"
#include "common/case/grids/no_grids_fit.hpp"
#include "common/case/grids/overlap_advice.hpp"
#include "common/core/failure.hpp"
#include "common/core/input/suggest.hpp"

namespace fsi {

using config::fail;
using config::Node;

namespace {

void check_background(const OverlapCheck& check) {
  const Node& grid = *check.owner.find("grid");
  const std::string path = check.path + ".grid";
  if (check.background.kind != GridSpec::Kind::rectangle)
    fail(grid.place, path, "the background of body-fitted grids must be a rectangle");
  for (const char* key : {"rotation", "shake"}) {
    if (const Node* node = grid.find(key))
      fail(node->place, path + "." + key, "a background of body-fitted grids lies still; leave it out");
  }
  for (const bool periodic : check.background.periodic) {
    if (periodic)
      fail(grid.place, path,
           "sides of a rectangle with grids around curves cannot be periodic, for these do not repeat; where "
           "the flow "
           "is its own mirror image in these sides write symmetry there, else sides that lie far away");
  }
}

/// Each grid has its own name among the results.
void check_names(const OverlapCheck& check) {
  if (std::ranges::find(check.body_fitted, check.background.name, &BodyFittedSpec::name) ==
      check.body_fitted.end())
    return;
  const Node& grid = *check.owner.find("grid");
  const Node* name = grid.find("name");
  fail(name == nullptr ? grid.place : name->place, check.path + ".grid",
       fmt::format(
           "there are two grids {}, this one and the one fitted to a curve; give this one another `name`",
           in_ticks(check.background.name)));
}

/// Where the grid's curve is described.
const Node& place_of(const OverlapCheck& check) {
  const Node* shape = check.owner.find("shape");
  const Node* list = check.owner.find("body_fitted");
  return shape != nullptr ? *shape : *list;
}

/// The first line of a mapped grid is its curve.
void check_curve(const BodyFittedSpec& spec, const grid::MovingGrid& grid) {
  const std::vector<double> line = grid.side_points(spec.side);
  const auto n = static_cast<std::size_t>(spec.curve.points());
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 there(line[k], line[n + k]), curve(spec.curve.x[k], spec.curve.x[n + k]);
    if ((there - curve).norm() <= 1e-6 * spec.curve.spacing) continue;
    throw UserMistake(
        fmt::format("grid \"{}\": `map` at r = {:.6g}, s = 0 is ({:.6g}, {:.6g}), but point {} of its curve "
                    "is at ({:.6g}, {:.6g}); let `map` begin on the curve",
                    spec.name, static_cast<double>(k) / static_cast<double>(n - 1), there.x(), there.y(), k,
                    curve.x(), curve.y()));
  }
}

}  // namespace

void check_overlap(const OverlapCheck& check) {
  if (check.body_fitted.empty()) return;
  check_background(check);
  check_names(check);
  try {
    for (const BodyFittedSpec& spec : check.body_fitted) {
      if (spec.map) check_curve(spec, grid::MovingGrid(grid_of(spec), 0));
    }
    connect_once(check.background, check.body_fitted);
  } catch (const Diverged& failure) {
    const Advice advice = advice_for(check);
    const std::string cause =
        advice.fact.empty() ? failure.what() : fmt::format("{}; {}", failure.what(), advice.fact);
    if (advice.tried) fail(advice.node.place, advice.path, fmt::format("{}; {}", cause, advice.text));
    throw NoGridsFit({.place = advice.node.place,
                      .key = advice.path,
                      .cause = cause,
                      .otherwise = advice.text,
                      .owner = check.path});
  } catch (const NoGridsFit& mistake) {
    NoGridsFit::Parts parts = mistake.parts();
    parts.place = place_of(check).place;
    parts.key = check.path + ".body_fitted";
    parts.owner = check.path;
    throw NoGridsFit(std::move(parts));
  } catch (const Failure& failure) {
    fail(place_of(check).place, check.path + ".body_fitted", failure.what());
  }
}

}  // namespace fsi
