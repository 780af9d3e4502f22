#pragma once
/// What the two sides of a cell face know, in the frame of the face: u along its normal, v along the face.

namespace fsi::fluid {

struct FaceState {
  double rho, u, v, p;  ///< [mass/volume], [velocity], [velocity], [pressure]
};

/// Flux through a unit of face that moves with normal speed
/// g_n: mass, normal and tangential momentum, energy.
struct FaceFlux {
  double mass, normal, tangential, energy;  ///< [mass/area/time], [pressure], [pressure], [power/area]
};

/// What a Riemann solver may need to know; each takes what it does by `S::with(numbers)`.
struct RiemannNumbers {
  double gamma;        ///< ratio of specific heats [-]
  double entropy_fix;  ///< width of the sonic-point fix [-]
};

}  // namespace fsi::fluid
