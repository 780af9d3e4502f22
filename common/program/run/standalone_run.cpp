/// A solver without interfaces.

#include <fmt/format.h>

#include <utility>

#include "common/bus/sessions/solo_session.hpp"
#include "common/core/time/time_schedule.hpp"
#include "common/program/run/checkpoints.hpp"
#include "common/program/run/driver.hpp"
#include "common/program/run/standalone_watch.hpp"
#include "common/wire/request.hpp"

namespace fsi {

namespace {

class StandaloneRun {
 public:
  StandaloneRun(const Setup& setup, io::Part& part, Participant& solver)
      : setup_(setup),
        part_(part),
        solver_(solver),
        session_(bus_options(setup), part.role, part.participant),
        schedule_({.end = setup.problem.time.end,
                   .output_times = setup.problem.output.times,
                   .growth = setup.problem.time.growth,
                   .dt_max = setup.problem.time.dt.value_or(0)}),
        progress_(setup.problem.time.end),
        checkpoints_(setup, part, [this](Archive& archive) { this->archive(archive); }),
        due_(setup.problem.output),
        clock_(part),
        watch_(setup, part) {
    solver_.use(clock_);
  }

  void run() {
    run_within(session_, [this] { with_last_state(solver_, last_, [this] { loop(); }); });
  }

 private:
  void archive(Archive& archive) {
    solver_.archive(archive);
    archive.inside("schedule", [&] { schedule_.archive(archive); });
  }

  void loop() {
    at_ = checkpoints_.begin();
    begun_at_ = at_.step;
    end_in_good_order();
    due_.start(at_.step);
    last_ = {.t = at_.t, .step = at_.step};
    if (setup_.restart.empty()) {
      solver_.apply_bcs(0, {});
      write(schedule_.output_at_start());
    } else {
      end_ = schedule_.is_end(at_.t);
      if (end_) watch_noise(part_, solver_, at_, true);
    }
    while (!end_ && go_on()) {
      advance();
      last_ = {.t = at_.t, .step = at_.step};
      watch_.end_step();
    }
    if (end_ && at_.step > begun_at_ && setup_.problem.output.checkpoint_at_end) save();
    write_results(setup_, part_, [&] { solver_.flush_tables(); });
  }

  void advance() {
    proposal_ = solver_.compute_time_step();
    clock_.lap(io::Work::time_step);
    const PlannedStep step = schedule_.plan(at_.t, proposal_.dt, proposal_.reason);
    limited_by_ = name_of(step.limit, part_.participant);
    ++part_.limited_by[limited_by_];
    solver_.advance(at_.t, step.dt, 1, {});
    clock_.lap(io::Work::advance);
    at_ = {.step = at_.step + 1, .t = step.t_next, .dt = step.dt};
    solver_.apply_bcs(at_.t, {});
    clock_.lap(io::Work::boundary);
    count_step(part_, at_.t, at_.dt);
    ++part_.substeps;
    watch_noise(part_, solver_, at_, step.output || step.end);
    write(step.output);
    clock_.lap(io::Work::output);
    progress_.show(part_.steps, at_.t, at_.dt, limited_by_);
    if (session_.telemetry_due() || step.end) publish(proposal_);
    if (session_.picture_due()) session_.show(draw_of(part_, solver_, at_), at_.step, step.end);
    clock_.lap(io::Work::messages);
    end_ = step.end;
  }

  void publish(const ProposedTimeStep& proposal) {
    wire::Telemetry telemetry = telemetry_of(setup_, part_, solver_, at_.dt, proposal);
    telemetry.limited_by = limited_by_;
    telemetry.limits = limits_of(part_);
    session_.publish(telemetry);
  }

  void write(bool fields) {
    write_results(setup_, part_, [&] { solver_.write_tables(at_.t, at_.dt, {}); });
    if (fields) write_results(setup_, part_, [&] { solver_.write_fields(at_.t, at_.step); });
    fields_written_ = fields;
  }

  /// Obeys requests from outside; false when the run shall stop.
  bool go_on() {
    bool told = false;
    if (due_.due(at_.step)) save();
    if (setup_.pause_at == at_.step) {
      paused_ = true;
      log_info(fmt::format("paused after {} steps", at_.step));
    }
    do {
      for (const wire::Control& control : session_.controls()) {
        if (const auto request = named<Request>(control.command)) obey(*request);
      }
      if (stop_ || asked_to_end()) break;
      if (!paused_) continue;
      if (at_.step > begun_at_ && !std::exchange(told, true))
        publish(proposal_);  // else nobody hears of this step
      session_.idle(0.1);
      session_.show_missing(draw_of(part_, solver_, at_), at_.step);
      watch_.begin_step();
      clock_.lap(io::Work::waiting);
    } while (paused_);
    throw_if_interrupted();
    if (!stop_ && !asked_to_end()) return true;
    if (asked_to_end() && at_.step == begun_at_)
      throw Failure(ExitCode::terminated, "ended on request (SIGTERM), before its first step");
    save();
    if (asked_to_end())
      throw Failure(ExitCode::terminated,
                    fmt::format("ended on request (SIGTERM), after a checkpoint of step {}", at_.step));
    if (!fields_written_) write_results(setup_, part_, [&] { solver_.write_fields(at_.t, at_.step); });
    part_.status = "stopped";
    part_.reason = "stopped on request";
    return false;
  }

  void obey(Request request) {
    switch (request) {
      case Request::pause:
        paused_ = true;
        break;
      case Request::resume:
        paused_ = false;
        break;
      case Request::checkpoint:
        save();
        break;
      case Request::stop:
        stop_ = true;
        break;
    }
  }

  void save() {
    checkpoints_.save(at_);
    checkpoints_.complete(at_);
    due_.start(at_.step);
    clock_.lap(io::Work::output);
  }

  const Setup& setup_;
  io::Part& part_;
  Participant& solver_;
  bus::SoloSession session_;
  TimeSchedule schedule_;
  ProgressLines progress_;
  Checkpoints checkpoints_;
  CheckpointClock due_;
  io::Standing at_;
  std::uint64_t begun_at_ = 0;  ///< step
  ProposedTimeStep proposal_;   ///< of the last step
  std::string limited_by_;      ///< of the last step: the solver, or a setting
  LastState last_;
  WorkClock clock_;
  bool end_ = false, fields_written_ = true, paused_ = false, stop_ = false;
  StandaloneWatch watch_;
};

}  // namespace

void run_alone(const Setup& setup, io::Part& part, Participant& solver) {
  StandaloneRun(setup, part, solver).run();
}

}  // namespace fsi
