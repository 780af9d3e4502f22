#pragma once
/// The solid solver as a program of a run; each law instantiates it once.

#include "common/program/program.hpp"
#include "solid_solver/program/port.hpp"

namespace fsi::solid {

template <Law L>
int run_solid_solver(int argc, char** argv) {
  return run_program(
      argc, argv, "solid", "solid",
      [](const Setup& setup, io::Part& part) {
        if (!setup.ranks->first()) return serve<L>(setup, solid_of(setup));
        SolidParticipant<L> solver(setup, solid_of(setup));
        participate(setup, part, solver);
      },
      Sharing::ranks);
}

}  // namespace fsi::solid
