#pragma once
/// What the loops that drive a solver have in common, coupled or alone.

#include <cstdint>
#include <string>

#include "common/core/failure.hpp"
#include "common/core/log.hpp"
#include "common/io/checkpoint.hpp"
#include "common/program/participant.hpp"
#include "common/program/run/session.hpp"

namespace fsi {

/// Solver with a coupler: one message out and one in, per step and interface.
void run_coupled(const Setup& setup, io::Part& part, Participant& solver);
/// Solver without interfaces: chooses its own steps.
void run_alone(const Setup& setup, io::Part& part, Participant& solver);

wire::Telemetry telemetry_of(const Setup& setup, const io::Part& part, const Participant& solver, double dt,
                             const ProposedTimeStep& proposal);

/// Draws the solver's present state, that of `at`.
bus::Draw draw_of(const io::Part& part, Participant& solver, const io::Standing& at);

/// Looks for noise and for grids that disagree every so many steps, and always `now`; what is worst goes into the
/// part, and the log says when it is too much.
void watch_noise(io::Part& part, Participant& solver, const io::Standing& at, bool now);

/// The last time at which a solver's boundary conditions held.
struct LastState {
  double t = 0;  ///< [time]
  std::uint64_t step = 0;
};

/// Runs a time loop. Where the solution diverges, the failure learns the step and what may help, and the solver
/// leaves the state before it.
template <class Loop>
void with_last_state(Participant& solver, const LastState& last, const Loop& loop) {
  const auto leave_state = [&] {
    try {
      solver.write_last_state(last.t, last.step);
    } catch (const Failure& failure) {  // the first failure is the one to report
      log_warning(failure.what());
    }
  };
  try {
    loop();
  } catch (Diverged& broke) {
    leave_state();
    broke.know({.step = last.step + 1});
    if (const std::string remedy = solver.remedy(); !remedy.empty()) broke.advise(remedy);
    throw;
  } catch (const Failure& failure) {
    if (failure.code() == ExitCode::diverged) leave_state();  // those of somebody else
    throw;
  }
}

}  // namespace fsi
