#include "solid_solver/bodies/report.hpp"

#include <fmt/format.h>

namespace fsi::bodies {

std::map<std::string, double> conservation_of(const BodyTotals& now, const BodyTotals& initial,
                                              const GasLoad& impulse, bool only_gas) {
  std::map<std::string, double> result = {
      {"mass", 0},
      {"energy", now.energy - initial.energy},
      {"energy_initial", initial.energy},
      {"momentum1", now.momentum[0] - initial.momentum[0]},
      {"momentum2", now.momentum[1] - initial.momentum[1]},
      {"angular_momentum", now.angular_momentum - initial.angular_momentum},
      {"angular_momentum_initial", initial.angular_momentum},
      {"impulse1", impulse.force[0]},
      {"impulse2", impulse.force[1]},
      {"angular_impulse", impulse.moment},
      {"work", impulse.power}};
  if (!only_gas) return result;
  result["momentum1_defect"] = result["momentum1"] - impulse.force[0];
  result["momentum2_defect"] = result["momentum2"] - impulse.force[1];
  result["energy_defect"] = result["energy"] - impulse.power;
  return result;
}

ForceTable::ForceTable(const Setup& setup, const std::string& name)
    : table_(setup.run_dir + "/forces_" + name + ".csv",
             {"t [time]", "force1 [force/depth]", "force2 [force/depth]", "moment [force*length/depth]",
              "power [power/depth]", "centre1 [length]", "centre2 [length]", "velocity1 [length/time]",
              "velocity2 [length/time]", "angle [rad]"},
             setup.opening()) {}

void ForceTable::row(double t, const GasLoad& load, const BodyMotion& motion) {
  table_.row({t, load.force[0], load.force[1], load.moment, load.power, motion.centre[0], motion.centre[1],
              motion.velocity[0], motion.velocity[1], motion.angle});
}

std::vector<Vec2> probe_places(const Setup& setup, const std::string& name) {
  std::vector<Vec2> places;
  for (const ProbeSpec& probe : setup.problem.output.probes)
    if (probe.in == name) places.emplace_back(probe.x, probe.y);
  return places;
}

std::optional<io::CsvWriter> probe_table(const Setup& setup, const std::string& name,
                                         std::span<const char* const> quantities) {
  std::vector<std::string> columns{"t [time]"};
  for (const ProbeSpec& probe : setup.problem.output.probes) {
    if (probe.in != name) continue;
    for (const char* quantity : quantities) columns.push_back(fmt::format("{}.{}", probe.name, quantity));
  }
  std::optional<io::CsvWriter> table;
  if (columns.size() > 1)
    table.emplace(setup.run_dir + "/parts/probes_" + name + ".csv", columns, setup.opening());
  return table;
}

}  // namespace fsi::bodies
