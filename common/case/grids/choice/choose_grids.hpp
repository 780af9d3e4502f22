#pragma once
/// Grids that the case file leaves open, chosen from the outlines.
///
/// A body gets a grid along its outline and a core; the gas a grid around every body. What decides: how
/// sharply the outline bends towards a grid, how thick the body is there, how narrow the gas, the grid's
/// spacing h, and at last a trial: grids that fold or do not connect are made less deep, or of closer points.

#include <optional>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/case/document/scope.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Writes what is chosen into the tree, so that the resolved case has it: `solids.NAME.grid` and
/// `body_fitted` of solids whose `grid` gives no points or is not there, `fluid.body_fitted` for solids with
/// a `shape` that have no grid there, and `lines` and `spacing` of those that have neither.
/// @returns lines for people: "solids.disk.grid: 41 x 41 points on [-1, 1] x [-1, 1]"
/// @throws UserMistake where a key is wrong, or an outline needs more points than there can be
std::vector<std::string> choose_grids(config::Node& root, const Scope& scope);

}  // namespace fsi
