#pragma once
/// A case file seen as a one-dimensional piston.

#include "common/case/case.hpp"
#include "reference/piston_chain.hpp"

namespace fsi::reference {

/// One solid with an interface on its right side, driven at its left side; gas to the right of it.
/// The expressions are evaluated on y = 0.
/// @throws UserMistake naming what does not fit
PistonProblem piston_from_case(const Case& problem);

/// Points per unit length the case asks for.
int points_from_case(const Case& problem);

}  // namespace fsi::reference
