#pragma once
/// Grids along the walls of the gas's rectangle that bodies are near to.
///
///      .  .  .  .  .  .        the background's points alone leave a narrow way between a body and a wall
///      with . /------\ .  .         two or three of them; a grid along the wall and one around the body
///      reach into
///     _._\______/_._._._       each other there, whatever the background's spacing (common/grid/geometry/near_curves)

#include <cstddef>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Adds an entry to `fluid.body_fitted` for every side that is a wall, on which no curve ends, and which a
/// closed curve with one of the grids `open` is near to, unless what lies between them is behind another curve.
/// @returns whether there are any
bool add_wall_strips(config::Node& body_fitted, const FluidSpec& fluid, const std::vector<std::size_t>& open);

}  // namespace fsi
