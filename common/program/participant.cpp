#include "common/program/participant.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/bus/solo_session.hpp"
#include "common/bus/solver_session.hpp"
#include "common/core/log.hpp"
#include "common/core/time_schedule.hpp"

namespace fsi {

namespace {

bus::BusOptions bus_options(const Setup& setup) {
  return {.run = setup.run,
          .peer_timeout_s = setup.problem.time.peer_timeout,
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

/// Runs a time loop; where the numbers break, the message says in which step.
template <class Loop>
void with_step_number(const io::Part& part, const Loop& loop) {
  try {
    loop();
  } catch (const NumbersBroke& broke) {
    const std::string words = broke.what();
    if (words.starts_with("step ")) throw;
    throw NumbersBroke(fmt::format("step {}, {}", part.steps + 1, words));
  }
}

/// One solver in a coupled run: one message out and one in, per step and interface.
class CoupledRun {
 public:
  CoupledRun(const Setup& setup, io::Part& part, Participant& solver)
      : setup_(setup),
        part_(part),
        solver_(solver),
        hello_(solver.hello()),
        session_(bus_options(setup), hello_),
        predicted_(hello_.interfaces.size()),
        projected_(hello_.interfaces.size()) {}

  void run() {
    try {
      with_step_number(part_, [this] { loop(); });
      session_.leave();
    } catch (const Failure& failure) {
      session_.abort(failure.code(), failure.what());
      throw;
    } catch (const std::exception& error) {
      session_.abort(ExitCode::expectation_missed, error.what());
      throw;
    }
  }

 private:
  void loop() {
    double t = 0, dt = 0;
    for (std::uint64_t step = 0;; ++step) {
      publish_predicted(step, t);
      receive_projected(step);
      solver_.apply_bcs(t, projected_);
      solver_.write_tables(t, dt, projected_);
      const wire::ProjectedInterface& answer = *projected_.front();
      if (answer.write_output) solver_.write_fields(t, step);
      if (answer.stop) {
        if (!answer.stop_reason.empty()) part_.status = "stopped";
        part_.reason = answer.stop_reason;
        wire::Telemetry last = telemetry_of(setup_, part_, solver_, dt, bid_.reason);
        last.state = "done";
        session_.publish(last);
        return;
      }
      dt = answer.dt_next;
      solver_.advance(t, dt, answer.substeps_next, projected_);
      t = answer.t_next;
      count_step(part_, t, dt);
      part_.substeps += static_cast<std::uint64_t>(answer.substeps_next);
      part_.compute_s += watch_.lap();
      if (session_.telemetry_due()) session_.publish(telemetry_of(setup_, part_, solver_, dt, bid_.reason));
      throw_if_interrupted();
    }
  }

  void publish_predicted(std::uint64_t step, double t) {
    bid_ = solver_.compute_time_step();
    for (std::size_t k = 0; k < predicted_.size(); ++k) {
      wire::PredictedInterface& message = predicted_[k];
      solver_.fill(k, message);
      message.interface = hello_.interfaces[k].name;
      message.step = step;
      message.t = t;
      message.dt_bid = bid_.dt;
      message.dt_reason = bid_.reason;
      message.health = solver_.health();
      message.compute_s = part_.compute_s;
      message.wait_s = part_.wait_s;
      session_.publish(message);
    }
    part_.compute_s += watch_.lap();
  }

  void receive_projected(std::uint64_t step) {
    for (std::size_t k = 0; k < projected_.size(); ++k) {
      projected_[k] = &session_.receive(hello_.interfaces[k].name, step);
    }
    part_.wait_s += watch_.lap();
  }

  const Setup& setup_;
  io::Part& part_;
  Participant& solver_;
  wire::Hello hello_;
  bus::SolverSession session_;
  std::vector<wire::PredictedInterface> predicted_;
  std::vector<const wire::ProjectedInterface*> projected_;
  TimeStepBid bid_;
  Stopwatch watch_;
};

/// Obeys requests from outside; returns false when the run shall stop.
bool obey(bus::SoloSession& session) {
  bool paused = false;
  do {
    for (const wire::Control& control : session.controls()) {
      if (control.command == "stop") return false;
      if (control.command == "pause") paused = true;
      if (control.command == "resume") paused = false;
    }
    throw_if_interrupted();
    if (paused) session.idle(0.1);
  } while (paused);
  return true;
}

/// A solver without interfaces chooses its own steps.
void run_alone(const Setup& setup, io::Part& part, Participant& solver) {
  const TimeSpec& time = setup.problem.time;
  bus::SoloSession session(bus_options(setup), part.role, part.participant);
  TimeSchedule schedule({.end = time.end,
                         .output_times = setup.problem.output.times,
                         .growth = time.growth,
                         .dt_max = time.dt.value_or(0)});
  ProgressLines progress(time.end);
  Stopwatch watch;
  double t = 0;
  solver.apply_bcs(t, {});
  solver.write_tables(t, 0, {});
  if (schedule.output_at_start()) solver.write_fields(t, 0);
  const auto loop = [&] {
    for (bool end = false; !end;) {
      if (!obey(session)) {
        part.status = "stopped";
        part.reason = "stopped on request";
        break;
      }
      const TimeStepBid bid = solver.compute_time_step();
      const PlannedStep step = schedule.plan(t, bid.dt, bid.reason);
      solver.advance(t, step.dt, 1, {});
      t = step.t_next;
      solver.apply_bcs(t, {});
      count_step(part, t, step.dt);
      ++part.substeps;
      solver.write_tables(t, step.dt, {});
      if (step.output) solver.write_fields(t, part.steps);
      part.compute_s += watch.lap();
      progress.show(part.steps, t, step.dt, part.participant);
      if (session.telemetry_due() || step.end)
        session.publish(telemetry_of(setup, part, solver, step.dt, bid.reason));
      end = step.end;
    }
  };
  try {
    with_step_number(part, loop);
  } catch (const Failure& failure) {
    session.abort(failure.code(), failure.what());
    throw;
  }
}

}  // namespace

void participate(const Setup& setup, io::Part& part, Participant& solver) {
  const wire::Hello hello = solver.hello();
  part.points = hello.points;
  for (const std::string& warning : bus::start_up_warnings()) log_info(warning);
  if (hello.interfaces.empty()) {
    run_alone(setup, part, solver);
  } else {
    CoupledRun(setup, part, solver).run();
  }
  solver.report(part.t, part);
}

}  // namespace fsi
