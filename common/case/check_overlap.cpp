#include "common/case/check_overlap.hpp"

#include <fmt/format.h>

#include "common/case/composite_from_case.hpp"

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
    if (periodic) fail(grid.place, path, "a background of body-fitted grids cannot be periodic");
  }
}

/// Where the grid's curve is described.
const Node& place_of(const OverlapCheck& check) {
  const Node* shape = check.owner.find("shape");
  const Node* list = check.owner.find("body_fitted");
  return shape != nullptr ? *shape : *list;
}

}  // namespace

void check_overlap(const OverlapCheck& check) {
  if (check.body_fitted.empty()) return;
  check_background(check);
  std::vector<Field> positions;
  std::vector<ConstFieldView> views;
  try {
    for (const BodyFittedSpec& spec : check.body_fitted) {
      grid::HyperbolicMarch march(march_of(spec));
      positions.emplace_back(march.layout(), 2);
      march.march(spec.curve.x, positions.back().view(), 0);
    }
    for (const Field& x : positions) views.push_back(x.view());
    grid::CompositeGrid composite(background_of(check.background), bodies_of(check.body_fitted));
    composite.connect(views, 0);
  } catch (const Failure& failure) {
    fail(place_of(check).place, check.path + ".body_fitted",
         fmt::format("{}; change `lines`, `spacing` or the shape", failure.what()));
  }
}

}  // namespace fsi
