#include "monitor/state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fsi::monitor {

namespace {

/// Rates are means over this time [s].
constexpr double pace_window_s = 5;
/// A run whose programs are all gone for this time is over [s].
constexpr double end_patience_s = 0.5;
/// A program that says nothing for this time is silent [s]: longer than a program that waits or computes a
/// step of usual size ever is.
constexpr double silent_after_s = 2;
/// Entries of the timeline of each program: about a minute.
constexpr std::size_t timeline_length = 600;
/// Messages of each program that the rates are taken from, at most.
constexpr std::size_t longest_pace = 4096;
/// Programs that are listened to: more than a run has. Anybody may send telemetry under any name.
constexpr std::size_t most_programs = 256;
constexpr std::size_t longest_name = 256;  ///< of a program

bool finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Rate of something counted, 0 where the counter began again.
double per_second(std::uint64_t before, std::uint64_t after, double seconds) {
  return after < before ? 0 : static_cast<double>(after - before) / seconds;
}

std::optional<double> share(double compute_s, double wait_s) {
  if (!(compute_s + wait_s > 0)) return std::nullopt;
  return std::clamp(compute_s / (compute_s + wait_s), 0.0, 1.0);
}

/// A name that no program of a run has, or one more than any run has programs, would only fill the memory.
bool welcome(const std::map<std::string, wire::Telemetry>& programs, const wire::Telemetry& telemetry) {
  const bool known = programs.contains(telemetry.from);
  return (known || (telemetry.from.size() <= longest_name && programs.size() < most_programs)) &&
         telemetry.interfaces.size() <= most_programs && telemetry.traffic.size() <= most_programs;
}

}  // namespace

void RunState::hear(const wire::Telemetry& telemetry, double now) {
  if (!welcome(programs_, telemetry)) return;
  note_timeline(telemetry, now);
  programs_[telemetry.from] = telemetry;
  heard_at_[telemetry.from] = now;
  auto& pace = pace_[telemetry.from];
  pace.push_back({.now = now,
                  .t = telemetry.t,
                  .compute_s = telemetry.compute_s,
                  .wait_s = telemetry.wait_s,
                  .step = telemetry.step,
                  .messages = telemetry.messages,
                  .bytes = telemetry.bytes});
  for (const wire::Traffic& one : telemetry.traffic)
    pace.back().traffic.push_back({.messages = one.messages, .bytes = one.bytes});
  while (pace.front().now < now - pace_window_s || pace.size() > longest_pace) pace.pop_front();
  if (leader()->from == telemetry.from) history_.add(telemetry);
  if (telemetry.role != "coupler")
    history_.add(telemetry.from + ".proposed_dt", telemetry.t, telemetry.proposed_dt);
}

/// What it did since it was heard last; what a program does that is being waited for shows when it is done.
void RunState::note_timeline(const wire::Telemetry& telemetry, double now) {
  const auto before = programs_.find(telemetry.from);
  if (before == programs_.end()) return;
  const auto busy =
      share(telemetry.compute_s - before->second.compute_s, telemetry.wait_s - before->second.wait_s);
  auto& line = timeline_[telemetry.from];
  line.push_back({.at = now, .value = busy.value_or(0)});
  if (line.size() > timeline_length) line.pop_front();
}

void RunState::count_programs(int programs, double now) {
  const auto lives = [](const auto& seen) {
    return seen.second == Process::lives || seen.second == Process::stopped;
  };
  if (programs > 0 || programs_.empty() || std::ranges::any_of(processes_, lives)) {
    empty_since_.reset();
    return;
  }
  if (!empty_since_) empty_since_ = now;
  ended_ = ended_ || now - *empty_since_ > end_patience_s;
}

const wire::Telemetry* RunState::leader() const {
  for (const auto& [name, program] : programs_) {
    if (program.role == "coupler") return &program;
  }
  return programs_.empty() ? nullptr : &programs_.begin()->second;
}

const std::vector<wire::Telemetry::Interface>& RunState::interfaces() const {
  static const std::vector<wire::Telemetry::Interface> none;
  const wire::Telemetry* speaker = leader();
  return speaker == nullptr ? none : speaker->interfaces;
}

double RunState::silence(const std::string& program, double now) const {
  return now - heard_at_.at(program);
}

std::string RunState::standing(const std::string& program, double now) const {
  const std::string& said = programs_.at(program).state;
  if (said == "done") return said;
  const auto process = processes_.find(program);
  const Process seen = process == processes_.end() ? Process::unknown : process->second;
  if (abort_ && abort_->from == program) return "failed";
  if (seen == Process::gone) return "lost";
  if (seen == Process::stopped) return "stopped";
  if (!over() && silence(program, now) > silent_after_s) return "silent";
  return said == "waiting" || said == "paused" ? said : "alive";
}

RunState::Window RunState::window(const std::string& program) const {
  const auto pace = pace_.find(program);
  if (pace == pace_.end() || pace->second.size() < 2) return {};
  const Moment &first = pace->second.front(), &last = pace->second.back();
  if (last.now <= first.now) return {};
  return {.first = &first, .last = &last};
}

Rates RunState::rates(const std::string& program) const {
  const auto [first, last] = window(program);
  if (first == nullptr) return {};
  const double seconds = last->now - first->now;
  return {.steps_per_s = per_second(first->step, last->step, seconds),
          .messages_per_s = per_second(first->messages, last->messages, seconds),
          .bytes_per_s = per_second(first->bytes, last->bytes, seconds),
          .computing = share(last->compute_s - first->compute_s, last->wait_s - first->wait_s)};
}

TrafficRates RunState::traffic_rates(const std::string& program, std::size_t k) const {
  const auto [first, last] = window(program);
  if (first == nullptr || k >= first->traffic.size() || k >= last->traffic.size()) return {};
  const double seconds = last->now - first->now;
  return {.messages_per_s = per_second(first->traffic[k].messages, last->traffic[k].messages, seconds),
          .bytes_per_s = per_second(first->traffic[k].bytes, last->traffic[k].bytes, seconds)};
}

std::string RunState::status() const {
  if (abort_) return "aborted";
  if (ended_) return "ended";
  if (programs_.empty()) return "waiting";
  return leader()->state == "paused" ? "paused" : "running";
}

std::vector<std::string> RunState::non_finite() const {
  std::vector<std::string> found;
  for (const auto& [name, program] : programs_) {
    const wire::Health& health = program.health;
    if (!finite({health.min_rho, health.min_p, health.min_det_F}))
      found.push_back(fmt::format("health of {}", name));
  }
  for (const auto& side : interfaces()) {
    const std::array<std::pair<const char*, const std::vector<double>*>, 7> all = {
        {{"p of the gas", &side.p_predicted},
         {"p of the solid", &side.p_predicted_solid},
         {"projected p", &side.p_projected},
         {"v_n of the solid", &side.v_predicted},
         {"v_n of the gas", &side.v_predicted_gas},
         {"projected v_n", &side.v_projected},
         {"tangential traction", &side.w_tangential}}};
    for (const auto& [what, values] : all) {
      if (!finite(*values)) found.push_back(fmt::format("{} at {}", what, side.name));
    }
    if (!finite({side.velocity_jump, side.traction_jump, side.gap, side.power})) {
      found.push_back(fmt::format("jumps at {}", side.name));
    }
  }
  return found;
}

double RunState::progress() const {
  const wire::Telemetry* program = leader();
  if (program == nullptr || !(program->t_end > 0)) return 0;
  return std::clamp(program->t / program->t_end, 0.0, 1.0);
}

double RunState::steps_per_s() const {
  const wire::Telemetry* program = leader();
  return program == nullptr ? 0 : rates(program->from).steps_per_s;
}

std::optional<double> RunState::remaining_s() const {
  const wire::Telemetry* program = leader();
  if (program == nullptr) return std::nullopt;
  const auto [first, last] = window(program->from);
  if (first == nullptr || last->t <= first->t) return std::nullopt;
  return std::max(0.0, program->t_end - program->t) * (last->now - first->now) / (last->t - first->t);
}

std::optional<double> computing_share(const wire::Telemetry& program) {
  return share(program.compute_s, program.wait_s);
}

}  // namespace fsi::monitor
