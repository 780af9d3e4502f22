#include "common/case/read/build_levels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/case/document/reader.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/types.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

constexpr int ratio_of_levels = 3, fewest_cells = 4;  // spacings of neighbours; cells of the coarsest level

/// Adds points until the levels fit: every point of a level is one of the next finer one, a third of them.
void fit_levels(GridSpec& grid, int levels) {
  int cells = 1;  // of the finest level in one of the coarsest
  for (int l = 1; l < levels; ++l) cells *= ratio_of_levels;
  for (int* n : {&grid.n1, &grid.n2}) *n = std::max((*n - 1 + cells - 1) / cells, fewest_cells) * cells + 1;
}

}  // namespace

RefineSpec build_levels(const Node& node, const std::string& path, GridSpec& grid) {
  RefineSpec result;
  Reader::assign(node, "levels", result.levels);
  result.asked = {grid.n1, grid.n2};
  if (result.levels < 2) return result;
  if (grid.kind == GridSpec::Kind::mapped || grid.rotation != 0 || grid.shake > 0) {
    fail(node.find("levels")->place, path + ".levels",
         "only a `rectangle` along the axes, without `rotation` and `shake`, can have levels; write 1, or "
         "leave it out");
  }
  if (const Node* refine = node.find("refine")) {
    Reader::assign(*refine, "variable", result.variable);
    Reader::assign(*refine, "threshold", result.threshold);
    Reader::assign(*refine, "buffer", result.buffer);
    Reader::assign(*refine, "every", result.every);
    if (ratio_of_levels * result.buffer < result.every) {
      fail(refine->place, path + ".refine",
           fmt::format("a wave can leave the refined part: write `buffer: {}` or `every: {}`",
                       (result.every + ratio_of_levels - 1) / ratio_of_levels,
                       ratio_of_levels * result.buffer));
    }
  }
  fit_levels(grid, result.levels);
  return result;
}

void check_levels(const Node& node, const std::string& path, const FluidSpec& fluid) {
  if (fluid.refine.levels < 2) return;
  for (const Side side : all_sides) {
    const BoundarySpec& boundary = fluid.boundary[static_cast<std::size_t>(side)];
    if (boundary.kind != BoundaryKind::interface) continue;
    fail(node.find("levels")->place, path + ".levels",
         fmt::format(
             "the {} side moves with {} and the whole grid with it, but only a rectangle at rest can have "
             "levels; write 1, or let the gas have a grid along the solid (`body_fitted`, "
             "or a `shape` of the solid) before a background that stays",
             name_of(side), in_ticks(boundary.solid)));
  }
}

}  // namespace fsi
