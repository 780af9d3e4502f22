#pragma once
/// What a case leaves open of the scheme of its gases.

#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Puts `scheme: {shock_viscosity: 0.5}` into gases that have none and a limiter, in the tree as in the case, where shocks of Mach
/// 2 and more may come up by what the case says: of Mach numbers, of ratios of pressures, and of bodies that run into a gas.
/// @returns what was chosen, for a person
std::vector<std::string> choose_schemes(config::Node& root, Case& problem);

}  // namespace fsi
