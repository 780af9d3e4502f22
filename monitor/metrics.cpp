#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>

#include "monitor/json.hpp"

namespace fsi::monitor {

namespace {

/// A label's value between quotes, as Prometheus wants it.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\\' || c == '"') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string shown(double value) {
  if (std::isfinite(value)) return fmt::format("{}", value);
  return std::isnan(value) ? "NaN" : value > 0 ? "+Inf" : "-Inf";
}

/// Collects the lines, each family of numbers with its explanation before it.
class Page {
 public:
  explicit Page(const std::string& run) : run_("run=" + quoted(run)) {}
  void family(const std::string& name, const std::string& help, const std::string& kind = "gauge") {
    name_ = "amp_fsi_" + name;
    text_ += fmt::format("# HELP {} {}\n# TYPE {} {}\n", name_, help, name_, kind);
  }
  void value(double number, const std::string& labels = "") {
    text_ += fmt::format("{}{{{}{}{}}} {}\n", name_, run_, labels.empty() ? "" : ",", labels, shown(number));
  }
  const std::string& text() const { return text_; }

 private:
  std::string run_, name_, text_;
};

void programs(Page& page, const RunState& state, double now) {
  using Number = std::function<double(const wire::Telemetry&)>;
  const auto each = [&](const std::string& name, const std::string& help, const std::string& kind,
                        const Number& number) {
    page.family(name, help, kind);
    for (const auto& [from, program] : state.programs())
      page.value(number(program), "program=" + quoted(from));
  };
  each("program_up", "1 while the program is heard", "gauge", [&](const auto& program) {
    const std::string standing = state.standing(program.from, now);
    return standing == "alive" || standing == "waiting" || standing == "paused" ? 1.0 : 0.0;
  });
  each("program_steps", "steps the program has taken", "counter",
       [](const auto& p) { return static_cast<double>(p.step); });
  each("compute_seconds", "time computing [s]", "counter", [](const auto& p) { return p.compute_s; });
  each("wait_seconds", "time waiting for others [s]", "counter", [](const auto& p) { return p.wait_s; });
  each("point_updates_per_second", "grid points advanced per second of computing", "gauge",
       [](const auto& p) { return p.point_updates_per_s; });
  each("proposed_step", "step the program proposed last [time]", "gauge",
       [](const auto& p) { return p.proposed_dt; });
  each("bus_messages", "lock-step messages sent and received", "counter",
       [](const auto& p) { return static_cast<double>(p.messages); });
  each("bus_bytes", "payload of these messages [byte]", "counter",
       [](const auto& p) { return static_cast<double>(p.bytes); });
  each("round_trip_p50_seconds", "median round trip [s]", "gauge",
       [](const auto& p) { return 1e-6 * p.round_trip_p50_us; });
  each("round_trip_p99_seconds", "99 % of the round trips are faster [s]", "gauge",
       [](const auto& p) { return 1e-6 * p.round_trip_p99_us; });
}

void traffic(Page& page, const RunState& state) {
  const auto each = [&](const std::string& name, const std::string& help, const std::string& kind,
                        const std::function<double(const wire::Traffic&)>& number) {
    page.family(name, help, kind);
    for (const auto& [to, program] : state.programs()) {
      for (const wire::Traffic& one : program.traffic)
        page.value(number(one), fmt::format("interface={},from={},to={}", quoted(one.interface),
                                            quoted(one.from), quoted(to)));
    }
  };
  each("interface_messages", "lock-step messages received", "counter",
       [](const auto& one) { return static_cast<double>(one.messages); });
  each("interface_bytes", "payload of these messages [byte]", "counter",
       [](const auto& one) { return static_cast<double>(one.bytes); });
  each("interface_missing", "times a message had to be asked for", "counter",
       [](const auto& one) { return static_cast<double>(one.missing); });
  each("interface_dropped", "repeated or late messages", "counter",
       [](const auto& one) { return static_cast<double>(one.dropped); });
  each("latency_p50_seconds", "median time from writing to taking, without waiting for work [s]", "gauge",
       [](const auto& one) { return 1e-6 * one.latency_p50_us; });
  each("latency_p99_seconds", "99 % of these times are shorter [s]", "gauge",
       [](const auto& one) { return 1e-6 * one.latency_p99_us; });
}

void interfaces(Page& page, const RunState& state) {
  using Side = wire::Telemetry::Interface;
  const auto each = [&](const std::string& name, const std::string& help, double Side::*number) {
    page.family(name, help);
    for (const Side& side : state.interfaces()) page.value(side.*number, "interface=" + quoted(side.name));
  };
  each("velocity_jump", "largest velocity jump before the projection [length/time]", &Side::velocity_jump);
  each("traction_jump", "largest traction jump before the projection [force/area]", &Side::traction_jump);
  each("gap", "largest distance of the two sides [length]", &Side::gap);
  each("interface_power", "power of the gas on the solid [power/depth]", &Side::power);
  each("interface_pressure_min", "smallest projected pressure", &Side::p_min);
  each("interface_pressure_max", "largest projected pressure", &Side::p_max);
}

}  // namespace

std::string to_prometheus(const RunState& state, double now) {
  Page page(state.run().run);
  page.family("up", "1 while the run is going on");
  page.value(state.over() || state.programs().empty() ? 0 : 1);
  if (const wire::Telemetry* leader = state.leader()) {
    page.family("time", "simulated time");
    page.value(leader->t);
    page.family("time_end", "simulated time at which the run ends");
    page.value(leader->t_end);
    page.family("step_size", "size of the next step [time]");
    page.value(leader->dt);
    page.family("steps", "coupled steps taken", "counter");
    page.value(static_cast<double>(leader->step));
    page.family("non_finite", "quantities that are not finite numbers");
    page.value(static_cast<double>(state.non_finite().size()));
  }
  programs(page, state, now);
  traffic(page, state);
  interfaces(page, state);
  return page.text();
}

}  // namespace fsi::monitor
