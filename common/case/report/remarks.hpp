#pragma once
/// What is valid in a case and seldom meant.

#include <string>
#include <vector>

#include "common/case/case.hpp"

namespace fsi {

/// Largest |p - p_e| that the gases have at t = 0 and outside their sides, over lambda + 2 mu of a solid [-]; 0 for a rigid body
/// or a beam.
double pressure_over_stiffness(const Case& problem, const SolidSpec& solid);

/// The same with rho v^2 added to |p - p_e|: about what presses a body where it brings that gas to rest, be it subsonic
/// or behind a bow shock [-].
double stagnation_over_stiffness(const Case& problem, const SolidSpec& solid);

/// More than this and a body is squeezed to less than a tenth, or as much drawn out: it was given in other units.
inline constexpr double crushing = 10;
/// More than this squeezes a body by a third or more, and breaks it rather than the scheme does.
inline constexpr double heavy = 0.5;

/// One line each, for a person.
std::vector<std::string> remarks_on(const Case& problem);

}  // namespace fsi
