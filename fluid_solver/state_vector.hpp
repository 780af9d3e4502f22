#pragma once
/// The state of the gas at a point as a vector of four, for the work on sides and ghosts.

#include <Eigen/Core>

#include "common/core/field.hpp"
#include "fluid_solver/boundary/side_points.hpp"
#include "fluid_solver/gas_options.hpp"

namespace fsi::fluid {

/// (rho, v1, v2, p)
using StateVector = Eigen::Vector4d;

inline StateVector load(ConstFieldView q, SidePoints::Index at) {
  return {q(0, at.i, at.j), q(1, at.i, at.j), q(2, at.i, at.j), q(3, at.i, at.j)};
}
inline void store(FieldView q, SidePoints::Index at, const StateVector& value) {
  for (int k = 0; k < 4; ++k) q(k, at.i, at.j) = value[k];
}
inline StateVector to_vector(const State& state) {
  return {state.rho, state.v1, state.v2, state.p};
}

/// @{ Density, momentum and energy from density, velocity and pressure, and back.
inline StateVector conserved(const StateVector& q, double gamma) {
  return {q[0], q[0] * q[1], q[0] * q[2], q[3] / (gamma - 1) + 0.5 * q[0] * (q[1] * q[1] + q[2] * q[2])};
}
inline StateVector primitive(const StateVector& c, double gamma) {
  const double v1 = c[1] / c[0], v2 = c[2] / c[0];
  return {c[0], v1, v2, (gamma - 1) * (c[3] - 0.5 * (c[1] * v1 + c[2] * v2))};
}
/// @}

}  // namespace fsi::fluid
