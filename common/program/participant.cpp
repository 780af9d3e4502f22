#include "common/program/participant.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <vector>

#include "common/case/case.hpp"
#include "common/grid/overlap/disagreement.hpp"
#include "common/grid/ripple.hpp"
#include "common/program/build_id.hpp"
#include "common/program/picture.hpp"
#include "common/program/run/driver.hpp"

namespace fsi {

bus::BusOptions bus_options(const Setup& setup) {
  return {.run = setup.run,
          .key = setup.key,
          .network = setup.network,
          .build = "built for " + instruction_set() + " on a processor with " + processor_kind(),
          .peer_timeout_s = setup.problem.time.peer_timeout,
          .hello_timeout_s = setup.problem.time.join_timeout,
          .pids = setup.pids,
          .step_timeout_s = setup.problem.time.step_timeout,
          .throw_if_interrupted = throw_if_interrupted};
}

wire::Telemetry telemetry_of(const Setup& setup, const io::Part& part, const Participant& solver, double dt,
                             const ProposedTimeStep& proposal) {
  wire::Telemetry telemetry;
  telemetry.state = part.t < setup.problem.time.end ? "computing" : "done";
  telemetry.step = part.steps;
  telemetry.t = part.t;
  telemetry.t_end = setup.problem.time.end;
  telemetry.dt = dt;
  telemetry.dt_reason = proposal.reason;
  telemetry.proposed_dt = proposal.dt;
  telemetry.compute_s = part.compute_s;
  telemetry.wait_s = part.wait_s;
  telemetry.health = solver.health();
  for (const auto& found : {part.noise, part.disagreement, part.strong_shock}) {
    if (!found || !found->much) continue;
    if (!telemetry.noise.empty()) telemetry.noise += "; ";
    telemetry.noise += found->words;
  }
  const double updates = static_cast<double>(part.points) * static_cast<double>(part.substeps);
  telemetry.point_updates_per_s = part.compute_s > 0 ? updates / part.compute_s : 0;
  return telemetry;
}

bus::Draw draw_of(const io::Part& part, Participant& solver, const io::Standing& at) {
  auto fields = std::make_shared<std::vector<io::GridOutput>>();
  return [&part, &solver, at, fields](const std::string& wish) {
    const std::string mine = part.role + ".";
    std::optional<wire::Picture> picture;
    if (!wish.starts_with(mine)) return picture;
    if (fields->empty()) *fields = solver.fields_now();
    picture = picture_of(*fields, wish.substr(mine.size()));
    if (!picture) return picture;
    picture->from = part.participant;
    picture->role = part.role;
    picture->step = at.step;
    picture->t = at.t;
    return picture;
  };
}

/// What a watch has found since the start goes into the part; the log says when it becomes too much.
void note(std::optional<io::Finding>& known, const grid::Watch* watch, double much, const std::string& what) {
  if (watch == nullptr) return;
  const grid::Finding& worst = watch->worst();
  if (known && known->size == worst.size) return;
  const bool said = known && known->much;
  known = {.size = worst.size,
           .much = worst.size > much,
           .field = watch->component_of(worst),
           .grid = watch->grid_of(worst),
           .point = {worst.i, worst.j},
           .place = {worst.place.x(), worst.place.y()},
           .t = worst.t,
           .words = watch->in_words(worst)};
  if (known->much && !said) log_warning(fmt::format("{}: {}", what, known->words));
}

void watch_noise(io::Part& part, Participant& solver, const io::Standing& at, bool now) {
  if (at.step == 0 || (!now && at.step % grid::RippleWatch::every != 0)) return;
  solver.look_for_noise(at.t);
  note(part.noise, solver.noise(), grid::noisy, "noise of the grid's scale");
  note(part.disagreement, solver.disagreement(), grid::torn, "grids disagree where they overlap");
  note(part.strong_shock, solver.strong_shock(), GasScheme::strong_shock, "without shock viscosity");
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
