#pragma once
/// What everybody who has a seat at the bus does alike: options
/// from the set-up, and telling the others of a failure.

#include <exception>

#include "common/bus/options.hpp"
#include "common/core/failure.hpp"
#include "common/program/program.hpp"

namespace fsi {

bus::BusOptions bus_options(const Setup& setup);

/// Runs a time loop within a session. Whatever fails, everybody else is told before the failure goes on.
template <class Session, class Loop>
void run_within(Session& session, const Loop& loop) {
  try {
    loop();
  } catch (const Failure& failure) {
    session.abort(failure);
    throw;
  } catch (const std::exception& error) {
    session.abort(Failure(ExitCode::internal_error, error.what()));
    throw;
  }
}

}  // namespace fsi
