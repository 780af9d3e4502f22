#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "monitor/terminal/screen.hpp"

namespace fsi::monitor {

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds > 1e7) return "-";
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
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
  for (const auto& side : state.interfaces()) {
    line += fmt::format(" {0}.velocity_jump={1:.3e} {0}.traction_jump={2:.3e}", side.name, side.velocity_jump,
                        side.traction_jump);
  }
  for (const std::string& what : state.non_finite()) line += fmt::format(" not_finite=\"{}\"", what);
  if (const auto& abort = state.abort()) {
    line += fmt::format(" reason=\"{}: {}\"", abort->from, abort->reason());
  }
  std::ranges::replace_if(  // names from outside must not steer a terminal
      line, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return line;
}

}  // namespace fsi::monitor
