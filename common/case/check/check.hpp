#pragma once
/// Checks of the case as a whole: what no single key can get wrong.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Partners of interfaces, their points, states that make sense,
/// data that exists; `root` gives the places for messages.
/// @throws UserMistake
void check_case(const Case& problem, const config::Node& root);

}  // namespace fsi
