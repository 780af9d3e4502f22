#pragma once
/// Whether a side of the gas's grid and a side of a solid's are the same curve.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Both sides are the same curve at t = 0; their points need not be the same.
/// @param place the gas's side in the file  @throws UserMistake
void check_sides_meet(const FluidSpec& fluid, const SolidSpec& solid, Side gas_side, Side solid_side,
                      const config::Node& place);

/// An interface between periodic sides goes on beyond its ends, on both sides of it.
void check_periods_meet(const FluidSpec& fluid, const SolidSpec& solid, Side gas_side, Side solid_side,
                        const config::Node& place);

}  // namespace fsi
