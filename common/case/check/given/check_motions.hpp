#pragma once
/// The motions that a case gives its rigid bodies begin where the bodies are, go on without jumps, and stay in the gas.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Looks at a sample of times. @throws UserMistake
void check_motions(const Case& problem, const config::Node& root);

}  // namespace fsi
