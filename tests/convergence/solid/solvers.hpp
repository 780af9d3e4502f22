#pragma once
/// The solver with each law, compiled once for all tests.

#include "solid_solver/laws/linear_elastic.hpp"
#include "solid_solver/laws/neo_hookean.hpp"
#include "solid_solver/laws/saint_venant_kirchhoff.hpp"
#include "solid_solver/solid_solver.hpp"

extern template class fsi::solid::SolidSolver<fsi::solid::LinearElastic>;
extern template class fsi::solid::SolidSolver<fsi::solid::SaintVenantKirchhoff>;
extern template class fsi::solid::SolidSolver<fsi::solid::NeoHookean>;
