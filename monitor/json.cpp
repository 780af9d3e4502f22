#include "monitor/json.hpp"

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "common/io/place_json.hpp"

namespace fsi::monitor {

namespace {

using nlohmann::json;

/// JSON knows no infinity: such numbers become null.
json number(double value) {
  return std::isfinite(value) ? json(value) : json();
}

json number(const std::optional<double>& value) {
  return value ? number(*value) : json();
}

json numbers(const std::vector<double>& values) {
  json result = json::array();
  for (const double value : values) result.push_back(number(value));
  return result;
}

std::string text(const json& object) {
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

json traffic_json(const RunState& state, const wire::Telemetry& program) {
  json all = json::array();
  for (std::size_t k = 0; k < program.traffic.size(); ++k) {
    const wire::Traffic& one = program.traffic[k];
    const TrafficRates rates = state.traffic_rates(program.from, k);
    all.push_back({{"interface", one.interface},
                   {"from", one.from},
                   {"messages", one.messages},
                   {"bytes", one.bytes},
                   {"messages_per_s", number(rates.messages_per_s)},
                   {"bytes_per_s", number(rates.bytes_per_s)},
                   {"missing", one.missing},
                   {"dropped", one.dropped},
                   {"latency_p50_us", number(one.latency_p50_us)},
                   {"latency_p99_us", number(one.latency_p99_us)}});
  }
  return all;
}

json program_json(const RunState& state, const wire::Telemetry& program, double now) {
  const auto& health = program.health;
  const Rates rates = state.rates(program.from);
  return {{"role", program.role},
          {"state", program.state},
          {"standing", state.standing(program.from, now)},
          {"host", program.host},
          {"pid", program.pid},
          {"step", program.step},
          {"t", number(program.t)},
          {"dt", number(program.dt)},
          {"dt_reason", program.dt_reason},
          {"proposed_dt", number(program.proposed_dt)},
          {"traffic", traffic_json(state, program)},
          {"compute_s", number(program.compute_s)},
          {"wait_s", number(program.wait_s)},
          {"computing_share", number(computing_share(program))},
          {"computing_now", number(rates.computing)},
          {"steps_per_s", number(rates.steps_per_s)},
          {"point_updates_per_s", number(program.point_updates_per_s)},
          {"health",
           {{"min_rho", number(health.min_rho)},
            {"min_p", number(health.min_p)},
            {"min_det_F", number(health.min_det_F)},
            {"min_cell_quality", number(health.min_cell_quality)},
            {"first_order_fallbacks", health.first_order_fallbacks},
            {"floors", health.floors}}},
          {"noise", program.noise},
          {"bus",
           {{"messages", program.messages},
            {"bytes", program.bytes},
            {"messages_per_s", number(rates.messages_per_s)},
            {"bytes_per_s", number(rates.bytes_per_s)},
            {"round_trip_p50_us", number(program.round_trip_p50_us)},
            {"round_trip_p99_us", number(program.round_trip_p99_us)}}},
          {"silent_s", number(state.silence(program.from, now))}};
}

json interface_json(const wire::Telemetry::Interface& side) {
  return {{"velocity_jump", number(side.velocity_jump)},
          {"traction_jump", number(side.traction_jump)},
          {"gap", number(side.gap)},
          {"power", number(side.power)},
          {"shear", number(side.shear)},
          {"velocity_scale", number(side.velocity_scale)},
          {"traction_scale", number(side.traction_scale)},
          {"p_min", number(side.p_min)},
          {"p_max", number(side.p_max)},
          {"v_min", number(side.v_min)},
          {"v_max", number(side.v_max)},
          {"closed", side.closed},
          {"s", numbers(side.s)},
          {"x", numbers(side.x)},
          {"x_start", numbers(side.x_start)},
          {"p_predicted", numbers(side.p_predicted)},
          {"p_predicted_solid", numbers(side.p_predicted_solid)},
          {"p_projected", numbers(side.p_projected)},
          {"w_tangential", numbers(side.w_tangential)},
          {"v_predicted", numbers(side.v_predicted)},
          {"v_predicted_gas", numbers(side.v_predicted_gas)},
          {"v_projected", numbers(side.v_projected)}};
}

}  // namespace

std::string to_json(const RunState& state, double now) {
  json result = {{"run", state.run().run},
                 {"case", state.run().name},
                 {"dir", state.run().dir},
                 {"status", state.status()},
                 {"progress", state.progress()},
                 {"steps_per_s", number(state.steps_per_s())},
                 {"remaining_s", number(state.remaining_s())},
                 {"non_finite", state.non_finite()},
                 {"participants", json::object()},
                 {"interfaces", json::object()}};
  if (const wire::Telemetry* leader = state.leader()) {
    result["t"] = number(leader->t);
    result["t_end"] = number(leader->t_end);
    result["dt"] = number(leader->dt);
    result["dt_reason"] = leader->dt_reason;
    result["limited_by"] = leader->limited_by;
    result["limits"] = json::object();
    for (const wire::StepsLimited& one : leader->limits) result["limits"][one.by] = one.steps;
    result["step"] = leader->step;
  }
  for (const auto& side : state.interfaces()) result["interfaces"][side.name] = interface_json(side);
  for (const auto& [name, program] : state.programs()) {
    result["participants"][name] = program_json(state, program, now);
  }
  if (const auto& abort = state.abort()) {
    result["abort"] = {{"from", abort->from},
                       {"exit_code", abort->exit_code},
                       {"place", io::to_json(abort->place)},
                       {"what", abort->what},
                       {"reason", abort->reason()}};
  }
  return text(result);
}

std::string history_json(const RunState& state, double now) {
  json history = json::object(), timeline = json::object();
  for (const auto& [name, series] : state.history().all()) {
    json& points = history[name] = json::array();
    for (const auto& point : series.points()) points.push_back({point.at, number(point.value)});
  }
  for (const auto& [name, line] : state.timeline()) {
    json& points = timeline[name] = json::array();
    for (const auto& point : line) points.push_back({now - point.at, point.value});
  }
  json limiters = json::array();
  for (const Limiters::Change& change : state.history().limiters().changes())
    limiters.push_back({change.t, change.by});
  return text({{"history", history}, {"timeline", timeline}, {"limiters", limiters}});
}

}  // namespace fsi::monitor
