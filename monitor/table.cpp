#include "monitor/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace fsi::monitor {

namespace {

/// A program that says nothing for this time is shown as silent [s].
constexpr double silent_after_s = 2;

/// First `width` bytes, without control characters: names come from outside.
std::string cell(std::string_view text, std::size_t width) {
  std::string result(text.substr(0, width));
  std::ranges::replace_if(
      result, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return result;
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.0f} %", 100 * *share) : "-";
}

std::string bar(double progress, int width) {
  const int full = static_cast<int>(std::lround(progress * width));
  return fmt::format("[{}{}]", std::string(static_cast<std::size_t>(full), '#'),
                     std::string(static_cast<std::size_t>(width - full), '.'));
}

std::string title(const RunState& state, int columns) {
  const std::string status = state.status();
  const int width = columns - static_cast<int>(status.size()) - 1;
  return fmt::format("{:<{}} {}",
                     cell(fmt::format("AMP-FSI  {}  {}", state.run().name, state.run().run),
                          static_cast<std::size_t>(std::max(0, width))),
                     width, status);
}

std::vector<std::string> heading(const RunState& state, int columns) {
  std::vector<std::string> lines = {title(state, columns), ""};
  const wire::Telemetry* leader = state.leader();
  if (leader == nullptr) {
    lines.emplace_back("nothing heard yet");
    return lines;
  }
  constexpr int beside_bar = 50;
  lines.push_back(fmt::format("t = {:.6g} of {:.6g}  {} {:.1f} %", leader->t, leader->t_end,
                              bar(state.progress(), std::clamp(columns - beside_bar, 10, 60)),
                              100 * state.progress()));
  const auto remaining = state.remaining_s();
  lines.push_back(fmt::format("step {}   dt = {:.4g}   {:.1f} steps/s   remaining {}", leader->step,
                              leader->dt, state.steps_per_s(), remaining ? duration_text(*remaining) : "-"));
  if (!leader->dt_reason.empty()) lines.push_back("dt is limited by " + leader->dt_reason);
  return lines;
}

std::string program_line(const wire::Telemetry& program, double silence) {
  const std::string rate =
      program.point_updates_per_s > 0 ? fmt::format("{:.2f}", 1e-6 * program.point_updates_per_s) : "-";
  const std::string trip =
      program.round_trip_p50_us > 0
          ? fmt::format("{:.0f}/{:.0f}", program.round_trip_p50_us, program.round_trip_p99_us)
          : "-";
  const std::string shown_state =
      silence > silent_after_s ? fmt::format("silent {:.0f} s", silence) : cell(program.state, 11);
  return fmt::format("{:<14} {:<11} {:>9} {:>9} {:>9} {:>11} {:>9}", cell(program.from, 14), shown_state,
                     program.step, percent(computing_share(program)), rate, trip,
                     fmt::format("{:.1f}", 1e-6 * static_cast<double>(program.bytes)));
}

std::vector<std::string> programs(const RunState& state, double now) {
  std::vector<std::string> lines = {
      "", fmt::format("{:<14} {:<11} {:>9} {:>9} {:>9} {:>11} {:>9}", "program", "state", "step", "computing",
                      "Mpoints/s", "p50/p99 us", "MB")};
  for (const auto& [name, program] : state.programs())
    lines.push_back(program_line(program, state.silence(name, now)));
  return lines;
}

std::vector<std::string> healths(const RunState& state) {
  std::vector<std::string> lines = {""};
  for (const auto& [name, program] : state.programs()) {
    const auto& health = program.health;
    if (program.role == "fluid") {
      lines.push_back(fmt::format("{:<14} min rho {:.4g}   min p {:.4g}   first order {}   floors {}",
                                  cell(name, 14), health.min_rho, health.min_p, health.first_order_fallbacks,
                                  health.floors));
    } else if (program.role == "solid") {
      lines.push_back(fmt::format("{:<14} min det F {:.4g}", cell(name, 14), health.min_det_F));
    }
  }
  return lines;
}

std::vector<std::string> interfaces(const RunState& state) {
  const wire::Telemetry* leader = state.leader();
  if (leader == nullptr || leader->interfaces.empty()) return {};
  std::vector<std::string> lines = {"", fmt::format("{:<14} {:>14} {:>14} {:>14} {:>14}", "interface",
                                                    "velocity jump", "traction jump", "gap", "power")};
  for (const auto& side : leader->interfaces) {
    lines.push_back(fmt::format("{:<14} {:>14.3e} {:>14.3e} {:>14.3e} {:>14.3e}", cell(side.name, 14),
                                side.velocity_jump, side.traction_jump, side.gap, side.power));
  }
  return lines;
}

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds > 1e7) return "-";
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::vector<std::string> table(const RunState& state, double now, Extent extent) {
  std::vector<std::string> lines = heading(state, extent.columns);
  for (const auto& part : {programs(state, now), healths(state), interfaces(state)}) {
    lines.insert(lines.end(), part.begin(), part.end());
  }
  if (const auto& abort = state.abort()) {
    lines.emplace_back();
    lines.push_back(fmt::format("{} ended the run: {}", abort->from, abort->reason));
  }
  if (std::ssize(lines) > extent.rows) lines.resize(static_cast<std::size_t>(extent.rows));
  for (std::string& line : lines) line = cell(line, static_cast<std::size_t>(extent.columns));
  return lines;
}

std::string plain_line(const RunState& state) {
  std::string line = fmt::format("status={}", state.status());
  if (const wire::Telemetry* leader = state.leader()) {
    line += fmt::format(" step={} t={:.6g} t_end={:.6g} dt={:.4g} steps_per_s={:.1f}", leader->step,
                        leader->t, leader->t_end, leader->dt, state.steps_per_s());
  }
  for (const auto& [name, program] : state.programs()) {
    if (const auto share = computing_share(program)) line += fmt::format(" {}={:.0f}%", name, 100 * *share);
  }
  if (const auto& abort = state.abort()) {
    line += fmt::format(" reason=\"{}: {}\"", abort->from, abort->reason);
  }
  return cell(line, line.size());
}

}  // namespace fsi::monitor
