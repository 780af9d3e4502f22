#pragma once
/// HLLC approximate Riemann solver on a moving face, with Einfeldt's wave speeds.
///
///      s_L   s_M   s_R            E. F. Toro, M. Spruce, W. Speares, Shock Waves 4 (1994) 25
///          \   |   /              P. Batten et al., SIAM J. Sci. Comput. 18 (1997) 1553
///       L   \ *|* /   R           the face moves with g_n: the state on the ray x / t = g_n counts
///   _________\_|_/_______

#include <cmath>

#include "fluid_solver/kernels/limiter.hpp"
#include "fluid_solver/kernels/riemann/face_state.hpp"

namespace fsi::fluid {

struct RiemannHllc {
  double gamma;  ///< ratio of specific heats [-]

  static RiemannHllc with(const RiemannNumbers& numbers) { return {.gamma = numbers.gamma}; }

  /// Flux of paper eq. (1) minus what the moving face sweeps over, the second and third terms of (31).
  [[gnu::always_inline]] FaceFlux operator()(const FaceState& L, const FaceState& R, double g_n) const {
    const double gamma_1 = gamma - 1.0;
    const double a2_L = gamma * L.p / L.rho, a2_R = gamma * R.p / R.rho;
    const double root = std::sqrt(R.rho / L.rho), weight_L = 1.0 / (1.0 + root), weight_R = root * weight_L;
    const double du = R.u - L.u;
    const double u = weight_L * L.u + weight_R * R.u;
    const double c =
        std::sqrt(weight_L * a2_L + weight_R * a2_R + 0.5 * gamma_1 * weight_L * weight_R * du * du);
    const double s_L = smaller(L.u - std::sqrt(a2_L), u - c), s_R = larger(R.u + std::sqrt(a2_R), u + c);
    const double m_L = L.rho * (s_L - L.u), m_R = R.rho * (s_R - R.u);  // m_L < 0 < m_R
    const double s_M = (L.p - R.p + (m_R * R.u - m_L * L.u)) / (m_R - m_L);

    const bool left = s_M >= g_n;  // which side of the contact the face is on
    const double rho = left ? L.rho : R.rho, u_K = left ? L.u : R.u, v_K = left ? L.v : R.v,
                 p = left ? L.p : R.p;
    const double m_K = left ? m_L : m_R, s_K = left ? s_L : s_R;
    const double behind =
        left ? smaller(s_L - g_n, 0.0) : larger(s_R - g_n, 0.0);  // 0 when the face is in state K

    const double rho_star = m_K / (s_K - s_M);
    const double kinetic = 0.5 * (u_K * u_K + v_K * v_K);
    const double E = p / (rho * gamma_1) + kinetic;
    const double E_star = E + (s_M - u_K) * (s_M + p / m_K);
    const double w = u_K - g_n, mass = rho * w;
    return {.mass = mass + behind * (rho_star - rho),
            .normal = mass * u_K + p + behind * (rho_star * s_M - rho * u_K),
            .tangential = mass * v_K + behind * (rho_star - rho) * v_K,
            .energy = mass * E + p * u_K + behind * (rho_star * E_star - rho * E)};
  }
};

}  // namespace fsi::fluid
