#include "solid_solver/laws/neo_hookean.hpp"
#include "solid_solver/solid_solver.hpp"

template class fsi::solid::SolidSolver<fsi::solid::NeoHookean>;
