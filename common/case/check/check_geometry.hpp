#pragma once
/// Where the bodies of a case lie, before grids are put between them.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// No outline crosses itself, every outline lies within the rectangles of the gas and of its solid's core,
/// and no two of them overlap at t = 0; `root` gives the places for messages.
/// @throws UserMistake
void check_geometry(const Case& problem, const config::Node& root);

}  // namespace fsi
