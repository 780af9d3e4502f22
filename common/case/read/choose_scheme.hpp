#pragma once
/// What a case leaves open of the scheme of its gases.

#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// From this Mach number on a shock that lies along grid lines breaks up without shock_viscosity (docs/results.md, cylinders in
/// fast streams).
inline constexpr double strong_shock = 2;

/// May a gas have shocks of Mach 2 and more, by what the case says of its start and its sides: ratios of pressures, speeds of
/// gas and bodies? `fluid` is one of the case.
bool has_strong_shocks(const Case& problem, const FluidSpec& fluid);

/// Puts `scheme: {shock_viscosity: 0.5}` into such gases that have none and a limiter, in the tree as in the case.
/// @returns what was chosen, for a person
std::vector<std::string> choose_schemes(config::Node& root, Case& problem);

}  // namespace fsi
