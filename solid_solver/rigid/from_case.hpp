#pragma once
/// What a case file says about a solid, as a rigid body.

#include <vector>

#include "common/case/case.hpp"
#include "solid_solver/rigid/body.hpp"

namespace fsi::rigid {

/// A body, with an outline for each side along which a gas is; meets none where it is alone.
struct BodyFromCase {
  RigidBody body;
  double area = 0;  ///< [length^2]
  bool meets_gas = false;
  /// Of a body that is a grid: for each outline the points of the opposite side, 2 n component-major. Of a shape: none.
  std::vector<std::vector<double>> across = {};
};

/// The body of `spec`: that of its shape, or of its grid. Where a side slides along a wall, the motion along
/// the wall is left. Laws of deformation, dissipation and time steps have no meaning for it and are not
/// looked at. An initial velocity gives that of the centre, and the rotation that fits it along the outline.
/// @param t_end of the case [time]
/// @throws UserMistake for conditions a rigid body cannot meet
BodyFromCase body_from_case(const SolidSpec& spec, double t_end);

}  // namespace fsi::rigid
