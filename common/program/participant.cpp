#include "common/program/participant.hpp"

#include "common/program/driver.hpp"

namespace fsi {

bus::BusOptions bus_options(const Setup& setup) {
  return {.run = setup.run,
          .key = setup.key,
          .peer_timeout_s = setup.problem.time.peer_timeout,
          .hello_timeout_s = setup.problem.time.join_timeout,
          .pids = setup.pids,
          .step_timeout_s = setup.problem.time.step_timeout,
          .throw_if_interrupted = throw_if_interrupted};
}

wire::Telemetry telemetry_of(const Setup& setup, const io::Part& part, const Participant& solver, double dt,
                             const std::string& reason) {
  wire::Telemetry telemetry;
  telemetry.state = part.t < setup.problem.time.end ? "computing" : "done";
  telemetry.step = part.steps;
  telemetry.t = part.t;
  telemetry.t_end = setup.problem.time.end;
  telemetry.dt = dt;
  telemetry.dt_reason = reason;
  telemetry.compute_s = part.compute_s;
  telemetry.wait_s = part.wait_s;
  telemetry.health = solver.health();
  const double updates = static_cast<double>(part.points) * static_cast<double>(part.substeps);
  telemetry.point_updates_per_s = part.compute_s > 0 ? updates / part.compute_s : 0;
  return telemetry;
}

void participate(const Setup& setup, io::Part& part, Participant& solver) {
  const wire::Hello hello = solver.hello();
  part.points = hello.points;
  for (const std::string& warning : bus::start_up_warnings()) log_info(warning);
  if (hello.interfaces.empty()) {
    run_alone(setup, part, solver);
  } else {
    run_coupled(setup, part, solver);
  }
  solver.report(part.t, part);
}

}  // namespace fsi
