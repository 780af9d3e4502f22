#pragma once
/// What a case says of its gases.

#include <functional>

#include "common/case/case.hpp"

namespace fsi {

/// Calls look(rho, |v|, p) with the states that a gas has at t = 0 and outside its sides, at points that are looked at.
void each_state(const FluidSpec& fluid, const std::function<void(double rho, double speed, double p)>& look);

}  // namespace fsi
