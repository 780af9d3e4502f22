#pragma once
/// The part one program contributes to summary.json: DIR/parts/<participant>.json (format: docs/output.md).
/// The launcher merges the parts.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/core/failure.hpp"

namespace fsi::io {

/// What a program spends its time on.
enum class Work { advance, time_step, boundary, grids, messages, output, waiting };
inline constexpr std::array work_names{"advance",  "time_step", "boundary", "grids",
                                       "messages", "output",    "waiting"};

/// Largest jumps over an interface in a whole run, before
/// the projection, and what they are to be compared with.
struct InterfaceExtremes {
  double max_velocity_jump = 0;  ///< [velocity]
  double max_traction_jump = 0;  ///< [pressure]
  double max_gap = 0;            ///< [length]
  /// Largest speed of sound, or of the gas along the normal, at an interface [velocity]
  double velocity_scale = 0;
  double traction_scale = 0;  ///< largest pressure of the gas at an interface [pressure]
};

/// The worst that was found in the fields: a ripple of the grid's scale (common/grid/ripple.hpp), a difference of two grids where
/// both compute (common/grid/overlap/disagreement.hpp), or a shock (fluid_solver/measures/strong_shocks.hpp).
struct Finding {
  double size = 0;    ///< over the range of the field; of a shock its Mach number [-]
  bool much = false;  ///< so large that somebody should know
  std::string field, grid;
  std::array<int, 2> point = {};
  std::array<double, 2> place = {};  ///< reference position in a solid
  double t = 0;                      ///< [time]
  std::string words;
};

/// How component grids exchanged values, the worst since the start (common/grid/overlap/composite_grid.hpp).
struct Overlap {
  double amplification = 1;  ///< of errors by points that interpolate from each other [-]
  std::string grid;          ///< where and when that was; "" where nothing was amplified
  std::array<int, 2> point = {};
  std::array<double, 2> place = {};  ///< reference position in a solid
  double t = 0;                      ///< [time]
  std::uint64_t implicit = 0;        ///< points that interpolate from each other, most at a time
  std::uint64_t narrowed = 0;        ///< of these with fewer donors, so that they do not amplify
  std::uint64_t lines_left_out = 0;  ///< of grids whose curves came near others
};

/// Why a program failed, by its parts.
struct FailureRecord {
  Place place;
  std::string what;
};

struct Part {
  std::string participant;           ///< "fluid", "coupler" or the solid's name
  std::string role;                  ///< "fluid", "solid", "coupler"
  std::string status = "completed";  ///< "running", "completed", "stopped" or "failed"
  std::string reason;                ///< of a failure or a stop
  std::string origin;  ///< of a failure: the participant that failed; another one, if we only heard of it
  std::optional<FailureRecord> failure;  ///< `reason` by its parts
  ExitCode exit_code = ExitCode::done;
  double t = 0;                                       ///< [time]
  std::uint64_t steps = 0;                            ///< macro steps
  double dt_min = 0, dt_max = 0;                      ///< [time]
  std::map<std::string, std::uint64_t> limited_by;    ///< steps, by the program or setting that limited them
  std::uint64_t points = 0;                           ///< grid points, or interface points for the coupler
  std::uint64_t substeps = 0;                         ///< steps the program itself took
  double compute_s = 0, wait_s = 0;                   ///< [s]
  std::array<double, work_names.size()> time_s = {};  ///< the same by kinds of work
  double point_updates_per_s = 0;                     ///< [1/s]
  double peak_memory_mib = 0;                         ///< [MiB]
  std::map<std::string, double> errors;               ///< maximum norms, where a reference exists
  std::map<std::string, double> counters;             ///< first_order_fallbacks, floors, ...
  std::map<std::string, double> health;               ///< min_rho, min_p, min_det_F
  std::map<std::string, double> conservation;         ///< drifts of mass, energy, momentum, angular momentum
  std::optional<InterfaceExtremes> interface;         ///< coupler only
  std::optional<Overlap> overlap;                     ///< of programs with overlapping grids
  std::optional<Finding> noise;                       ///< the worst since the start, of programs with fields
  std::optional<Finding> disagreement;  ///< the worst since the start, of a gas with several grids
  std::optional<Finding>
      strong_shock;  ///< the worst since the start, of a gas whose case leaves its viscosity open
};

/// The part as JSON text; a number that is not finite becomes null.
std::string to_json(const Part& part);

/// Writes DIR/parts/<participant>.json, whole or not at all. @throws OutputFailed
void write_part(const std::string& run_dir, const Part& part);

}  // namespace fsi::io
