/// The gas solver as a program of a run.

#include "common/program/program.hpp"
#include "fluid_solver/program/port.hpp"

int main(int argc, char** argv) {
  return fsi::run_program(argc, argv, "fluid", "fluid", [](const fsi::Setup& setup, fsi::io::Part& part) {
    if (!setup.problem.fluid)
      throw fsi::UserMistake("the case has no section `fluid`; write one or start a solid solver");
    fsi::fluid::FluidParticipant solver(setup);
    fsi::participate(setup, part, solver);
  });
}
