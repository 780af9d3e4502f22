#include "solid_solver/laws/linear_elastic.hpp"
#include "solid_solver/solid_solver.hpp"

template class fsi::solid::SolidSolver<fsi::solid::LinearElastic>;
