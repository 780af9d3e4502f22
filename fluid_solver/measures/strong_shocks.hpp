#pragma once
/// Shocks along grid lines so strong that they break up in a gas without shock viscosity (docs/theory_fluid.md, shocks along
/// grid lines).

#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/grid/watch.hpp"

namespace fsi::fluid {

/// The size of what it finds is the Mach number of a shock [-].
class ShockWatch final : public grid::Watch {
 public:
  static constexpr double faintest = 1.5;  ///< weaker shocks are not looked for [-]

  ShockWatch(double gamma, std::vector<std::string> grids);

  /// Looks along the lines of all grids, whose planes are rho, v1, v2, p.
  void look(std::span<const grid::WatchedGrid> grids, double t);
  /// `shock of Mach 3.1 along lines of grid "fluid", point (12, 3) at (0.1, 0.2), t = 6.2`
  std::string in_words(const grid::Finding& shock) const override;
  void archive(Archive& archive) { archive_findings(archive); }

 private:
  double gamma_;
};

}  // namespace fsi::fluid
