#pragma once
/// The solver with each law, compiled once for all tests.

#include "solid_solver/linear_elastic_solver.hpp"
#include "solid_solver/neo_hookean_solver.hpp"
#include "solid_solver/saint_venant_kirchhoff_solver.hpp"
