#pragma once
/// The disk that turns in a gas, the same at every angle, as `reference_disk` tabulates it over the radius.

#include <string>
#include <vector>

#include "common/exact/solution.hpp"
#include "common/exact/table.hpp"

namespace fsi::exact {

/// Initial angular velocity of the paper's disk (section 5.2), V = omega_0 [4 r (1 - r)]^4. Differs from the
/// paper: it prints a radial velocity, but its figures are those of a rotation.
inline constexpr double default_omega_0 = 0.1;  ///< [1/time]
double angular_velocity(double omega_0, double r_bar);

/// paper eqs. of section 5.2: gas by the radius in space, solid by the radius in the reference disk, turned
/// to Cartesian components. Cubic between the points of the table, continued through the centre as a smooth
/// field: vectors odd in the radius, stress even. Off its ends (a point just inside the rim, gas beyond the
/// reach of any wave) the state at the end holds. Known at output times only.
class DiskTable final : public TabulatedSolution {
 public:
  /// @throws OutputFailed when the file cannot be read
  explicit DiskTable(const std::string& path);

  GasState gas(double x, double y, double t) const override;
  SolidState solid(double x_bar, double y_bar, double t) const override;
};

}  // namespace fsi::exact
