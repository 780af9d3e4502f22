#include "common/case/check/check_expectations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/input/suggest.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;
using std::string_view;

// What summary.json has (docs/output.md).
constexpr std::array<string_view, 17> quantities{
    "status",   "reason", "case",         "t",       "t_end",          "steps",
    "dt",       "wall_s", "participants", "errors",  "errors_missing", "interface",
    "counters", "noise",  "disagreement", "overlap", "conservation"};
constexpr std::array<string_view, 5> errors_of_gas{"rho", "v1", "v2", "T", "rho_mean"};
constexpr std::array<string_view, 3> errors_of_solid{"u_bar", "v_bar", "P_bar"};
constexpr std::array<string_view, 10> counters{"floors",
                                               "positive_fluxes",
                                               "positive_values",
                                               "bounded_side_points",
                                               "vacuum_points",
                                               "first_order_fallbacks",
                                               "first_order_fallbacks_outside_shocks",
                                               "settled_ghost_points",
                                               "waveless_side_points",
                                               "lost_outputs"};
constexpr std::array<string_view, 5> of_interface{"max_velocity_jump", "max_traction_jump", "max_gap",
                                                  "velocity_scale", "traction_scale"};
constexpr std::array<string_view, 3> of_step{"min", "max", "limited_by"};
constexpr std::array<string_view, 8> of_noise{"value", "noisy", "field", "grid",
                                              "point", "place", "t",     "participant"};
constexpr std::array<string_view, 8> of_disagreement{"value", "large", "field", "grid",
                                                     "point", "place", "t",     "participant"};
constexpr std::array<string_view, 10> of_program{"program",        "role",     "status",
                                                 "points",         "substeps", "compute_s",
                                                 "wait_s",         "time_s",   "point_updates_per_s",
                                                 "peak_memory_mib"};
constexpr std::array<string_view, 17> of_budget{"mass",
                                                "mass_initial",
                                                "energy",
                                                "energy_initial",
                                                "momentum1",
                                                "momentum2",
                                                "angular_momentum",
                                                "angular_momentum_initial",
                                                "mass_defect",
                                                "momentum1_defect",
                                                "momentum2_defect",
                                                "energy_defect",
                                                "momentum_scale",
                                                "impulse1",
                                                "impulse2",
                                                "angular_impulse",
                                                "work"};

/// One expectation, with the place where it stands.
struct Expected {
  const Case& problem;
  const std::string& quantity;
  std::vector<std::string> words;  ///< of its path
  const Node& node;

  [[noreturn]] void refuse(const std::string& why) const { fail(node.place, "expect", why); }

  /// Word k is one of those, if the path has so many.
  void require(std::size_t k, std::span<const std::string> known) const {
    if (k >= words.size() || std::ranges::find(known, words[k]) != known.end()) return;
    refuse(fmt::format("summary.json has no {} ({}){}", in_ticks(quantity), fmt::join(known, ", "),
                       did_you_mean(words[k], {known.begin(), known.end()})));
  }
  void require(std::size_t k, std::span<const string_view> known) const {
    require(k, std::vector<std::string>(known.begin(), known.end()));
  }
};

std::vector<std::string> words_of_path(const std::string& path) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    words.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::vector<std::string> programs_of(const Case& problem) {
  std::vector<std::string> programs;
  for (const SolidSpec& solid : problem.solids) programs.push_back(solid.name);
  for (const FluidSpec& fluid : problem.fluids) programs.push_back(fluid.name);
  return programs;
}

bool is_coupled(const Case& problem) {
  return !problem.fluids.empty() && !problem.solids.empty();
}

void check_errors(const Expected& expected) {
  const Case& problem = expected.problem;
  std::vector<std::string> known(errors_of_gas.begin(), errors_of_gas.end());
  known.insert(known.end(), errors_of_solid.begin(), errors_of_solid.end());
  expected.require(1, known);
  const ReferenceSpec& reference = problem.reference;
  if (reference.kind == ReferenceKind::none)
    expected.refuse(fmt::format(
        "{} is measured against a reference solution, and the case has none; write a `reference`, "
        "or leave it out (`fsi converge` compares grids without one)",
        in_ticks(expected.quantity)));
  if (expected.words.size() < 2) return;
  const bool of_gas = std::ranges::find(errors_of_gas, expected.words[1]) != errors_of_gas.end();
  const bool is_there = of_gas ? !problem.fluids.empty() && (!reference.in_formulas() || reference.fluid)
                               : !problem.solids.empty() && (!reference.in_formulas() || reference.u);
  if (!is_there)
    expected.refuse(
        fmt::format("{} is measured for a {} that the `reference` describes, and the case has none; "
                    "leave it out",
                    in_ticks(expected.quantity), of_gas ? "gas" : "solid"));
}

void check_quantity(const Expected& expected) {
  expected.require(0, quantities);
  const std::string& first = expected.words.front();
  std::vector<std::string> programs = programs_of(expected.problem);
  if (first == "conservation") {
    expected.require(1, programs);
    expected.require(2, of_budget);
  }
  if (first == "participants") {
    if (is_coupled(expected.problem)) programs.emplace_back("coupler");
    expected.require(1, programs);
    expected.require(2, of_program);
  }
  if (first == "errors") check_errors(expected);
  if (first == "counters") expected.require(1, counters);
  if (first == "dt") expected.require(1, of_step);
  if (first == "noise") expected.require(1, of_noise);
  if (first == "disagreement") expected.require(1, of_disagreement);
  if (first != "interface") return;
  expected.require(1, of_interface);
  if (!is_coupled(expected.problem))
    expected.refuse(fmt::format("{}: the case has no interface, which takes a gas and a solid; leave it out",
                                in_ticks(expected.quantity)));
}

}  // namespace

void check_expectations(const Case& problem, const Node& root) {
  for (const Expectation& entry : problem.expect)
    check_quantity({.problem = problem,
                    .quantity = entry.quantity,
                    .words = words_of_path(entry.quantity),
                    .node = *root.find("expect")->find(entry.quantity)});
}

}  // namespace fsi
