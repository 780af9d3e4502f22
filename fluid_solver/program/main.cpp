/// The gas solver as a program of a run.

#include "common/program/program.hpp"
#include "fluid_solver/program/crew.hpp"
#include "fluid_solver/program/port.hpp"

int main(int argc, char** argv) {
  return fsi::run_program(
      argc, argv, "fluid", "fluid",
      [](const fsi::Setup& setup, fsi::io::Part& part) {
        if (!setup.ranks->first()) return fsi::fluid::serve(setup);
        fsi::fluid::FluidParticipant solver(setup);
        fsi::participate(setup, part, solver);
      },
      fsi::Sharing::ranks);
}
