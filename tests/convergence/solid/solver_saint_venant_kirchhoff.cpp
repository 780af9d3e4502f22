#include "solid_solver/laws/saint_venant_kirchhoff.hpp"
#include "solid_solver/solid_solver.hpp"

template class fsi::solid::SolidSolver<fsi::solid::SaintVenantKirchhoff>;
