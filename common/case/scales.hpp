#pragma once
/// Lengths and times that a case brings along, for what must not be a number of its own.

#include "common/case/case.hpp"

namespace fsi {

/// Extent of a grid along x or y, the larger one, as its corners at t = 0 have it [length].
double size_of(const GridSpec& grid);

/// Time in which a p-wave crosses a solid at rest [time].
double crossing_time_of(const SolidSpec& solid);

}  // namespace fsi
