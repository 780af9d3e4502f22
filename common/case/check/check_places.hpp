#pragma once
/// Whether probes lie where there are values, and whether programs can do what the laws of the solids ask.

#include "common/case/case.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

/// Every probe lies in the gas, or in the reference configuration of its solid, at t = 0. The grids must have
/// passed their checks. @throws UserMistake
void check_probe_places(const Case& problem, const config::Node& root);

/// A rigid body has sides that it can have (those of solid_solver/rigid/from_case.cpp), and a reference that
/// is computed knows the law. @throws UserMistake
void check_laws(const Case& problem, const config::Node& root);

}  // namespace fsi
