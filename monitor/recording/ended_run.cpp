#include "monitor/recording/ended_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "common/core/failure.hpp"
#include "common/io/place_json.hpp"

namespace fsi::monitor {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json object_in(const fs::path& path) {
  std::ifstream file(path);
  json content = json::parse(file, nullptr, false);
  return content.is_object() ? content : json();
}

/// What is not finite is written as null.
double number(const json& part, const char* key, double missing = 0) {
  const auto found = part.find(key);
  if (found == part.end()) return missing;
  if (found->is_null()) return std::nan("");
  return found->is_number() ? found->get<double>() : missing;
}

std::uint64_t counted(const json& part, const char* key) {
  const double found = number(part, key);
  return found > 0 ? static_cast<std::uint64_t>(found) : 0;
}

std::string words(const json& part, const char* key) {
  const auto found = part.find(key);
  return found != part.end() && found->is_string() ? found->get<std::string>() : "";
}

/// What a program reported at its end, as it would have said it.
/// @param t_end of the run, where that is known
wire::Telemetry last_words(const json& part, const std::optional<double>& t_end) {
  const json health = part.value("health", json::object()), counters = part.value("counters", json::object());
  wire::Telemetry said;
  said.from = words(part, "participant");
  said.role = words(part, "role");
  said.state = "done";
  said.step = counted(part, "steps");
  said.t = number(part, "t");
  said.t_end = t_end.value_or(said.t);
  said.compute_s = number(part, "compute_s");
  said.wait_s = number(part, "wait_s");
  said.point_updates_per_s = number(part, "point_updates_per_s");
  said.proposed_dt = std::nan("");
  said.health = {.min_rho = number(health, "min_rho"),
                 .min_p = number(health, "min_p"),
                 .min_det_F = number(health, "min_det_F"),
                 .min_cell_quality = number(health, "min_cell_quality", 1),
                 .first_order_fallbacks = counted(counters, "first_order_fallbacks"),
                 .floors = counted(counters, "floors")};
  const json limits = part.value("dt_limited_by", json::object());
  for (const auto& [by, steps] : limits.items())
    said.limits.push_back({.by = by, .steps = steps.get<std::uint64_t>()});
  const auto most = std::ranges::max_element(said.limits, {}, &wire::StepsLimited::steps);
  if (most != said.limits.end()) said.limited_by = said.dt_reason = most->by;
  return said;
}

/// The last value of a column of the table; not the last point of its history, which is the largest of several
/// lines in a long run.
double last_of(const History& history, const std::string& column, double missing) {
  const auto& newest = history.of(column).newest();
  return newest ? newest->value : missing;
}

/// The interfaces as the last line of the coupler's table has them.
std::vector<wire::Telemetry::Interface> interfaces_of(const History& history, const json& part) {
  const std::string gap = ".gap";
  const json scales = part.value("interface", json::object());
  std::vector<wire::Telemetry::Interface> sides;
  for (const auto& [name, series] : history.all()) {
    if (!name.ends_with(gap)) continue;
    wire::Telemetry::Interface side;
    side.name = name.substr(0, name.size() - gap.size());
    const auto last = [&](const std::string& what, double missing = 0) {
      return last_of(history, side.name + what, missing);
    };
    side.velocity_jump = last(".velocity_jump");
    side.traction_jump = last(".traction_jump");
    side.gap = last(gap);
    side.power = last(".power");
    side.velocity_scale = number(scales, "velocity_scale");
    side.traction_scale = number(scales, "traction_scale");
    side.shear = last(".shear", std::nan(""));
    side.p_max = last(".p_max", std::nan(""));
    side.p_min = side.v_min = side.v_max = std::nan("");  // nobody wrote them
    sides.push_back(std::move(side));
  }
  return sides;
}

/// Adds to what a program reported what the last line of the coupler's table says of it.
void add_last_line(wire::Telemetry& said, const History& history, const json& part) {
  if (said.t > 0) said.dt = last_of(history, "dt", said.dt);
  said.proposed_dt = last_of(history, said.from + ".proposed_dt", said.proposed_dt);
  if (said.role != "coupler") return;
  said.interfaces = interfaces_of(history, part);
  const auto& changes = history.limiters().changes();
  if (!changes.empty()) said.limited_by = said.dt_reason = changes.back().by;  // else who did most often
}

}  // namespace

std::optional<Ending> ending_of(const std::string& run_dir) {
  const json summary = object_in(fs::path(run_dir) / "summary.json");
  if (summary.is_null()) return std::nullopt;
  Ending ending{.name = words(summary, "case"), .t_end = std::nullopt, .abort = std::nullopt};
  if (const double t_end = number(summary, "t_end"); t_end > 0) ending.t_end = t_end;
  if (words(summary, "status") != "failed") return ending;
  const json failure = summary.value("failure", json::object());
  ending.abort = wire::Abort{.run = {},
                             .from = "launcher",
                             .exit_code = static_cast<std::int32_t>(counted(failure, "exit_code")),
                             .place = {},
                             .what = words(summary, "reason")};
  try {
    ending.abort->place = io::place_of(failure);
    ending.abort->from = failure.value("told_by", ending.abort->from);
    ending.abort->what = failure.value("what", ending.abort->what);
  } catch (const json::exception&) {  // of another version
    return ending;
  }
  return ending;
}

EndedRun::EndedRun(const std::string& run_dir) {
  const auto ending = ending_of(run_dir);
  if (!ending)
    throw UserMistake(fmt::format(
        "--replay: '{}' holds no summary.json: give a recording, or the folder of a run that is over",
        run_dir));
  ending_ = *ending;
  const fs::path folder = fs::weakly_canonical(run_dir);
  run_ = {.run = folder.filename().string(), .name = ending_.name, .dir = folder.string()};
}

void EndedRun::listen(RunState& state, double /*seconds*/) {
  if (state.over()) return;
  state.read_table(run_.dir + "/interface.csv");
  std::error_code none;
  std::set<fs::path> parts;
  for (const auto& entry : fs::directory_iterator(run_.dir + "/parts", none)) parts.insert(entry.path());
  for (const fs::path& path : parts) {
    try {
      const json part = object_in(path);
      if (part.is_null()) continue;
      wire::Telemetry said = last_words(part, ending_.t_end);
      add_last_line(said, state.history(), part);
      state.hear(said, 0);
    } catch (const json::exception&) {  // of another version
      continue;
    }
  }
  if (ending_.abort) state.hear(*ending_.abort);
  state.end();
}

std::string EndedRun::request(Request request) {
  return fmt::format("{}: the run is over", name_of(request));
}

}  // namespace fsi::monitor
