#pragma once
/// A rigid body in the plane: where its outline is, and how it moves.
///
/// Modal velocities s: velocity of the centre of mass and rate of rotation are V = B s. A free body has B =
/// 1, k = 3 modes; a body that slides between walls has the one that they leave.
///
///     M s' = B^T (force, moment),   M = B^T diag(m, m, I) B,   n . v = N^T s
///
/// It answers a load f on its modes by S s = g + dt f, second-order backward differences.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/time/backward_difference.hpp"
#include "common/core/types.hpp"
#include "solid_solver/bodies/outline.hpp"
#include "solid_solver/rigid/inertia.hpp"

namespace fsi::rigid {

using Vec3 = Eigen::Vector3d;  ///< along x, along y, rotation

using bodies::Outline;

struct Pose {
  Vec2 centre = Vec2::Zero();  ///< of mass
  double angle = 0;            ///< turned since t = 0 [rad], whole turns counted
};

/// Mass and freedom of a body.
struct Dynamics {
  double mass = 0;                                      ///< [mass/depth]
  double moment_of_inertia = 0;                         ///< about the centre of mass [mass*length^2/depth]
  Eigen::MatrixXd modes = Eigen::Matrix3d::Identity();  ///< B, one column per mode
};

class RigidBody {
 public:
  RigidBody(Outline outline, const Inertia& inertia, double rho, Eigen::MatrixXd modes);
  /// One more side, along which another gas is. Outlines have numbers from 0.
  void add_outline(Outline outline) { outlines_.push_back(std::move(outline)); }

  /// Starts with velocity `V` of the centre and rate of rotation, as far as the body is free to.
  void start(const Vec3& V);
  /// Predicts pose and velocity after a step of size dt: x + dt V + dt^2/2 a, V + dt a.
  void advance(double dt);
  /// S and g of S s = g + dt f at the end of the step, with the own load there.
  Eigen::MatrixXd response() const;
  Eigen::VectorXd history(const Vec3& own_load) const;
  /// Ends the step with the modal velocities `s`. The pose is integrated by the trapezoidal rule.
  void correct(const Eigen::VectorXd& s);

  std::size_t outlines() const { return outlines_.size(); }
  std::size_t points(std::size_t outline = 0) const { return outlines_[outline].x.size() / 2; }
  Eigen::Index modes() const { return dynamics_.modes.cols(); }
  const Dynamics& dynamics() const { return dynamics_; }
  const Outline& outline(std::size_t outline = 0) const { return outlines_[outline]; }
  const Vec2& reference_centre() const { return reference_centre_; }
  const Pose& pose() const { return pose_; }
  Vec3 velocity() const { return dynamics_.modes * s_; }
  const Eigen::VectorXd& modal_velocity() const { return s_; }
  Eigen::MatrixXd mass_matrix() const;
  /// N, k x n: normal velocity of every point of an outline for every mode.
  Eigen::MatrixXd mode_vectors(std::size_t outline = 0) const;
  /// B^T load.
  Eigen::VectorXd modal_load(const Vec3& load) const { return dynamics_.modes.transpose() * load; }

  void archive(Archive& archive);

  /// Where a point of the reference body is now, and how fast.
  Vec2 position(const Vec2& x_bar) const;
  Vec2 velocity_at(const Vec2& x) const;
  /// The same for a whole outline, 2 n.
  std::vector<double> positions(std::size_t outline = 0) const;
  std::vector<double> velocities(std::span<const double> x) const;
  /// Of points at x: accelerations towards the centre of mass, -omega^2 r, 2 n.
  std::vector<double> centripetal_accelerations(std::span<const double> x) const;

  double kinetic_energy() const { return 0.5 * s_.dot(mass_matrix() * s_); }
  Vec2 momentum() const { return dynamics_.mass * velocity().head<2>(); }
  /// About the origin.
  double angular_momentum() const;

 private:
  std::vector<Outline> outlines_;
  Vec2 reference_centre_;
  Dynamics dynamics_;
  Pose pose_, old_pose_;
  Eigen::VectorXd s_, old_s_, older_s_;      ///< modal velocities now, before the step, and one more before
  Eigen::VectorXd acceleration_, old_mean_;  ///< at the last corrected time; mean of the step before
  double dt_ = 0, old_dt_ = 0;

  BackwardDifference difference() const { return backward_difference(dt_, old_dt_); }
  void take_acceleration();
};

}  // namespace fsi::rigid
