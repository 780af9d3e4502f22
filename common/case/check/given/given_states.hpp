#pragma once
/// What a case says of the states of its gases.

#include <functional>

#include "common/case/case.hpp"
#include "common/core/types.hpp"

namespace fsi {

/// Calls look(rho, v, p) with the states that formulas give a gas: at t = 0, and outside its sides and its curves until the end,
/// at points and times that are looked at. States of the reference solution are not among them.
void each_state(const Case& problem, const FluidSpec& fluid,
                const std::function<void(double rho, const Vec2& v, double p)>& look);

}  // namespace fsi
