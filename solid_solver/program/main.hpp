#pragma once
/// The solid solver as a program of a run.

#include "solid_solver/program/law_kind.hpp"

namespace fsi::solid {

/// @return exit code of the program
int run_solid_solver(int argc, char** argv, const LawKind& law);

}  // namespace fsi::solid
