#include "solid_solver/composite.hpp"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "common/core/failure.hpp"
#include "common/grid/geometry/partition.hpp"
#include "solid_solver/kernels/reference_metrics.hpp"

namespace fsi::solid {

namespace {

const Condition& condition_of(const SolidPart& part, Side side) {
  return part.boundaries[static_cast<std::size_t>(side)].condition;
}

grid::CartesianGrid background_of(const SolidPart& part) {
  if (!ReferenceMetrics(part.grid.x()).cartesian()) {
    throw UserMistake(
        fmt::format("grid \"{}\": the first of several grids is the background; make it a rectangle with "
                    "evenly spaced points along x and y",
                    part.grid.name()));
  }
  return grid::background_of(part.grid);
}

void check(const SolidPart& part, const grid::BodyFittedGrid& body) {
  if (part.grid.layout() != Layout(body.n1, body.n2)) {
    throw UserMistake(fmt::format("grid \"{}\": {} x {} points, described as {} x {}", part.grid.name(),
                                  part.grid.layout().n1, part.grid.layout().n2, body.n1, body.n2));
  }
  const Side far = body.curve == Side::bottom ? Side::top : Side::bottom;
  if (!condition_of(part, far).open()) {
    throw UserMistake(
        fmt::format("grid \"{}\": side {} lies inside the body and takes no condition; write none",
                    part.grid.name(), name_of(far)));
  }
  const bool closed = body.ends == grid::Curve::closed;
  for (const Side side : {Side::left, Side::right}) {
    if (condition_of(part, side).repeated() != closed) {
      throw UserMistake(fmt::format("grid \"{}\": side {} must {}be periodic, since its curve is {}",
                                    part.grid.name(), name_of(side), closed ? "" : "not ",
                                    closed ? "closed" : "open"));
    }
  }
}

}  // namespace

std::optional<grid::CompositeGrid> connected(const std::vector<SolidPart>& parts,
                                             std::vector<grid::BodyFittedGrid> bodies) {
  if (parts.size() != bodies.size() + 1) {
    throw UserMistake(
        fmt::format("{} grids and {} descriptions of body-fitted ones; the first grid is the "
                    "background, each other one needs its description",
                    parts.size(), bodies.size()));
  }
  if (bodies.empty()) return {};
  std::vector<ConstFieldView> x;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    check(parts[k + 1], bodies[k]);
    x.push_back(parts[k + 1].grid.x());
  }
  grid::CompositeGrid composite(background_of(parts[0]), std::move(bodies));
  composite.connect(x, 0);
  return composite;
}

std::vector<Field> areas_of(const grid::CompositeGrid& composite, const std::vector<SolidPart>& parts) {
  std::vector<ConstFieldView> x;
  for (const SolidPart& part : parts) x.push_back(part.grid.x());
  return grid::area_weights(composite, x);
}

SolidPoints points_of(const std::optional<grid::CompositeGrid>& composite, int grid, const Layout& layout) {
  if (!composite) return SolidPoints(layout);
  return {layout, composite->discretised(grid), composite->valid(grid)};
}

}  // namespace fsi::solid
