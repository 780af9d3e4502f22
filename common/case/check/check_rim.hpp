#pragma once
/// Curves within a gas that lie along the rim of its rectangle.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Where a curve lies along a side of the rectangle, this has points on the curve with a condition of its own: that
/// of the curve, then, and a curve that moves leaves room behind it. @throws UserMistake
void check_rim(const Case& problem, const config::Node& root);

}  // namespace fsi
