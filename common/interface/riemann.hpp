#pragma once
/// The fluid-solid Riemann problem at one interface point, in two and three dimensions.
///
///            t |  / C-  (gas)
///    C_p  C_s  | /
///       \   \  |/
///    ----\---\-+------ x_1
///     solid    |  gas
///
/// Each side sends one family of waves to the interface. The gas brings one relation between normal traction
/// and normal velocity, the solid n_d relations between the vectors w and v. With equal normal velocities and
/// a traction (p_e - p) n on both sides they fix the state in between.
///
/// In Cartesian components all solid relations are one vector equation, w - Z v = w_0 - Z v_0, with the
/// impedance matrix Z the solid publishes: no rotation, no eigenvectors, no constitutive law here.

#include <Eigen/Core>
#include <Eigen/LU>

#include "common/core/choices.hpp"

namespace fsi {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;
template <int D>
using Matrix = Eigen::Matrix<double, D, D>;

/// Predicted state of the gas at an interface point.
template <int D>
struct GasPoint {
  Vector<D> v;     ///< velocity
  double p = 0;    ///< pressure [pressure]
  double p_e = 0;  ///< pressure at which the interface carries no load [pressure]
  double z_f = 0;  ///< impedance rho a [pressure/velocity]
};

/// Predicted state of the solid at an interface point.
template <int D>
struct SolidPoint {
  Vector<D> v;     ///< velocity
  Vector<D> w;     ///< traction eta n0^T P per unit current area
  Matrix<D> Z;     ///< impedance matrix, symmetric and positive definite
  double z_p = 0;  ///< impedance rho_bar c_p of the solid at rest [pressure/velocity]
};

/// One side as the other one sees it along the normal: an impedance and a state on its characteristic.
struct NormalSide {
  double z = 0;    ///< [pressure/velocity]
  double v_n = 0;  ///< [velocity]
  double w_n = 0;  ///< [pressure]
};

/// Common normal velocity and normal traction of both sides.
struct NormalState {
  double v_n = 0;  ///< [velocity]
  double w_n = 0;  ///< [pressure]
};

/// The gas: paper eq. (19), w_n + z_f v_n is constant along C- with w_n = p_e - p.
template <int D>
NormalSide normal_side(const GasPoint<D>& gas, const Vector<D>& n) {
  return {.z = gas.z_f, .v_n = n.dot(gas.v), .w_n = gas.p_e - gas.p};
}

/// The solid: its n_d relations reduced to one between w_n and v_n, paper eq. (26).
///
/// The relations of paper eq. (20), scaled and rotated by paper eq. (21) and paper eq. (22), are those of
/// paper eq. (23); summed over the waves they read w - Z v = w_0 - Z v_0. With w = w_n n (the tangential
/// traction vanishes, paper eq. (24)) the product with n^T Z^-1 leaves
///
///     w_n - z_hat v_n = z_hat (n^T Z^-1 w_0) - z_hat n.v_0,    z_hat = 1 / (n^T Z^-1 n).
///
/// This is z_hat of paper eq. (27), and z_hat n^T Z^-1 w_0 is w_n - k_hat w_t there, without the angle of
/// paper eq. (25).
template <int D>
NormalSide normal_side(const SolidPoint<D>& solid, const Vector<D>& n) {
  const Matrix<D> inverse = solid.Z.inverse();
  const Vector<D> weights = inverse * n;
  const double z_hat = 1.0 / n.dot(weights);
  return {.z = z_hat, .v_n = n.dot(solid.v), .w_n = z_hat * weights.dot(solid.w)};
}

/// The same with Z = z_p I and the tangential traction left out.
template <int D>
NormalSide simplified_side(const SolidPoint<D>& solid, const Vector<D>& n) {
  return {.z = solid.z_p, .v_n = n.dot(solid.v), .w_n = n.dot(solid.w)};
}

/// The state between two characteristics: paper eq. (28), or paper eq. (29) with the simplified solid side.
///
/// It satisfies the matching conditions of paper eq. (12) and paper eq. (24): one normal velocity, one normal
/// traction. Written as a correction of the solid's velocity,
/// so that two equal sides stay equal to the last bit.
inline NormalState between(const NormalSide& solid, const NormalSide& gas) {
  const double jump = gas.w_n - solid.w_n + gas.z * (gas.v_n - solid.v_n);
  const double v_n = solid.v_n + jump / (solid.z + gas.z);
  return {.v_n = v_n, .w_n = gas.w_n - gas.z * (v_n - gas.v_n)};
}

/// The state of the gas at a wall that moves with the normal velocity `v_n`: paper eq. (19) alone.
inline NormalState at_wall(double v_n, const NormalSide& gas) {
  return {.v_n = v_n, .w_n = gas.w_n - gas.z * (v_n - gas.v_n)};
}

/// Projected normal velocity and traction of one interface point.
/// `n` is the unit normal from the solid to the gas.
template <int D>
NormalState project(const SolidPoint<D>& solid, const NormalSide& gas, const Vector<D>& n, Projection how) {
  if (how == Projection::traditional) return {.v_n = n.dot(solid.v), .w_n = gas.w_n};
  return between(how == Projection::full ? normal_side(solid, n) : simplified_side(solid, n), gas);
}

}  // namespace fsi
