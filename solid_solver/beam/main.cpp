/// The program solid_solver_beam.

#include "common/program/program.hpp"
#include "solid_solver/beam/port.hpp"

int main(int argc, char** argv) {
  return fsi::run_program(argc, argv, "solid", "solid", [](const fsi::Setup& setup, fsi::io::Part& part) {
    fsi::beam::BeamParticipant solver(setup, fsi::solid_of(setup));
    participate(setup, part, solver);
  });
}
