#include "common/case/check/check_expectations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/core/input/suggest.hpp"

namespace fsi {

using config::fail;
using config::Node;

void check_expectations(const Case& problem, const Node& root) {
  static const std::vector<std::string> quantities{
      "status",       "reason", "t",         "steps",    "dt",          "wall_s",
      "participants", "errors", "interface", "counters", "conservation"};
  static const std::vector<std::string> errors{"rho", "v1", "v2", "T", "rho_mean", "u_bar", "v_bar", "P_bar"};
  std::vector<std::string> programs;
  for (const SolidSpec& solid : problem.solids) programs.push_back(solid.name);
  for (const FluidSpec& fluid : problem.fluids) programs.push_back(fluid.name);
  programs.emplace_back("coupler");
  const auto require = [&](const Expectation& entry, const std::string& word,
                           const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), word) != known.end()) return;
    const std::string hint = did_you_mean(word, known);
    fail(
        root.find("expect")->find(entry.quantity)->place, "expect",
        fmt::format("summary.json has no {} ({}){}", in_ticks(entry.quantity), fmt::join(known, ", "), hint));
  };
  for (const Expectation& entry : problem.expect) {
    const std::size_t dot = entry.quantity.find('.');
    const std::string first = entry.quantity.substr(0, dot);
    require(entry, first, quantities);
    if (dot == std::string::npos) continue;
    const std::string rest = entry.quantity.substr(dot + 1);
    if (first == "errors") require(entry, rest, errors);
    if (first == "errors" && problem.reference.kind == ReferenceKind::none)
      fail(root.find("expect")->find(entry.quantity)->place, "expect",
           fmt::format(
               "{} is measured against a reference solution, and the case has none; write a `reference`, "
               "or leave it out (`fsi converge` compares grids without one)",
               in_ticks(entry.quantity)));
    if (first == "participants" || first == "conservation")
      require(entry, rest.substr(0, rest.find('.')), programs);
  }
}

}  // namespace fsi
