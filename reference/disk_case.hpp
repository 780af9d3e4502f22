#pragma once
/// A case file seen as a rotating disk.

#include "common/case/case.hpp"
#include "reference/disk_chain.hpp"

namespace fsi::reference {

/// One solid, the unit disk about the origin turning with `reference.omega_0`, and one gas around it, at rest
/// and uniform. The initial velocity that the case gives the solid must be the same motion.
/// @throws UserMistake naming what does not fit
DiskProblem disk_from_case(const Case& problem);

/// Points per unit length the case asks for.
int disk_points_from_case(const Case& problem);

}  // namespace fsi::reference
