#include "common/program/run/checkpoints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "common/case/report/summary.hpp"
#include "common/core/log.hpp"
#include "common/core/time/time_schedule.hpp"
#include "common/program/build_id.hpp"

namespace fsi {

std::vector<std::string> names_of_limits(const Case& problem) {
  std::vector<std::string> names;
  for (const ParticipantSummary& one : participants_of(problem)) names.push_back(one.name);
  for (const StepLimit limit : {StepLimit::growth, StepLimit::largest, StepLimit::output})
    names.push_back(name_of(limit, {}));
  return names;
}

namespace {

/// Steps by who limited them.
void archive_limits(Archive& archive, io::Part& part, const Case& problem) {
  const std::vector<std::string> names = names_of_limits(problem);
  std::vector<double> counts;
  for (const std::string& name : names)
    counts.push_back(part.limited_by.contains(name) ? static_cast<double>(part.limited_by[name]) : 0);
  archive.values("limited_by", counts);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (counts[k] > 0) part.limited_by[names[k]] = static_cast<std::uint64_t>(counts[k]);
  }
}

/// What the report has counted so far.
void archive_part(Archive& archive, io::Part& part) {
  double lost = part.counters.contains(lost_outputs) ? part.counters[lost_outputs] : 0;
  archive.number(lost_outputs, lost);
  if (lost > 0) part.counters[lost_outputs] = lost;
  archive.number("t", part.t);
  archive.number("steps", part.steps);
  archive.number("substeps", part.substeps);
  archive.number("dt_min", part.dt_min);
  archive.number("dt_max", part.dt_max);
  archive.number("compute_s", part.compute_s);
  archive.number("wait_s", part.wait_s);
  archive.values("time_s", part.time_s);
  if (!part.interface) return;
  archive.number("max_velocity_jump", part.interface->max_velocity_jump);
  archive.number("max_traction_jump", part.interface->max_traction_jump);
  archive.number("max_gap", part.interface->max_gap);
  archive.number("velocity_scale", part.interface->velocity_scale);
  archive.number("traction_scale", part.interface->traction_scale);
  archive.number("vacuum_points", part.counters["vacuum_points"]);
}

}  // namespace

Checkpoints::Checkpoints(const Setup& setup, io::Part& part, std::function<void(Archive&)> state)
    : setup_(setup), part_(part), state_(std::move(state)) {}

io::CheckpointOrigin Checkpoints::origin() const {
  return {.participant = setup_.name,
          .case_digest = setup_.problem.restart_digest,
          .build = build_id(),
          .processor = processor_kind()};
}

void Checkpoints::archive(Archive& archive) {
  archive.inside("report", [&] {
    archive_part(archive, part_);
    archive_limits(archive, part_, setup_.problem);
  });
  archive.inside("state", [&] { state_(archive); });
}

io::Standing Checkpoints::begin() {
  if (setup_.restart.empty()) return {};
  io::LoadedCheckpoint loaded = io::read_checkpoint(setup_.restart, origin());
  archive(loaded.state);
  loaded.state.check_all_loaded();
  log_info(fmt::format("goes on from the checkpoint of step {}, t = {:.6g}", loaded.at.step, loaded.at.t));
  return loaded.at;
}

void Checkpoints::save(const io::Standing& at) {
  write_results(setup_, part_, [&] {
    Archive saved;
    try {
      archive(saved);
    } catch (const OutputFailed& failure) {  // lines of a table, and with them the checkpoint
      throw OutputFailed(failure.what(), failure.lost() + 1);
    }
    io::write_checkpoint(setup_.run_dir, origin(), at, saved);
  });
}

bool Checkpoints::complete(const io::Standing& at) {
  bool complete = false;
  write_results(setup_, part_, [&] {
    std::vector<std::string> names;
    for (const ParticipantSummary& one : participants_of(setup_.problem)) names.push_back(one.name);
    const std::vector<std::string> missing =
        io::complete_checkpoint(setup_.run_dir, at, names, setup_.problem.restart_digest);
    complete = missing.empty();
    if (complete) {
      log_info(fmt::format("checkpoint of step {}, t = {:.6g}", at.step, at.t));
    } else {
      log_warning(
          fmt::format("no checkpoint of step {}: {} wrote nothing", at.step, fmt::join(missing, ", ")));
    }
  });
  return complete;
}

bool CheckpointClock::due(std::uint64_t step) const {
  if (step <= last_) return false;
  if (every_ > 0 && step % every_ == 0) return true;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_time_).count() >= seconds_;
}

void CheckpointClock::start(std::uint64_t step) {
  last_ = step;
  last_time_ = std::chrono::steady_clock::now();
}

}  // namespace fsi
