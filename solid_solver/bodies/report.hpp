#pragma once
/// What a body that is no continuum leaves: what it keeps, the forces on it, its probes. Rigid bodies and beams alike.

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/types.hpp"
#include "common/io/csv_writer.hpp"
#include "common/program/program.hpp"
#include "solid_solver/bodies/load.hpp"

namespace fsi::bodies {

/// Of a body, per unit thickness.
struct BodyTotals {
  Vec2 momentum;
  double angular_momentum;  ///< about the origin [momentum*length/depth]
  double energy;            ///< [energy/depth]
};

/// `conservation` of the report: what changed since the start, what the gas gave, and, of a body on which
/// nothing but the gas acts, the defect between the two.
std::map<std::string, double> conservation_of(const BodyTotals& now, const BodyTotals& initial,
                                              const GasLoad& impulse, bool only_gas);

/// Where a body is and how it moves, as forces_NAME.csv has it.
struct BodyMotion {
  Vec2 centre, velocity;
  double angle;  ///< [rad]
};

/// forces_NAME.csv
class ForceTable {
 public:
  ForceTable(const Setup& setup, const std::string& name);
  void row(double t, const GasLoad& load, const BodyMotion& motion);
  void flush() { table_.flush(); }
  void archive(Archive& archive) { table_.archive(archive); }

 private:
  io::CsvWriter table_;
};

/// Reference positions of the probes in the solid `name`.
std::vector<Vec2> probe_places(const Setup& setup, const std::string& name);

/// The table of these probes, with the quantities of each; none where there are no probes.
std::optional<io::CsvWriter> probe_table(const Setup& setup, const std::string& name,
                                         std::span<const char* const> quantities);

}  // namespace fsi::bodies
