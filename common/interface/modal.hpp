#pragma once
/// Solids with degrees of freedom q (a rigid body, a spring-mounted piston, a beam): their interface velocity
/// is n . v = N q_dot. They have no impedance of their own; the gas answers their motion with an added mass
/// per unit time, and they answer a load f by what their own implicit scheme makes of it:
///
///     f = f~ - A q_dot,   A = sum z_f ds N^T N        gas
///     S q_dot = g + dt f                              solid
///     (S + dt A) q_dot = g + dt f~                    both

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <span>

#include "common/interface/riemann.hpp"
#include "common/interface/wave_curve.hpp"

namespace fsi {

/// Up to so many modes a dense factorisation costs less than a sparse one.
inline constexpr Eigen::Index few_modes = 16;

/// Load of the gas on the modes: f~ - A q_dot.
struct ModalLoad {
  Eigen::SparseMatrix<double> A;  ///< added-mass matrix [force/velocity], k x k
  Eigen::VectorXd f;              ///< f~: the load the gas would exert on a body at rest, k
};

/// Load from paper eq. (19) at every point: the traction of the gas on a wall of velocity v_n is r - z_f v_n.
/// @param N mode vectors, N(m, i) = n . dx/dq_m at point i  @param ds length of interface that belongs to
/// each point
ModalLoad modal_load(const Eigen::SparseMatrix<double>& N, std::span<const NormalSide> gas,
                     std::span<const double> ds);

/// Solution of S x = right for a symmetric S without negative eigenvalues, of which the lower triangle counts;
/// many unknowns sparsely. @return empty where S of many unknowns is singular
Eigen::VectorXd solve_modes(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& right);
/// The same for few unknowns, S = L D L^T in the order they have: pivots would compare a mass with a moment of
/// inertia. A direction of no resistance at all gets no velocity.
Eigen::VectorXd solve_few_modes(Eigen::MatrixXd S, Eigen::VectorXd right);

/// Velocities at the end of a step dt of a solid that answers a load by S q_dot = g + dt f.
/// @return empty where nothing resists a mode
Eigen::VectorXd project_modes(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& g,
                              const ModalLoad& load, double dt);

/// The velocities that balance a body with the gas along its whole wave curve. `answer` gives those
/// that balance it with a gas of linear answer (empty: nothing resists a mode); where that touches the curve
/// is found by Newton's iteration, from the gas's own velocity on (which is the linear solution), with steps
/// halved while they do not shrink.
/// @param N mode vectors, as in modal_load
Eigen::VectorXd balance(const Eigen::SparseMatrix<double>& N, std::span<const GasSide> gas,
                        const std::function<Eigen::VectorXd(std::span<const NormalSide>)>& answer);
/// The same with an answer to the load of the gas. @param ds as in modal_load
Eigen::VectorXd balance(const Eigen::SparseMatrix<double>& N, std::span<const GasSide> gas,
                        std::span<const double> ds,
                        const std::function<Eigen::VectorXd(const ModalLoad&)>& answer);

}  // namespace fsi
