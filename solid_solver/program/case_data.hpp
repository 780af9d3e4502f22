#pragma once
/// What a case file says about one solid, as the functions the solver works with.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/exact/solution.hpp"
#include "common/grid/geometry/interface_geometry.hpp"
#include "common/program/program.hpp"
#include "solid_solver/measures/manufactured.hpp"
#include "solid_solver/options.hpp"
#include "solid_solver/solid_part.hpp"

namespace fsi::solid {

/// How the points of a side of a grid continue beyond its ends.
grid::Curve curve_along(const grid::MovingGrid& grid, Side side);

class CaseData {
 public:
  CaseData(const Setup& setup, const SolidSpec& spec, AnyLaw law);

  /// The grid of the case, and the one fitted to the solid's outline where it has a shape.
  std::vector<SolidPart> parts() const;
  SolidOptions options() const;

  /// State of the case's reference solution; empty where there is none.
  StateFunction reference_state() const;
  /// Why the reference solution says nothing of time t; empty where it does.
  std::string reference_missing_at(double t) const { return solution_ ? solution_->missing_at(t) : ""; }

  /// Empty unless the case starts from the reference.
  StateFunction initial_state() const;
  VectorFunction initial_displacement() const;
  VectorFunction initial_velocity() const;

  /// Where the case gives more than a displacement: sources in all equations.
  std::optional<ChosenSolution> chosen_solution() const;
  /// With a chosen solution, it takes the place of that of the case.
  VectorFunction body_force() const;

 private:
  SolidPart part(grid::GridDescription description, const std::array<BoundarySpec, 4>& specs) const;
  Boundary boundary(const BoundarySpec& spec, Side side, const grid::MovingGrid& grid) const;
  StateFunction required_reference(Side side) const;
  VectorFunction reference_traction(const BoundarySpec& spec, Side side, const grid::MovingGrid& grid) const;

  const SolidSpec& spec_;
  double crossing_time_;  ///< of a p-wave through the body [time]
  double cfl_;
  std::shared_ptr<const exact::Solution> solution_;
  std::shared_ptr<const Manufactured> manufactured_;  ///< motion given by formulas
  bool forced_ = false;                               ///< a body force makes it a solution
  bool chosen_ = false;                               ///< sources in all equations do
};

}  // namespace fsi::solid
