#include "monitor/state.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace fsi::monitor {

namespace {

/// The pace is the mean over this time [s].
constexpr double pace_window_s = 5;
/// A run whose programs are all gone for this time is over [s].
constexpr double end_patience_s = 0.5;

using nlohmann::json;

/// JSON knows no infinity: such numbers become null.
json number(double value) {
  return std::isfinite(value) ? json(value) : json();
}

json numbers(const std::vector<double>& values) {
  json result = json::array();
  for (const double value : values) result.push_back(number(value));
  return result;
}

json program_json(const wire::Telemetry& program, double silence) {
  const auto& health = program.health;
  const auto share = computing_share(program);
  return {{"role", program.role},
          {"state", program.state},
          {"step", program.step},
          {"t", number(program.t)},
          {"dt", number(program.dt)},
          {"dt_reason", program.dt_reason},
          {"compute_s", number(program.compute_s)},
          {"wait_s", number(program.wait_s)},
          {"computing_share", share ? json(*share) : json()},
          {"point_updates_per_s", number(program.point_updates_per_s)},
          {"health",
           {{"min_rho", number(health.min_rho)},
            {"min_p", number(health.min_p)},
            {"min_det_F", number(health.min_det_F)},
            {"first_order_fallbacks", health.first_order_fallbacks},
            {"floors", health.floors}}},
          {"bus",
           {{"messages", program.messages},
            {"bytes", program.bytes},
            {"round_trip_p50_us", number(program.round_trip_p50_us)},
            {"round_trip_p99_us", number(program.round_trip_p99_us)}}},
          {"silent_s", number(silence)}};
}

json interface_json(const wire::Telemetry::Interface& side) {
  return {{"velocity_jump", number(side.velocity_jump)},
          {"traction_jump", number(side.traction_jump)},
          {"gap", number(side.gap)},
          {"power", number(side.power)},
          {"s", numbers(side.s)},
          {"p_predicted", numbers(side.p_predicted)},
          {"p_projected", numbers(side.p_projected)},
          {"v_predicted", numbers(side.v_predicted)},
          {"v_projected", numbers(side.v_projected)}};
}

}  // namespace

void RunState::hear(const wire::Telemetry& telemetry, double now) {
  programs_[telemetry.from] = telemetry;
  heard_at_[telemetry.from] = now;
  if (leader()->from != telemetry.from) return;
  if (pace_of_ != telemetry.from) pace_.clear();
  pace_of_ = telemetry.from;
  pace_.push_back({.now = now, .t = telemetry.t, .step = telemetry.step});
  std::erase_if(pace_, [&](const Moment& moment) { return moment.now < now - pace_window_s; });
}

void RunState::count_programs(int programs, double now) {
  if (programs > 0 || programs_.empty()) {
    empty_since_.reset();
    return;
  }
  if (!empty_since_) empty_since_ = now;
  ended_ = now - *empty_since_ > end_patience_s;
}

const wire::Telemetry* RunState::leader() const {
  for (const auto& [name, program] : programs_) {
    if (program.role == "coupler") return &program;
  }
  return programs_.empty() ? nullptr : &programs_.begin()->second;
}

double RunState::silence(const std::string& program, double now) const {
  return now - heard_at_.at(program);
}

std::string RunState::status() const {
  if (abort_) return "aborted";
  if (ended_) return "ended";
  return programs_.empty() ? "waiting" : "running";
}

double RunState::progress() const {
  const wire::Telemetry* program = leader();
  if (program == nullptr || !(program->t_end > 0)) return 0;
  return std::clamp(program->t / program->t_end, 0.0, 1.0);
}

double RunState::steps_per_s() const {
  if (pace_.size() < 2 || pace_.back().now <= pace_.front().now || pace_.back().step < pace_.front().step)
    return 0;
  return static_cast<double>(pace_.back().step - pace_.front().step) / (pace_.back().now - pace_.front().now);
}

std::optional<double> RunState::remaining_s() const {
  const wire::Telemetry* program = leader();
  if (program == nullptr || pace_.size() < 2 || pace_.back().t <= pace_.front().t) return std::nullopt;
  const double pace = (pace_.back().t - pace_.front().t) / (pace_.back().now - pace_.front().now);
  return std::max(0.0, program->t_end - program->t) / pace;
}

std::optional<double> computing_share(const wire::Telemetry& program) {
  const double total = program.compute_s + program.wait_s;
  if (!(total > 0)) return std::nullopt;
  return program.compute_s / total;
}

std::string to_json(const RunState& state, double now) {
  json result = {{"run", state.run().run},         {"case", state.run().name},
                 {"dir", state.run().dir},         {"status", state.status()},
                 {"progress", state.progress()},   {"steps_per_s", number(state.steps_per_s())},
                 {"participants", json::object()}, {"interfaces", json::object()}};
  const auto remaining = state.remaining_s();
  result["remaining_s"] = remaining ? number(*remaining) : json();
  if (const wire::Telemetry* leader = state.leader()) {
    result["t"] = number(leader->t);
    result["t_end"] = number(leader->t_end);
    result["dt"] = number(leader->dt);
    result["dt_reason"] = leader->dt_reason;
    result["step"] = leader->step;
    for (const auto& side : leader->interfaces) result["interfaces"][side.name] = interface_json(side);
  }
  for (const auto& [name, program] : state.programs()) {
    result["participants"][name] = program_json(program, state.silence(name, now));
  }
  if (const auto& abort = state.abort()) {
    result["abort"] = {{"from", abort->from}, {"exit_code", abort->exit_code}, {"reason", abort->reason}};
  }
  return result.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace fsi::monitor
