#include "common/case/report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "common/case/report/cost.hpp"
#include "common/case/report/memory.hpp"
#include "common/case/report/remarks.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/failure.hpp"
#include "common/core/input/config.hpp"

namespace fsi {

namespace {

using nlohmann::ordered_json;

template <class T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json time_json(const TimeSpec& time) {
  return {{"end", time.end},
          {"cfl", time.cfl},
          {"growth", time.growth},
          {"multirate", time.multirate},
          {"robin_order", time.robin_order},
          {"dt", or_null(time.dt)},
          {"join_timeout", time.join_timeout},
          {"peer_timeout", time.peer_timeout},
          {"step_timeout", time.step_timeout}};
}

ordered_json cost_json(const Case& problem) {
  const RunCost cost = cost_of(problem);
  ordered_json programs = ordered_json::array();
  for (const StepCost& program : cost.programs) {
    programs.push_back({{"program", program.program},
                        {"dt", std::isfinite(program.dt) ? ordered_json(program.dt) : ordered_json(nullptr)},
                        {"substeps", cost.substeps(program)},
                        {"points", program.points},
                        {"seconds_a_step", cost.steps > 0 ? cost.seconds_of(program) : 0},
                        {"grid", program.grid}});
  }
  return {{"steps", cost.steps},
          {"dt", cost.steps > 0 ? ordered_json(cost.dt) : ordered_json(nullptr)},
          {"seconds", cost.seconds},
          {"programs", programs}};
}

ordered_json expect_json(const std::vector<Expectation>& expect) {
  ordered_json result = ordered_json::array();
  for (const Expectation& entry : expect) {
    result.push_back({{"quantity", entry.quantity},
                      {"max", or_null(entry.max)},
                      {"min", or_null(entry.min)},
                      {"equals", or_null(entry.equals)}});
  }
  return result;
}

template <class Owner>
std::uint64_t points_of(const Owner& owner) {
  auto points = static_cast<std::uint64_t>(owner.grid.n1) * static_cast<std::uint64_t>(owner.grid.n2);
  for (const BodyFittedSpec& fitted : fitted_grids(owner))
    points += static_cast<std::uint64_t>(fitted.curve.points()) * static_cast<std::uint64_t>(fitted.lines);
  return points;
}

/// "81 x 81 + 63 x 8"
template <class Owner>
std::string grids_of(const Owner& owner) {
  std::string text = fmt::format("{} x {}", owner.grid.n1, owner.grid.n2);
  for (const BodyFittedSpec& fitted : fitted_grids(owner))
    text += fmt::format(" + {} x {}", fitted.curve.points(), fitted.lines);
  return text;
}

/// Points that were added so that levels fit.
std::string added_points(const FluidSpec& fluid) {
  const auto [n1, n2] = fluid.refine.asked;
  if (n1 == fluid.grid.n1 && n2 == fluid.grid.n2) return "";
  const auto spacing = [&](int points) { return (fluid.grid.x_b - fluid.grid.x_a) / (points - 1); };
  std::string text =
      fmt::format("\n  {}: {} x {} points in place of {} x {}, so that {} levels fit", fluid.path + ".grid",
                  fluid.grid.n1, fluid.grid.n2, n1, n2, fluid.refine.levels);
  constexpr double few = 2;
  if (fluid.grid.n1 - 1 > few * (n1 - 1) || fluid.grid.n2 - 1 > few * (n2 - 1))
    text += fmt::format(
        "; the finest spacing is {:.3g} in place of {:.3g}: write fewer `levels`, or a rectangle "
        "that many coarse cells fit into",
        spacing(fluid.grid.n1), spacing(n1));
  return text;
}

/// Times that the file asks for and the run does not reach: `--set time.end` may be what makes it so.
std::string times_left_out(const OutputSpec& output, double end) {
  if (output.left_out.empty()) return "";
  return fmt::format("\n  output.times: no output at {}, after time.end = {:g}",
                     fmt::join(output.left_out, ", "), end);
}

/// What the reference says of a body that has no errors: `--solid disk=rigid` may be what makes it so.
std::string reference_left_out(const Case& problem) {
  const auto has_errors = [](const SolidSpec& solid) { return is_continuum(solid.law); };
  const bool has_one = std::ranges::any_of(problem.solids, has_errors);
  if (problem.solids.empty() || has_one || !problem.reference.u) return "";
  return "\n  reference.u: no errors by it; a beam, a rigid body and a program of one's own have none";
}

}  // namespace

bool is_coupled(const Case& problem) {
  return !problem.fluids.empty() && !problem.solids.empty();
}

std::vector<ParticipantSummary> participants_of(const Case& problem) {
  std::vector<ParticipantSummary> result;
  for (const FluidSpec& fluid : problem.fluids) result.push_back({fluid.name, "fluid", "fluid_solver", ""});
  for (const SolidSpec& solid : problem.solids) {
    const bool external = solid.law == external_law;
    result.push_back(
        {solid.name, "solid", external ? solid.program : "solid_solver_" + solid.law, solid.law});
  }
  if (is_coupled(problem)) result.push_back({"coupler", "coupler", "coupler", ""});
  return result;
}

std::string summary_as_json(const Case& problem) {
  ordered_json participants = ordered_json::array();
  for (const ParticipantSummary& p : participants_of(problem)) {
    participants.push_back({{"name", p.name}, {"role", p.role}, {"executable", p.executable}});
  }
  std::uint64_t fluid_points = 0;
  for (const FluidSpec& fluid : problem.fluids) fluid_points += points_of(fluid);
  ordered_json memory;
  for (const MemoryNeed& need : memory_of(problem)) memory[need.program] = std::round(need.bytes);
  ordered_json solids = ordered_json::array();
  for (const SolidSpec& solid : problem.solids) {
    solids.push_back(
        {{"name", solid.name}, {"law", solid.law}, {"points", points_of(solid)}, {"data", solid.data}});
  }
  const ordered_json summary = {
      {"name", problem.name},
      {"title", problem.title},
      {"path", problem.path},
      {"digest", problem.digest},
      {"restart_digest", problem.restart_digest},
      {"coupled", is_coupled(problem)},
      {"fluid", !problem.fluids.empty()},
      {"fluid_points", fluid_points},
      {"solids", solids},
      {"participants", participants},
      {"memory", memory},
      {"cost", cost_json(problem)},
      {"chosen", problem.chosen},
      {"unused", problem.unused},
      {"remarks", remarks_on(problem)},
      {"parameters", problem.parameters},
      {"formulas", problem.formulas},
      {"grid_factor", problem.grid_factor},
      {"time", time_json(problem.time)},
      {"projection", name_of(problem.interface.projection)},
      {"output_times", problem.output.times},
      {"reference", {{"kind", name_of(problem.reference.kind)}, {"numbers", problem.reference.numbers}}},
      {"expect", expect_json(problem.expect)},
      {"resolved", problem.resolved}};
  return summary.dump(2, ' ', false, ordered_json::error_handler_t::replace);
}

std::string summary_line(const Case& problem) {
  std::vector<std::string> parts;
  for (const FluidSpec& fluid : problem.fluids) {
    const std::string name = problem.fluids.size() > 1 ? fmt::format(" {}", fluid.name) : "";
    const std::string levels = fluid.refine.levels > 1 ? fmt::format(", {} levels", fluid.refine.levels) : "";
    parts.push_back(fmt::format("gas{} {}{}", name, grids_of(fluid), levels));
  }
  for (const SolidSpec& solid : problem.solids) {
    parts.push_back(fmt::format("{} ({}) {}", solid.name, solid.law, grids_of(solid)));
  }
  const bool levels =
      std::ranges::any_of(problem.fluids, [](const FluidSpec& fluid) { return fluid.refine.levels > 1; });
  std::string line =
      fmt::format("{}: valid; {}, t = 0 to {}; memory {}about {}", problem.path, fmt::join(parts, ", "),
                  problem.time.end, levels ? "at most " : "", bytes_text(total_memory(problem)));
  for (const FluidSpec& fluid : problem.fluids) line += added_points(fluid);
  return line + times_left_out(problem.output, problem.time.end) + reference_left_out(problem);
}

std::vector<std::pair<std::string, std::string>> list_cases(const std::string& folder) {
  std::set<std::string> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".yaml") paths.insert(entry.path().string());
  }
  std::vector<std::pair<std::string, std::string>> result;
  for (const std::string& path : paths) {
    const std::string name = std::filesystem::path(path).stem().string();
    try {
      const config::Node root = config::parse_file(path);
      const config::Node* title = root.find("title");
      result.emplace_back(name, title != nullptr && title->is_scalar() ? title->text : "");
    } catch (const UserMistake& mistake) {
      result.emplace_back(name, mistake.what());
    }
  }
  return result;
}

}  // namespace fsi
