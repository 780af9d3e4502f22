#pragma once
/// What an exact solution gives at a point.

#include "common/core/types.hpp"

namespace fsi::exact {

/// Primitive state of the gas.
struct GasState {
  double rho = 0;  ///< density [mass/volume]
  double v1 = 0;   ///< velocity [length/time]
  double v2 = 0;   ///< [velocity]
  double p = 0;    ///< pressure [force/area]
};

/// State of the solid at a reference point.
struct SolidState {
  Vec2 u = Vec2::Zero();  ///< displacement [length]
  Vec2 v = Vec2::Zero();  ///< velocity [length/time]
  Mat2 P = Mat2::Zero();  ///< nominal stress P_ij [force/area]
};

}  // namespace fsi::exact
