#pragma once
/// A beam that moves: supports, and implicit steps by second-order backward differences.
///
/// With b the leading weight and h the past (common/core/time/backward_difference.hpp),
/// for the free velocities q':
///
///     M (b q' - h_v) = dt (f + f_int(u)),   u = (dt q' + h_u) / b
///
/// linearised where the step is predicted, u*, this is the response S q' = g + dt f to a load f:
///
///     S = b M + dt^2 / b K*,   g = M h_v + dt (f_own + f_int(u*) + K* (u* - h_u / b))
///
/// The prediction solves the equation with the load that the gas would exert if its characteristic stayed
/// what it was (common/interface/modal.hpp), by Newton's iteration: so K* has the stresses of a state that
/// exists, and not those of an extrapolation of stiff motions, and what remains to be linear is the change of
/// the gas in a step.
///
/// A turn of a section by d stretches what is extrapolated linearly by d^2 / 2, which for a thin beam is a
/// force out of all proportion. So the geometric part of the stiffness takes the stresses that the last
/// iteration meant to reach, not those it met: D. Magisano, L. Leonetti, G. Garcea, How to improve efficiency
/// and robustness of the Newton method in geometrically non-linear structural problems, Computer Methods in
/// Applied Mechanics and Engineering 313, 2017. What the iteration converges to is the same.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/choices.hpp"
#include "common/core/time/backward_difference.hpp"
#include "common/interface/modal_system.hpp"
#include "solid_solver/beam/model.hpp"

namespace fsi::beam {

using End = BeamEnd;

/// Unit vectors of the motions that the supports of a line leave, in columns.
Eigen::SparseMatrix<double> free_motions(const Line& line, const std::array<End, 2>& ends);

/// Where a degree of freedom appears among the free motions.
struct FreeMotion {
  int column = -1;  ///< -1: it is held
  double part = 0;  ///< of the motion's unit vector [-]
};
/// Of every degree of freedom. @param B free motions
std::vector<FreeMotion> places_among(const Eigen::SparseMatrix<double>& B);

/// S and g of S q' = g + dt f.
struct Response {
  Eigen::SparseMatrix<double> S;
  Eigen::VectorXd g;
};

class BeamMotion {
 public:
  BeamMotion(BeamModel model, const std::array<End, 2>& ends);

  /// Starts at rest in shape with these velocities, as far as the supports leave them.
  void start(const Eigen::VectorXd& u_dot);
  /// Predicts the state after a step.
  /// @param own load on the degrees of freedom at its end  @param gas what the gas answered last; null: none
  /// @throws Diverged where the iteration does not converge
  void advance(double dt, const Eigen::VectorXd& own, const ModalLoad* gas);
  /// Ends the step with the velocities of the free motions.
  void correct(const Eigen::VectorXd& q_dot);
  Response response() const;
  /// The same with the lower triangle of S alone, whose entries always have the same places.
  Response lower_response() const;

  const BeamModel& model() const { return model_; }
  const Eigen::SparseMatrix<double>& free_motions() const { return B_; }
  FreeMotion free_motion(Eigen::Index freedom) const { return free_[static_cast<std::size_t>(freedom)]; }
  Eigen::Index modes() const { return B_.cols(); }
  const Eigen::VectorXd& u() const { return u_; }
  const Eigen::VectorXd& u_dot() const { return u_dot_; }
  Eigen::VectorXd q_dot() const { return B_.transpose() * u_dot_; }

  double kinetic_energy() const { return 0.5 * model_.mass().dot(u_dot_.cwiseAbs2()); }
  Vec2 momentum() const;
  /// About the origin.
  double angular_momentum() const;
  void archive(Archive& archive);

 private:
  BackwardDifference difference() const { return backward_difference(dt_, dt_before_); }
  Eigen::VectorXd displacement_of(const Eigen::VectorXd& u_dot) const;
  double improve(const ModalLoad* gas, std::vector<Resultants>& stress);
  void find_places();
  void assemble(const std::vector<Resultants>& stress, Response& into) const;

  BeamModel model_;
  Eigen::SparseMatrix<double> B_;            ///< free motions
  std::vector<FreeMotion> free_;             ///< of every degree of freedom
  std::vector<std::array<int, 36>> places_;  ///< of the elements' stiffness in the lower triangle; -1: none
  std::vector<int> diagonal_;                ///< places of the diagonal there
  Response own_response_;                    ///< lower triangle; used again in every iteration
  ModalSolver solver_;
  Eigen::VectorXd u_, u_old_,
      u_older_;  ///< displacements and rotations now, before the step, and one more before
  Eigen::VectorXd u_dot_, v_old_, v_older_;  ///< velocities
  Eigen::VectorXd own_;                      ///< load at the end of the step
  double dt_ = 0, dt_before_ = 0;
};

}  // namespace fsi::beam
