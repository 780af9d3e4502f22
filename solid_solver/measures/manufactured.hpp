#pragma once
/// A solution by choice. Given by its displacement alone, velocity, stress and the body force that makes it
/// exact follow from the law; given by u, v and P as in paper eq. (46), all equations need sources.
/// Derivatives of the displacement are fourth-order differences of its formula, on few points: formulas of a
/// case file are what takes the time.

#include "solid_solver/laws/any_law.hpp"
#include "solid_solver/options.hpp"

namespace fsi::solid {

/// Formulas of the reference position; v and P follow from u where they are empty.
struct ChosenFields {
  VectorFunction u;
  VectorFunction v = {};
  TensorFunction P = {};
};

class Manufactured {
 public:
  /// The fields must be smooth, on the scale of four thousandths of the body and of the time in which a p-wave
  /// crosses it, also a little outside the body. @param size of the body [length]
  Manufactured(ChosenFields fields, AnyLaw law, double rho, double size);

  Vec2 velocity(double x, double y, double t) const;
  Tensor2 deformation_gradient(double x, double y, double t) const;
  Tensor2 stress(double x, double y, double t) const;
  SolidState state(double x, double y, double t) const;

  /// What the rates of u, v and P lack to be those of the fields: u_t - v, v_t - div P / rho, P_t - K(F) grad
  /// v. First derivatives only, by central differences of a step so small that their error is of no account.
  /// paper eq. (4)
  SolidState source(double x, double y, double t) const;
  /// P - P(F(u)).
  Tensor2 offset(double x, double y, double t) const;
  /// rho u_tt - div P per unit reference volume, with dP_ji/dx_j = K_jikl d2u_k/dx_j dx_l. paper eq. (2)
  Vec2 body_force(double x, double y, double t) const;

 private:
  VectorFunction u_, v_;
  TensorFunction P_;
  AnyLaw law_;
  double rho_;
  double size_;  ///< [length]
  double time_;  ///< [time]
};

}  // namespace fsi::solid
