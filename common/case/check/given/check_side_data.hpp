#pragma once
/// What is given on the sides of gases and solids, and on curves, is finite for the whole run, and begins where the bodies do.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Looks at a sample of points of each side, at a sample of times. @throws UserMistake
void check_side_data(const Case& problem, const config::Node& root);

}  // namespace fsi
