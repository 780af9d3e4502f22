#pragma once
/// Sides of the grid of a solid with a `shape`, of which the outline leaves some, or none.

#include <string>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// What a file says of sides that are no side of the body would do nothing, and a body does not meet a gas at a side on
/// which it stands. @throws UserMistake
void refuse_idle_sides(const config::Node& node, const std::string& path, const SolidSpec& solid);

}  // namespace fsi
