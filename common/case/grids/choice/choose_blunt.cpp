#include "common/case/grids/choice/choose_blunt.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "common/case/document/fluid_sections.hpp"
#include "common/case/grids/node_tools.hpp"
#include "common/case/read/build_shape.hpp"
#include "common/case/read/build_walls.hpp"
#include "common/case/shapes/every_shape.hpp"
#include "common/core/failure.hpp"
#include "common/grid/shapes/blunted.hpp"

namespace fsi {

namespace {

using config::Node;

/// The longer side of the curve's bounding rectangle [length].
double extent_of(const grid::PlaneCurve& curve) {
  constexpr int samples = 400;
  Vec2 low = curve.position(0), high = low;
  for (int k = 1; k < samples; ++k) {
    const Vec2 x = curve.position(static_cast<double>(k) / samples);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).maxCoeff();
}

/// A position for messages, its round-off taken away.
double rounded(double x, double extent) {
  const double unit = 1e-9 * extent;
  return unit * std::round(x / unit) + 0.0;  // + 0: no -0
}

grid::PlaneCurve curve_of(const Node& shape, const std::string& path) {
  CurveSpec walls;
  read_walls(shape, path, walls);
  const grid::Curve ends = walls.closed() ? grid::Curve::closed : grid::Curve::open;
  return shapes::curve_of(shape.find("kind")->text, {.node = shape, .path = path, .ends = ends});
}

/// Nothing where the shape is wrong, or too thin for such a face: who builds it says so, with its place.
std::vector<grid::CutCorner> cuts_of(const Node& shape, const std::string& path, double width,
                                     double& extent) {
  try {
    const grid::PlaneCurve curve = curve_of(shape, path);
    extent = extent_of(curve);
    return grid::cut_corners(curve, width);
  } catch (const UserMistake&) {
    return {};
  }
}

void choose_for(Node& shape, const std::string& path, double h, std::vector<std::string>& chosen) {
  if (shape.find("blunt") != nullptr) return;
  const double width = usual_blunt * h;
  double extent = 1;
  const std::vector<grid::CutCorner> cuts = cuts_of(shape, path, width, extent);
  if (cuts.empty()) return;
  config::put(shape, "blunt", config::number_node(width, shape.place));
  constexpr double percent = 100;
  for (const grid::CutCorner& cut : cuts) {
    chosen.push_back(
        fmt::format("{}: blunt {:.3g}: the sharp corner at ({:.6g}, {:.6g}) is cut off where its sides are "
                    "so far apart; {:.3g} is missing there, {:.2g} % of the outline's extent (less with a "
                    "smaller h, or `blunt`)",
                    path, width, rounded(cut.at[0], extent), rounded(cut.at[1], extent), cut.loss,
                    percent * cut.loss / extent));
  }
}

}  // namespace

void choose_blunt(Node& root, const Reader& reader, std::vector<std::string>& chosen) {
  const double h = reader.scope().constants.at("h");
  if (Node* solids = root.find("solids")) {
    for (config::Entry& solid : solids->entries) {
      if (Node* shape = solid.value.find("shape"))
        choose_for(*shape, fmt::format("solids.{}.shape", solid.key), h, chosen);
    }
  }
  for (const auto& fluid : fluid_sections(root)) {
    Node* grids = fluid.node->find("body_fitted");
    if (grids == nullptr) continue;
    for (std::size_t k = 0; k < grids->items.size(); ++k) {
      if (Node* shape = grids->items[k].find("shape"))
        choose_for(*shape, fmt::format("{}.body_fitted[{}].shape", fluid.path, k), h, chosen);
    }
  }
}

}  // namespace fsi
