/// One solver in a coupled run.

#include <cstdint>
#include <vector>

#include "common/bus/sessions/solver_session.hpp"
#include "common/program/run/checkpoints.hpp"
#include "common/program/run/driver.hpp"

namespace fsi {

namespace {

class CoupledRun {
 public:
  CoupledRun(const Setup& setup, io::Part& part, Participant& solver)
      : setup_(setup),
        part_(part),
        solver_(solver),
        hello_(solver.hello()),
        checkpoints_(setup, part, [&solver](Archive& archive) { solver.archive(archive); }),
        at_(checkpoints_.begin()),
        session_(options(), hello_),
        predicted_(hello_.interfaces.size()),
        projected_(hello_.interfaces.size()),
        clock_(part) {
    solver_.use(clock_);
  }

  void run() {
    run_within(session_, [this] {
      with_last_state(solver_, last_, [this] { loop(); });
      session_.leave();
    });
  }

 private:
  bus::BusOptions options() {
    bus::BusOptions options = bus_options(setup_);
    options.throw_if_interrupted = [this] { obey_signals(); };
    return options;
  }

  /// SIGTERM: the coupler is asked to end the run, after a checkpoint.
  void obey_signals() {
    if (asked_to_end() && running_ && !told_) {
      told_ = true;
      session_.ask_to_end();
      since_told_.lap();
    }
    if (waiting_ && session_.waits_watched()) session_.show_missing(draw_of(part_, solver_, at_), at_.step);
    throw_if_interrupted();
  }

  /// A coupler that takes no requests would let the run go on for ever.
  void check_heard() {
    constexpr int steps = 10;
    constexpr double seconds = 10;
    if (!told_ || ++steps_since_told_ < steps) return;
    unheard_s_ += since_told_.lap();
    if (unheard_s_ > seconds)
      throw Failure(ExitCode::terminated, "ended on request (SIGTERM), which the coupler did not obey");
  }

  void loop() {
    running_ = true;
    end_in_good_order();
    last_ = {.t = at_.t, .step = at_.step};
    while (exchange()) {
      const wire::ProjectedInterface& answer = *projected_.front();
      solver_.advance(at_.t, answer.dt_next, answer.substeps_next, projected_);
      at_ = {.step = at_.step + 1, .t = answer.t_next, .dt = answer.dt_next};
      count_step(part_, at_.t, at_.dt);
      part_.substeps += static_cast<std::uint64_t>(answer.substeps_next);
      clock_.lap(io::Work::advance);
      if (answer.write_checkpoint) checkpoints_.save(at_);
      clock_.lap(io::Work::output);
      if (session_.telemetry_due()) session_.publish(telemetry_of(setup_, part_, solver_, at_.dt, proposal_));
      obey_signals();
      check_heard();
    }
  }

  /// From the predicted to the projected state; false at the end of the run.
  bool exchange() {
    publish_predicted();
    receive_projected();
    solver_.apply_bcs(at_.t, projected_);
    clock_.lap(io::Work::boundary);
    last_ = {.t = at_.t, .step = at_.step};
    const wire::ProjectedInterface& answer = *projected_.front();
    watch_noise(part_, solver_, at_, answer.write_output || answer.stop);
    write_results(setup_, part_, [&] { solver_.write_tables(at_.t, at_.dt, projected_); });
    if (answer.write_output) write_results(setup_, part_, [&] { solver_.write_fields(at_.t, at_.step); });
    if (answer.stop) write_results(setup_, part_, [&] { solver_.flush_tables(); });
    if (answer.show) session_.show(draw_of(part_, solver_, at_), at_.step, answer.stop);
    clock_.lap(io::Work::output);
    if (!answer.stop) return true;
    if (!answer.stop_reason.empty()) part_.status = "stopped";
    part_.reason = answer.stop_reason;
    wire::Telemetry last = telemetry_of(setup_, part_, solver_, at_.dt, proposal_);
    last.state = "done";
    session_.publish(last);
    return false;
  }

  void publish_predicted() {
    proposal_ = solver_.compute_time_step();
    clock_.lap(io::Work::time_step);
    for (std::size_t k = 0; k < predicted_.size(); ++k) {
      wire::PredictedInterface& message = predicted_[k];
      message.interface = hello_.interfaces[k].name;
      message.step = at_.step;
      message.t = at_.t;
      message.proposed_dt = proposal_.dt;
      message.dt_reason = proposal_.reason;
      solver_.fill(k, message);
      message.health = solver_.health();
      message.compute_s = part_.compute_s;
      message.wait_s = part_.wait_s;
      session_.publish(message);
    }
    clock_.lap(io::Work::messages);
  }

  void receive_projected() {
    waiting_ = true;
    for (std::size_t k = 0; k < projected_.size(); ++k) {
      projected_[k] = &session_.receive(hello_.interfaces[k].name, at_.step);
    }
    waiting_ = false;
    clock_.lap(io::Work::waiting);
  }

  const Setup& setup_;
  io::Part& part_;
  Participant& solver_;
  wire::Hello hello_;  ///< of the initial state, also after a restart
  Checkpoints checkpoints_;
  io::Standing at_;
  LastState last_;
  bool running_ = false, told_ = false, waiting_ = false;
  int steps_since_told_ = 0;
  double unheard_s_ = 0;
  Stopwatch since_told_;
  bus::SolverSession session_;
  std::vector<wire::PredictedInterface> predicted_;
  std::vector<const wire::ProjectedInterface*> projected_;
  ProposedTimeStep proposal_;
  WorkClock clock_;
};

}  // namespace

void run_coupled(const Setup& setup, io::Part& part, Participant& solver) {
  CoupledRun(setup, part, solver).run();
}

}  // namespace fsi
