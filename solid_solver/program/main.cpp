#include "solid_solver/program/main.hpp"

#include "common/program/program.hpp"
#include "solid_solver/program/crew.hpp"
#include "solid_solver/program/port.hpp"

namespace fsi::solid {

int run_solid_solver(int argc, char** argv, const LawKind& law) {
  return run_program(
      argc, argv, "solid", "solid",
      [&law](const Setup& setup, io::Part& part) {
        if (!setup.ranks->first()) return serve(setup, solid_of(setup), law);
        SolidParticipant solver(setup, solid_of(setup), law);
        participate(setup, part, solver);
      },
      Sharing::ranks);
}

}  // namespace fsi::solid
