#pragma once
/// What a sweep is given, and what it finds.

#include <algorithm>
#include <array>
#include <limits>

#include "common/core/field.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

/// What a sweep looks for besides making its step.
enum class Look {
  soundness,  ///< whether det F > 0 and all waves are real
  all         ///< wave speeds as well, for the next time step
};

/// Extremes over the points of a sweep, for the next time step and the health of the numbers. Those of the waves
/// are there where the sweep looked for all.
struct SweepResult {
  double rate_squared = 0;  ///< largest (sum over directions of c_p |grad r|)^2 [1/time^2]
  /// Largest square of s sqrt((difference of the two directions' c_p |grad r|)^2 + 4 |X|^2) + (1 - s) (their sum), with |X|^2
  /// = shared_upwinding and s = upwind_share; 0 where it is not measured.
  double spread_squared = 0;  ///< [1/time^2]
  double coupled = 0;         ///< 1 where some point has a wave_coupling beyond the limit, else 0
  double min_det_F = std::numeric_limits<double>::infinity();
  double min_phi_s = std::numeric_limits<double>::infinity();  ///< smallest phi_s |grad r|^2
  double broken = 0;                                           ///< points with det F <= 0 or phi_s <= 0 [-]
  double settled = 0;  ///< ghost points that took the acoustic matrix of the body beside them [-]

  void add(const SweepResult& other) {
    rate_squared = std::max(rate_squared, other.rate_squared);
    spread_squared = std::max(spread_squared, other.spread_squared);
    coupled = std::max(coupled, other.coupled);
    min_det_F = std::min(min_det_F, other.min_det_F);
    min_phi_s = std::min(min_phi_s, other.min_phi_s);
    broken += other.broken;
    settled += other.settled;
  }
};

/// Columns that are swept at a time.
struct SweepStrip {
  int begin = 0, end = 0;
  bool first = true, last = true;

  /// Ghost points beside a strip, but for those beside the grid, are counted in another one.
  bool counts(int i) const { return (first || i >= begin) && (last || i < end); }
};

/// Fields and numbers of one sweep.
struct SweepData {
  const SolidPoints* points = nullptr;
  ConstFieldView q;      ///< unknowns at t, both ghost lines set
  FieldView next;        ///< unknowns at t + dt; ghosts are not set
  ConstFieldView force;  ///< body force at t + dt/2, two planes or none
  FieldView work;        ///< layout sweep_work, one plane, zero at birth
  double rho = 1;        ///< [mass/volume]
  double dt = 0;         ///< [time]
  Look look = Look::all;
  bool measures_spread = true;    ///< SweepResult::spread_squared; only relaxation and (39) need it
  double coupling_limit = 1e300;  ///< of `wave_coupling`, beyond which StressUpwinding takes a part [-]
  bool softened = false;          ///< it passes over the rows: the last sweep found such a point
  std::array<bool, 4> loaded{};   ///< by side: its traction is that of a load, and StressUpwinding leaves it
  /// Those that are advanced; two rows beside them are read.
  grid::RowRange rows = {0, std::numeric_limits<int>::max()};
};

}  // namespace fsi::solid
