#pragma once
/// What is valid in a case and seldom meant.

#include <string>
#include <vector>

#include "common/case/case.hpp"

namespace fsi {

/// Largest |p - p_e| that the gases have at t = 0 and outside their sides, over lambda + 2 mu of a solid [-]; 0 for a rigid body
/// or a beam.
double pressure_over_stiffness(const Case& problem, const SolidSpec& solid);

/// More than this and a body is squeezed to less than a tenth, or as much drawn out: it was given in other units.
inline constexpr double crushing = 10;

/// One line each, for a person.
std::vector<std::string> remarks_on(const Case& problem);

}  // namespace fsi
