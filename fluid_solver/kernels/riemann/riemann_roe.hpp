#pragma once
/// Roe's approximate Riemann solver with Harten's sonic-point fix on a moving face. Where the linearised
/// states between the waves would have no density left (two strong rarefactions), all waves are upwinded with
/// the fastest speed instead, which keeps density and pressure positive (B. Einfeldt et al., J. Comput. Phys.
/// 92 (1991) 273, on why Roe's solver cannot).
///
///      u - c   u   u + c          P. L. Roe, J. Comput. Phys. 43 (1981) 357
///          \   |   /              A. Harten, J. Comput. Phys. 49 (1983) 357
///       L   \  |  /   R           the face moves with g_n: waves are upwinded by lambda - g_n
///   _________\_|_/_______

#include <cmath>

#include "fluid_solver/kernels/limiter.hpp"
#include "fluid_solver/kernels/riemann/face_state.hpp"

namespace fsi::fluid {

struct RiemannRoe {
  double gamma;                                  ///< ratio of specific heats [-]
  double entropy_fix;                            ///< |lambda| is rounded off below entropy_fix * c [-]
  static constexpr double least_density = 1e-3;  ///< between the waves, as part of the mean density [-]

  static RiemannRoe with(const RiemannNumbers& numbers) {
    return {.gamma = numbers.gamma, .entropy_fix = numbers.entropy_fix};
  }

  /// Flux of paper eq. (1) minus what the moving face sweeps over, the second and third terms of (31). One
  /// root and one division serve all Roe averages: sqrt(rho_L) / (sqrt(rho_L) + sqrt(rho_R)) = rho_L / (rho_L
  /// + sqrt(rho_L rho_R)).
  [[gnu::always_inline]] FaceFlux operator()(const FaceState& L, const FaceState& R, double g_n) const {
    const double gamma_1 = gamma - 1.0, enthalpy = gamma / gamma_1;
    const double rho = std::sqrt(L.rho * R.rho);
    const double scale = 1.0 / (rho * (L.rho + R.rho + 2.0 * rho));
    const double of_L = (R.rho + rho) * scale, of_R = (L.rho + rho) * scale;  // 1 / (rho_K + rho)
    const double weight_L = L.rho * of_L, weight_R = R.rho * of_R;
    const double u = weight_L * L.u + weight_R * R.u;
    const double v = weight_L * L.v + weight_R * R.v;
    const double k_L = 0.5 * (L.u * L.u + L.v * L.v), k_R = 0.5 * (R.u * R.u + R.v * R.v);
    const double H = (weight_L * k_L + weight_R * k_R) + enthalpy * (of_L * L.p + of_R * R.p);
    const double k = 0.5 * (u * u + v * v);
    const double c2 = gamma_1 * (H - k);
    const double c = std::sqrt(c2), c2_inverse = 1.0 / c2, c_inverse = c * c2_inverse;

    const double dp = (R.p - L.p) * c2_inverse, du = rho * (R.u - L.u) * c_inverse;
    const double alpha_minus = 0.5 * (dp - du), alpha_plus = 0.5 * (dp + du);
    const double w_L = L.u - g_n, w_R = R.u - g_n, speed = u - g_n;
    const bool vacuum = larger(-L.rho - alpha_minus, alpha_plus - R.rho) > -least_density * rho;
    const double fastest = larger(std::fabs(w_L), std::fabs(w_R)) + c;
    const double flow = vacuum ? fastest : std::fabs(speed);
    const double minus = alpha_minus * (vacuum ? fastest : rounded(std::fabs(speed - c), c, c_inverse));
    const double plus = alpha_plus * (vacuum ? fastest : rounded(std::fabs(speed + c), c, c_inverse));
    const double contact = flow * (R.rho - L.rho - dp);
    const double shear = flow * rho * (R.v - L.v);
    const double acoustic = minus + plus, all = acoustic + contact, difference = (plus - minus) * c;

    const double m_L = L.rho * w_L, m_R = R.rho * w_R;
    const double internal = 1.0 / gamma_1;
    return {.mass = 0.5 * ((m_L + m_R) - all),
            .normal = 0.5 * ((m_L * L.u + m_R * R.u) + (L.p + R.p) - (all * u + difference)),
            .tangential = 0.5 * ((m_L * L.v + m_R * R.v) - (all * v + shear)),
            .energy =
                0.5 * ((m_L * k_L + m_R * k_R) + internal * (L.p * w_L + R.p * w_R) +
                       (L.p * L.u + R.p * R.u) - (acoustic * H + difference * u + contact * k + shear * v))};
  }

 private:
  /// |lambda| with the corner at the sonic point replaced by a parabola of half-width entropy_fix * c.
  [[gnu::always_inline]] double rounded(double lambda, double c, double c_inverse) const {
    const double width = entropy_fix * c;
    const double parabola = (0.5 / entropy_fix) * (lambda * lambda * c_inverse) + 0.5 * width;
    return lambda < width ? parabola : lambda;
  }
};

}  // namespace fsi::fluid
