#pragma once
/// Impermeable wall that moves with the grid's side, or stands where the grid stands.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/interface/wave_curve.hpp"
#include "fluid_solver/boundary/gas_side.hpp"

namespace fsi::fluid {

struct SlipWall {
  static constexpr GasBoundaryFacts facts{
      .meaning = "wall without friction", .is_wall = true, .precedence = 1};

  static SlipWall from(const BoundaryData& /*data*/) { return {}; }

  /// n.v := that of the wall; pressure and density follow along the wave that makes this change of velocity, a shock
  /// where the wall stops gas that runs against it. At
  /// the foot of a body the velocity changes along the interface, whose own condition goes on holding: a change along
  /// the normal would break it, be undone with the next values of the interface, and pump pressure each time. The wave
  /// runs along the interface, too, where gas in a corner below a right angle has no other way, and off the wall in a
  /// wider one: towards a flat corner its strength is that of a wall alone.
  static void set_point(const GasSide& side, int k) {
    const WallMotion& wall = side.motion;
    const auto n = static_cast<std::size_t>(side.points.n()), point = static_cast<std::size_t>(k);
    const double gamma = side.options.gamma;
    const auto at = side.points.at(k, 0);
    const Vec2 normal(wall.normal[point], wall.normal[n + point]);
    StateVector state = load(side.q, at);
    const Vec2 along = free_direction(side, k, normal);
    const double change = normal.dot(velocity_beside(side, k) - Vec2(state.segment<2>(1)));
    const double slant = normal.dot(along);
    const double of_wave = is_narrow(side, k, along) ? change / slant : change;
    const double a = std::sqrt(gamma * state[3] / state[0]);
    const WaveCurve curve{.z = state[0] * a, .rho = state[0], .gamma = gamma};
    const WaveCurve::Point answer = curve.at(of_wave);
    side.bounded += answer.vacuum && side.points.counts(k);
    const double pressure_ratio = 1 + answer.dp / state[3];
    state.segment<2>(1) += change / slant * along;
    state[0] *= density_ratio(gamma, pressure_ratio);
    state[3] *= pressure_ratio;
    if (side.forcing != nullptr) bring_in(state, side, k);
    store(side.q, at, state);
  }

  static void set_ghosts(const GasSide& side) {
    set_wall_ghosts(side, side.wall(side.motion.normal, side.motion.velocity, side.motion.acceleration));
  }

 private:
  /// In which gas beside point k may yield. An interface that lies almost flat on the wall leaves it no way.
  static Vec2 free_direction(const GasSide& side, int k, const Vec2& normal) {
    constexpr double least_sine = 0.1;
    const std::size_t end = k == 0 ? 0 : 1;
    if ((k != 0 && k != side.points.n() - 1) || !side.crossing[end]) return normal;
    const Vec2 t(-side.crossing[end]->y(), side.crossing[end]->x());
    const double sine = normal.dot(t);
    return std::fabs(sine) < least_sine ? normal : sine > 0 ? t : Vec2(-t);
  }

  /// Whether the gas between the wall and a line from its end k that goes `along` has less than a right angle.
  static bool is_narrow(const GasSide& side, int k, const Vec2& along) {
    const int next = k == 0 ? 1 : k - 1;
    return along.dot(position(side.x, side.points, next, 0) - position(side.x, side.points, k, 0)) > 0;
  }

  static Vec2 velocity_of(const WallMotion& wall, int k) {
    const auto n = wall.velocity.size() / 2, point = static_cast<std::size_t>(k);
    return {wall.velocity[point], wall.velocity[n + point]};
  }

  /// Velocity of the gas on the wall: that of the wall, or the exact one.
  static Vec2 velocity_beside(const GasSide& side, int k) {
    if (side.forcing != nullptr) return side.exact(k).segment<2>(1);
    return velocity_of(side.motion, k);
  }

  /// Gas with a chosen solution may come in through a wall, and brings entropy and shear with it: three waves
  /// come in there, and a condition for one of them leaves the others to extrapolation, from which errors at
  /// corners grow.
  static void bring_in(StateVector& state, const GasSide& side, int k) {
    const WallMotion& wall = side.motion;
    const auto n = wall.velocity.size() / 2, point = static_cast<std::size_t>(k);
    const StateVector chosen = side.exact(k);
    const Vec2 normal(wall.normal[point], wall.normal[n + point]), own = velocity_of(wall, k);
    if (normal.dot(Vec2(chosen.segment<2>(1)) - own) <= 0) return;
    state[0] = chosen[0] * std::pow(state[3] / chosen[3], 1 / side.options.gamma);
    state.segment<2>(1) = chosen.segment<2>(1);
  }
};

}  // namespace fsi::fluid
