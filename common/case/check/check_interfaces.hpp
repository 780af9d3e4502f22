#pragma once
/// Whether every interface has its two sides.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Each interface of a solid meets one gas along one curve, each gas of a coupled case meets a solid, and the
/// gases at one solid agree on its p_e. @throws UserMistake
void check_interfaces(const Case& problem, const config::Node& root);

}  // namespace fsi
