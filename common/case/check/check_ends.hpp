#pragma once
/// Solids whose outlines end on walls are held there.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// An end of an interface that stands on a wall of the gas stays on it: the solid is clamped there or slides
/// along the wall. @throws UserMistake where it is free to leave
void check_held_ends(const Case& problem, const config::Node& root);

}  // namespace fsi
