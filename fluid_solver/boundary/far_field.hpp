#pragma once
/// A side through which waves leave and a given state comes in, by the Riemann invariants along its normal.
///
///     inside \   \  |  /   / beyond        speed of     carries            from where it comes
///             \   \ | /   /                u + a        u + 2a/(gamma-1)   inside while u + a > 0
///              \   \|/   /                 u            p/rho^gamma, v_t   inside while u > 0
///     ----------- side ---- n -->          u - a        u - 2a/(gamma-1)   inside while u - a > 0
///
/// Each invariant has the entropy of where it comes from: the two meet at one p and u, on both sides of the contact that may
/// be between them.

#include <cstddef>
#include <vector>

#include "common/core/types.hpp"
#include "fluid_solver/boundary/gas_side.hpp"
#include "fluid_solver/state_vector.hpp"

namespace fsi::fluid {

/// A side as its waves see it.
struct OpenSide {
  Vec2 n;              ///< unit normal out of the gas
  double speed = 0;    ///< of the side along n [velocity]
  double gamma = 1.4;  ///< [-]
};

/// The state on a side between that inside and a given one beyond it, which comes in as a whole where even a shock into it
/// is carried inwards. Contacts pass, and simple waves that leave, of any
/// strength, meet no resistance; shocks leave up to the third power of their strength.
BoundedState between(const StateVector& inside, const StateVector& beyond, const OpenSide& side);

/// Point k of a side between the gas inside and a given state beyond.
inline void let_waves_through(const GasSide& side, int k, const StateField& given) {
  const std::vector<double>& velocity = side.motion.velocity;
  const auto n = static_cast<std::size_t>(side.points.n()), point = static_cast<std::size_t>(k);
  const Vec2 place = position(side.x, side.points, k, 0), outward = -inward_normal(side.x, side.points, k);
  const StateVector beyond = to_vector(given(place[0], place[1], side.t));
  const OpenSide open{.n = outward,
                      .speed = outward.dot(Vec2(velocity[point], velocity[n + point])),
                      .gamma = side.options.gamma};
  const BoundedState state = between(load(side.q, side.points.at(k, 0)), beyond, open);
  side.bounded += state.bounded && side.points.counts(k);
  store(side.q, side.points.at(k, 0), state.q);
}

}  // namespace fsi::fluid
