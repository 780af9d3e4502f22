#pragma once
/// What the two sides of a cell face know, in the frame of the face: u along its normal, v along the face.

namespace fsi::fluid {

struct FaceState {
  double rho, u, v, p;
};

/// Flux through a unit of face that moves with normal speed
/// g_n: mass, normal and tangential momentum, energy.
struct FaceFlux {
  double mass, normal, tangential, energy;
};

}  // namespace fsi::fluid
