#pragma once
/// What a case says of its solids by formulas is finite at the start, and leaves their interfaces where the gas has them.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Looks at a sample of points of each body. @throws UserMistake
void check_starts(const Case& problem, const config::Node& root);

}  // namespace fsi
