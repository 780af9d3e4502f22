#pragma once
/// The solid solver as a program of a run; each law instantiates it once.

#include <fmt/format.h>

#include "common/program/program.hpp"
#include "solid_solver/port.hpp"

namespace fsi::solid {

/// The solid of the case this program stands for: the one named, or the only one.
inline const SolidSpec& solid_of(const Setup& setup) {
  for (const SolidSpec& spec : setup.problem.solids) {
    if (spec.name == setup.name) return spec;
  }
  throw UserMistake(fmt::format("the case has no solid \"{}\"; --name must be one of solids", setup.name));
}

template <Law L>
int run_solid_solver(int argc, char** argv) {
  return run_program(argc, argv, "solid", "solid", [](const Setup& setup, io::Part& part) {
    SolidParticipant<L> solver(setup, solid_of(setup));
    participate(setup, part, solver);
  });
}

}  // namespace fsi::solid
