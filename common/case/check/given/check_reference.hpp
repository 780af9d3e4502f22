#pragma once
/// `reference` is a solution of the case, and describes what takes its data from it.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// @throws UserMistake
void check_reference(const Case& problem, const config::Node& root);

}  // namespace fsi
