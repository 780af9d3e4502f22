#include "coupler/port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "common/case/scales.hpp"
#include "common/core/log.hpp"
#include "common/program/picture.hpp"

namespace fsi::coupler {

namespace {

bus::CouplerSession join(const Setup& setup) {
  const Case& problem = setup.problem;
  std::vector<bus::Expected> who;
  for (const FluidSpec& fluid : problem.fluids) who.push_back({.role = "fluid", .name = fluid.name});
  for (const SolidSpec& solid : problem.solids) who.push_back({.role = "solid", .name = solid.name});
  return {bus_options(setup), std::move(who), problem.digest};
}

Path path_of(const Case& problem) {
  if (!problem.interface.motion) return {};
  const auto position = [motion = *problem.interface.motion](double x, double y, double t) {
    return Vec2(motion.c1(x, y, t), motion.c2(x, y, t));
  };
  return {.position = position, .time_scale = crossing_time_of(problem.solids.front())};
}

/// Interfaces between two periodic sides of a gas.
std::vector<std::string> periodic_interfaces(const Case& problem) {
  std::vector<std::string> names;
  for (const FluidSpec& fluid : problem.fluids) {
    for (const Side side : all_sides) {
      const BoundarySpec& boundary = fluid.boundary[static_cast<std::size_t>(side)];
      const bool goes_on = fluid.grid.periodic[static_cast<std::size_t>(1 - direction_of(side))];
      if (boundary.kind != BoundaryKind::interface || !goes_on) continue;
      const auto solid = std::ranges::find(problem.solids, boundary.solid, &SolidSpec::name);
      names.push_back(interface_name(*solid, fluid.name));
    }
  }
  return names;
}

/// All interfaces of the case, solid by solid.
std::vector<std::string> interface_names(const Case& problem) {
  std::vector<std::string> names;
  for (const SolidSpec& solid : problem.solids) {
    for (const std::string& fluid : gases_at(solid)) names.push_back(interface_name(solid, fluid));
  }
  return names;
}

CouplerOptions options_of(const Case& problem) {
  const TimeSpec& time = problem.time;
  return {.time = {.end = time.end,
                   .output_times = problem.output.times,
                   .growth = time.growth,
                   .dt_max = time.dt.value_or(0)},
          .start = 0,
          .multirate = time.multirate,
          .robin_order = time.robin_order,
          .combination = {.projection = problem.interface.projection,
                          .wave_curve = problem.interface.riemann == GasResponse::exact},
          .checkpoint_at_end = problem.output.checkpoint_at_end,
          .path = path_of(problem),
          .periodic = periodic_interfaces(problem)};
}

/// The coupler of a run; when the interfaces do not fit, everybody is told why before the run ends.
Coupler coupler_of(const Case& problem, bus::CouplerSession& session) {
  try {
    return {options_of(problem), session.hellos()};
  } catch (const Failure& failure) {
    session.abort(failure);
    throw;
  }
}

/// The programs that propose steps.
std::vector<std::string> proposers(const Case& problem) {
  std::vector<std::string> names;
  for (const FluidSpec& fluid : problem.fluids) names.push_back(fluid.name);
  for (const SolidSpec& solid : problem.solids) names.push_back(solid.name);
  return names;
}

std::vector<std::string> columns_of(const Case& problem) {
  std::vector<std::string> columns{"step", "t [time]", "dt [time]"};
  for (const std::string& name : interface_names(problem)) {
    for (const char* quantity : {"velocity_jump [length/time]", "traction_jump [force/area]", "gap [length]",
                                 "power [power/depth]", "shear [force/area]", "p_max [force/area]"}) {
      columns.push_back(fmt::format("{}.{}", name, quantity));
    }
  }
  for (const std::string& name : proposers(problem)) columns.push_back(name + ".proposed_dt [time]");
  columns.emplace_back("limited_by");
  return columns;
}

}  // namespace

CoupledRun::CoupledRun(const Setup& setup, io::Part& part)
    : setup_(setup),
      part_(part),
      session_(join(setup)),
      coupler_(coupler_of(setup.problem, session_)),
      table_(setup.run_dir + "/interface.csv", columns_of(setup.problem), setup.opening()),
      proposed_(proposers(setup.problem).size(), std::nan("")),
      progress_(setup.problem.time.end),
      checkpoints_(setup, part, [this](Archive& archive) { this->archive(archive); }),
      due_(setup.problem.output),
      clock_(part) {
  part_.points = coupler_.points();
  part_.interface = io::InterfaceExtremes{};
}

void CoupledRun::archive(Archive& archive) {
  coupler_.archive(archive);
  archive.inside("table", [&] { table_.archive(archive); });
  archive.values("proposed", proposed_);
  const std::vector<std::string> names = names_of_limits(setup_.problem);
  auto limit = static_cast<std::size_t>(std::ranges::find(names, limited_by_) - names.begin());
  archive.number("limit", limit);
  if (limit < names.size()) limited_by_ = names[limit];
}

void CoupledRun::run() {
  run_within(session_, [this] {
    loop();
    session_.leave();
  });
}

void CoupledRun::loop() {
  at_ = checkpoints_.begin();
  due_.start(at_.step);
  end_in_good_order();
  ProgressLines::joined();
  while (!coupler_.finished()) {
    exchange();
    throw_if_interrupted();
  }
}

/// Whoever sends the state of a step has written its checkpoint of that step.
void CoupledRun::exchange() {
  const auto predicted = session_.gather(at_.step);
  clock_.lap(io::Work::waiting);
  if (checkpoint_ == at_.step) complete_checkpoint();
  clock_.lap(io::Work::output);
  if (part_.status != "stopped") obey_requests();
  if (session_.watched()) coupler_.request_show(session_.picture_due());
  const std::span<const wire::ProjectedInterface> answers = coupler_.step(predicted);
  if (!coupler_.finished()) ++part_.limited_by[coupler_.next().limited_by];
  clock_.lap(io::Work::advance);
  session_.scatter(answers);
  clock_.lap(io::Work::messages);
  if (coupler_.shown()) session_.show(outline());
  write_results(setup_, part_, [&] { record(); });
  if (coupler_.finished()) write_results(setup_, part_, [&] { table_.flush(); });
  at_ = {.step = at_.step + 1, .t = coupler_.next().plan.t_next, .dt = coupler_.next().plan.dt};
  if (coupler_.checkpoint_asked()) {
    checkpoints_.save(at_);
    checkpoint_ = at_.step;
  }
  clock_.lap(io::Work::output);
  show();
  clock_.lap(io::Work::messages);
}

void CoupledRun::complete_checkpoint() {
  const bool complete = checkpoints_.complete(at_);
  checkpoint_.reset();
  if (!end_.empty()) {
    if (complete) end_ += fmt::format(", after a checkpoint of step {}", at_.step);
    throw Failure(ExitCode::terminated, end_);
  }
  if (!stop_) return;
  part_.status = "stopped";
  part_.reason = "stopped on request";
  coupler_.request_stop(part_.reason);
}

void CoupledRun::obey(Request request, bool& checkpoint) {
  switch (request) {
    case Request::pause:
      paused_ = true;
      break;
    case Request::resume:
      paused_ = false;
      break;
    case Request::checkpoint:
      checkpoint = true;
      break;
    case Request::stop:
      stop_ = true;
      break;
  }
}

/// While everybody waits for the answer to what was gathered. A pause waits here; a checkpoint, also that
/// before an end, is one of the step that the answer leads to.
void CoupledRun::obey_requests() {
  bool checkpoint = due_.due(at_.step + 1), told = false;
  if (setup_.pause_at == at_.step) {
    paused_ = true;
    log_info(fmt::format("paused after {} steps", at_.step));
  }
  while (true) {
    for (const wire::Control& control : session_.controls()) {
      log_info(fmt::format("request: {}", control.command));
      if (const auto request = named<Request>(control.command))
        obey(*request, checkpoint);
      else if (control.command.starts_with(terminate_word))
        end_ = fmt::format("ended on request (SIGTERM to {})", control.command.substr(terminate_word.size()));
    }
    if (asked_to_end()) end_ = "ended on request (SIGTERM)";
    checkpoint = checkpoint || stop_ || !end_.empty();
    if (!paused_ || checkpoint) break;
    if (at_.step > 0 && !std::exchange(told, true)) publish();  // nothing further will be heard of this step
    session_.idle(0.1);
    clock_.lap(io::Work::waiting);
  }
  if (!checkpoint) return;
  coupler_.request_checkpoint();
  due_.start(at_.step + 1);  // asked for, not complete: that takes another exchange
}

void CoupledRun::record() {
  if (coupler_.dt() > 0) {
    count_step(part_, coupler_.t(), coupler_.dt());
    ++part_.substeps;
  }
  std::vector<double> row{static_cast<double>(coupler_.step_number()), coupler_.t(), coupler_.dt()};
  io::InterfaceExtremes& extremes = *part_.interface;
  const std::vector<InterfaceReport> reports = coupler_.reports();
  for (const std::string& name : interface_names(setup_.problem)) {
    const auto report = std::ranges::find(reports, name, &InterfaceReport::name);
    if (report == reports.end()) continue;
    row.insert(row.end(), {report->velocity_jump, report->traction_jump, report->gap, report->power,
                           report->shear, report->p_max});
    extremes.max_velocity_jump = std::max(extremes.max_velocity_jump, report->velocity_jump);
    extremes.max_traction_jump = std::max(extremes.max_traction_jump, report->traction_jump);
    extremes.max_gap = std::max(extremes.max_gap, report->gap);
    extremes.velocity_scale = std::max(extremes.velocity_scale, report->velocity_scale);
    extremes.traction_scale = std::max(extremes.traction_scale, report->traction_scale);
    part_.counters["vacuum_points"] += static_cast<double>(report->vacuum);
  }
  row.insert(row.end(), proposed_.begin(), proposed_.end());
  const std::string limit = limited_by_;
  note_agreement();
  table_.row(row, limit);
}

void CoupledRun::note_agreement() {
  if (coupler_.finished()) return;
  const std::vector<std::string> names = proposers(setup_.problem);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto proposal = std::ranges::find(coupler_.proposals(), names[k], &Proposal::from);
    proposed_[k] = proposal == coupler_.proposals().end() ? std::nan("") : proposal->dt;
  }
  limited_by_ = coupler_.next().limited_by;
}

/// The interfaces where they are, with the pressure on them.
wire::Picture CoupledRun::outline() const {
  wire::Picture picture;
  picture.from = part_.participant;
  picture.quantity = "outline";
  picture.role = part_.role;
  picture.step = coupler_.step_number();
  picture.t = coupler_.t();
  std::vector<std::vector<double>> values;
  for (const wire::Telemetry::Interface& side : coupler_.profiles()) {
    wire::Picture::Grid& curve = picture.grids.emplace_back();
    curve.name = side.name;
    curve.n1 = static_cast<std::uint32_t>(side.s.size());
    curve.n2 = 1;
    for (const double x : side.x) curve.x.push_back(static_cast<float>(x));
    values.push_back(side.p_projected);
  }
  set_levels(picture, values);
  return picture;
}

void CoupledRun::show() {
  const AgreedStep& next = coupler_.next();
  progress_.show(coupler_.step_number(), coupler_.t(), next.plan.dt, next.limited_by);
  if (session_.telemetry_due() || coupler_.finished()) publish();
}

void CoupledRun::publish() {
  const AgreedStep& next = coupler_.next();
  wire::Telemetry telemetry;
  telemetry.state = coupler_.finished() ? "done" : "computing";
  telemetry.step = coupler_.step_number();
  telemetry.t = coupler_.t();
  telemetry.t_end = setup_.problem.time.end;
  telemetry.dt = coupler_.finished() ? coupler_.dt() : next.plan.dt;
  if (!coupler_.finished()) telemetry.dt_reason = fmt::format("{}: {}", next.limited_by, next.reason);
  telemetry.proposed_dt = telemetry.dt;
  telemetry.limited_by = next.limited_by;
  telemetry.limits = limits_of(part_);
  telemetry.compute_s = part_.compute_s;
  telemetry.wait_s = part_.wait_s;
  telemetry.interfaces = coupler_.profiles();
  session_.publish(telemetry);
}

}  // namespace fsi::coupler
