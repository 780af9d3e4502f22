#pragma once
/// What is known of a body as a whole.

#include "common/core/types.hpp"

namespace fsi::solid {

/// Integrals over the body.
struct Totals {
  double mass = 0;  ///< [mass/depth]
  Vec2 momentum = Vec2::Zero();
  double kinetic_energy = 0;    ///< [energy/depth]
  double strain_energy = 0;     ///< [energy/depth]
  double angular_momentum = 0;  ///< about the origin of physical space [momentum*length/depth]

  double energy() const { return kinetic_energy + strain_energy; }
};

/// Largest errors over all points and components.
struct Errors {
  double u = 0, v = 0, P = 0;  ///< [length], [velocity], [pressure]
};

/// Integrals over one side: what the outside does to the body there.
struct SideLoad {
  Vec2 force = Vec2::Zero();
  double moment = 0;  ///< about the origin [force*length/depth]
  double power = 0;   ///< [power/depth]

  SideLoad& operator+=(const SideLoad& other) {
    force += other.force;
    moment += other.moment;
    power += other.power;
    return *this;
  }
};

}  // namespace fsi::solid
