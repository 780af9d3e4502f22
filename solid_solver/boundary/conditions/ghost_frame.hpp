#pragma once
/// Ghost points that follow from the inner ones by extrapolation, reflection or repetition, or from a state that is given.

#include "solid_solver/boundary/sides/chosen_values.hpp"
#include "solid_solver/boundary/sides/sides.hpp"

namespace fsi::solid {

class GhostFrame {
 public:
  GhostFrame(const Sides& sides, const ChosenValues& chosen) : sides_(sides), chosen_(chosen) {}

  /// Ghost line range.m of all sides, beside the boundary points only.
  void fill_line(FieldView q, double t, const GhostRange& range) const;
  /// The corner blocks of the ghost frame: by extrapolation of the ghost lines beside them, then the sides that
  /// know better (mirror images, repetition, exact values) over theirs.
  void fill_corners(FieldView q, double t) const;
  /// Ghost points beside interpolated points. Repetition last: it also carries the ghost points of other sides.
  void refresh(FieldView q, double t) const;
  /// The given state on line m of a side: 0 is the side itself, ghost lines are below.
  void set_state(FieldView q, Side side, double t, int m) const;

 private:
  void fill_side(FieldView q, Side side, double t, const GhostRange& range) const;
  void mirror(FieldView q, Side side, double t, const GhostRange& range) const;
  void extend_into_corner(FieldView q, Side across, Side beside) const;

  const Sides& sides_;
  const ChosenValues& chosen_;
};

}  // namespace fsi::solid
