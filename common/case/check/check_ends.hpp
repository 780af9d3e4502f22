#pragma once
/// Solids whose interfaces end on walls of the gas are held there.

#include <array>
#include <string>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"
#include "common/core/types.hpp"

namespace fsi {

bool is_wall(const BoundarySpec& boundary);
/// The two sides at the ends of a side, in the order of its points.
std::array<Side, 2> sides_beside(Side side);
/// The wall of a gas on which the interface with the solid ends at x, in words; empty: it is none.
std::string wall_at(const FluidSpec& fluid, const SolidSpec& solid, const Vec2& x);

/// An end of an interface that stands on a wall of the gas stays on it: the solid is clamped there or slides
/// along the wall. @throws UserMistake where it is free to leave
void check_held_ends(const Case& problem, const config::Node& root);

}  // namespace fsi
