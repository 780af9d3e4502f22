/// The coupler as a program of a run.

#include "common/program/program.hpp"
#include "coupler/port.hpp"

int main(int argc, char** argv) {
  return fsi::run_program(argc, argv, "coupler", "coupler", [](const fsi::Setup& setup, fsi::io::Part& part) {
    fsi::coupler::CoupledRun(setup, part).run();
  });
}
