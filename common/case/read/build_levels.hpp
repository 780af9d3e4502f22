#pragma once
/// Levels of the gas's background.

#include <string>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Reads `levels` and `refine` of the grid of a gas, and adds points to the grid until its levels fit.
/// @throws UserMistake where the grid cannot have levels, or a wave could leave what is refined
RefineSpec build_levels(const config::Node& node, const std::string& path, GridSpec& grid);

/// @throws UserMistake where a side of a background of several levels would move
void check_levels(const config::Node& node, const std::string& path, const FluidSpec& fluid);

}  // namespace fsi
