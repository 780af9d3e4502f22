#pragma once
/// Solids with a few global degrees of freedom q (a rigid body, a spring-mounted piston): their interface
/// velocity is n . v = N q_dot. They have no impedance of their own; the gas answers their motion with an
/// added mass per unit time.
///
///     M q_ddot = f~ - A q_dot + f_own,     A = sum z_f ds N^T N

#include <Eigen/Core>
#include <span>

#include "common/core/archive.hpp"
#include "common/interface/riemann.hpp"

namespace fsi::coupler {

/// Load of the gas on the modes: f~ - A q_dot.
struct ModalLoad {
  Eigen::MatrixXd A;  ///< added-mass matrix [force/velocity], k x k
  Eigen::VectorXd f;  ///< f~: the load the gas would exert on a body at rest, k
};

/// Load from paper eq. (19) at every point: the traction of the gas on a wall of velocity v_n is r - z_f v_n.
/// @param N mode vectors, N(m, i) = n . dx/dq_m at point i  @param ds length of interface that belongs to
/// each point
ModalLoad modal_load(const Eigen::MatrixXd& N, std::span<const NormalSide> gas, std::span<const double> ds);

/// Integrates the modal velocities by the second-order backward difference formula with variable steps (first
/// step: backward Euler). It damps what is infinitely fast, so that bodies without mass are as stable as
/// heavy ones; the trapezoidal rule would let their load change sign at every step for ever.
class ModalMotion {
 public:
  explicit ModalMotion(const Eigen::VectorXd& q_dot) : now_(q_dot), before_(q_dot) {}

  /// One step of size dt to a time with mass M, own load f_own and gas load `load`.
  const Eigen::VectorXd& advance(const Eigen::MatrixXd& M, const Eigen::VectorXd& f_own,
                                 const ModalLoad& load, double dt);
  const Eigen::VectorXd& q_dot() const { return now_; }
  void archive(Archive& archive);

 private:
  Eigen::VectorXd now_, before_;
  double dt_before_ = 0;
};

}  // namespace fsi::coupler
