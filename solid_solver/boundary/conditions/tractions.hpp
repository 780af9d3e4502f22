#pragma once
/// The tractions of the sides, given and projected, and the stress that bears them.

#include <span>

#include "solid_solver/boundary/interface.hpp"
#include "solid_solver/boundary/sides/chosen_values.hpp"
#include "solid_solver/boundary/sides/side_memory.hpp"
#include "solid_solver/boundary/sides/sides.hpp"

namespace fsi::solid {

class Tractions {
 public:
  /// @param time_scale over which given tractions hardly change [time]
  Tractions(const Sides& sides, const ChosenValues& chosen, double time_scale)
      : sides_(sides), chosen_(chosen), time_scale_(time_scale) {}

  /// Nominal traction T = tau / eta of a side with given traction tau per unit current area, paper eq. (42),
  /// and its rate; eta = |dx_bar/ds| / |dx/ds| is Nanson's factor, paper eq. (13). An interface keeps its
  /// present T until projected values come.
  void find(ConstFieldView q, Side side, double t, SideMemory& memory) const;
  /// T = (w_n / eta) n, or w_n n0 for loads on the reference configuration; besides the chosen traction.
  void find_projected(ConstFieldView q, double t, const InterfaceValues& values, SideMemory& memory) const;
  /// n0^T P := T on loaded sides, no shear on slip and symmetry sides; the rest of P stays. Corners of two walls come with
  /// `take_shear_of_corners`.
  void set_normal_stress(FieldView q, Side side, double t, const SideMemory& memory) const;
  /// Where two walls meet, none on either of them: the mean of taking it from one first and from the other first. At
  /// right angles these are the same.
  void take_shear_of_corners(FieldView q, double t) const;
  /// At a corner of a loaded side with a side of given displacement or slip, and of a slip side with one of
  /// given displacement: P by extrapolation along the loaded or slip side, where it is P(F) or free to evolve;
  /// a given traction still holds, and so does slip. Differences of u are only of first order there.
  void extend_stress_to_corners(FieldView q, Side side, double t, const SideMemory& memory) const;

 private:
  double stretch_along(ConstFieldView q, Side side, int k) const;
  Vec2 pressed_at_corner(ConstFieldView q, double t, const InterfaceValues& values, int k) const;

  const Sides& sides_;
  const ChosenValues& chosen_;
  double time_scale_;
};

}  // namespace fsi::solid
