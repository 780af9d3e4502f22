#pragma once
/// Motion of the sides that is given: by a projection, by a wall, by functions.

#include <optional>
#include <span>

#include "solid_solver/boundary/interface.hpp"
#include "solid_solver/boundary/sides/chosen_values.hpp"
#include "solid_solver/boundary/sides/side_memory.hpp"
#include "solid_solver/boundary/sides/sides.hpp"

namespace fsi::solid {

/// Displacement and velocity.
struct Motion {
  Vec2 u, v;
};

/// Of point k of a side where it also lies on a side whose motion is given.
std::optional<Motion> given_motion(const Sides& sides, Side side, int k, double t);
/// Normal of the wall, if any, along which point k of a side slides: a slip or symmetry side that meets
/// this one there.
std::optional<Vec2> wall_of(const Sides& sides, Side side, int k);

class GivenMotion {
 public:
  GivenMotion(const Sides& sides, const ChosenValues& chosen) : sides_(sides), chosen_(chosen) {}

  /// Velocities and displacements of the points of the sides, and in `memory` what that changed. At corners later ones win:
  /// interface, walls, given motion. Also repeats the first line of a period at its end.
  void set(FieldView q, double t, std::span<const InterfaceValues> projected, SideMemory& memory) const;

 private:
  void project_velocity(FieldView q, double t, const InterfaceValues& values, SideMemory& memory) const;
  void find_normal_motion(ConstFieldView q, Side side, double t, SideMemory& memory) const;
  void remove_normal_motion(FieldView q, Side side, double t) const;
  void move(FieldView q, Side side, double t, SideMemory& memory) const;

  const Sides& sides_;
  const ChosenValues& chosen_;
};

}  // namespace fsi::solid
