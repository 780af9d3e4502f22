#pragma once
/// A side through which waves leave and a given state comes in, by the Riemann invariants along its normal.
///
///     inside \   \  |  /   / beyond        speed of     carries            from where it comes
///             \   \ | /   /                u + a        u + 2a/(gamma-1)   inside while u + a > 0
///              \   \|/   /                 u            p/rho^gamma, v_t   inside while u > 0
///     ----------- side ---- n -->          u - a        u - 2a/(gamma-1)   inside while u - a > 0

#include "common/core/types.hpp"
#include "fluid_solver/state_vector.hpp"

namespace fsi::fluid {

/// A side as its waves see it.
struct OpenSide {
  Vec2 n;              ///< unit normal out of the gas
  double speed = 0;    ///< of the side along n [velocity]
  double gamma = 1.4;  ///< [-]
};

/// The state on a side between that inside and a given one beyond it. Simple waves that leave, of any
/// strength, meet no resistance; shocks leave up to the third power of their strength.
StateVector between(const StateVector& inside, const StateVector& beyond, const OpenSide& side);

}  // namespace fsi::fluid
