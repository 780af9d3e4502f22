#pragma once
/// The split flux on a moving face: each side sends what its own fastest wave lambda = |u| + a carries,
/// f = (f_L + lambda_L q_L) / 2 + (f_R - lambda_R q_R) / 2. Rusanov's flux, but for the speed, which is not
/// common to both sides.
///
/// With first-order states it leaves every point a positive density and pressure, whatever its neighbours
/// are: a point loses the part dt sum A lambda / (2 V) of its own state, which is below its own Courant
/// number, and gains states of the form lambda q +- f(q),
/// which are positive where lambda is at least |u| + a.
///
///     V. V. Rusanov, USSR Comput. Math. Math. Phys. 1 (1962) 304
///     B. Perthame, C.-W. Shu, Numer. Math. 73 (1996) 119, on positivity

#include <cmath>

#include "fluid_solver/kernels/riemann/face_state.hpp"

namespace fsi::fluid {

struct RiemannSplit {
  double gamma;  ///< [-]

  /// Flux of paper eq. (1) minus what the moving face sweeps over, the second and third terms of (31).
  [[gnu::always_inline]] FaceFlux operator()(const FaceState& L, const FaceState& R, double g_n) const {
    const FaceFlux from_L = half(L, g_n, 1.0), from_R = half(R, g_n, -1.0);
    return {.mass = from_L.mass + from_R.mass,
            .normal = from_L.normal + from_R.normal,
            .tangential = from_L.tangential + from_R.tangential,
            .energy = from_L.energy + from_R.energy};
  }

 private:
  /// (f + direction lambda q) / 2 of one side.
  [[gnu::always_inline]] FaceFlux half(const FaceState& K, double g_n, double direction) const {
    const double w = K.u - g_n, fastest = std::fabs(w) + std::sqrt(gamma * K.p / K.rho);
    const double carried = 0.5 * (w + direction * fastest), mass = carried * K.rho;
    const double E = K.p / (gamma - 1.0) + 0.5 * K.rho * (K.u * K.u + K.v * K.v);
    return {.mass = mass,
            .normal = mass * K.u + 0.5 * K.p,
            .tangential = mass * K.v,
            .energy = carried * E + 0.5 * K.p * K.u};
  }
};

}  // namespace fsi::fluid
