#pragma once
/// A rigid body in the plane: where its outline is, and how it moves.
///
/// Its pivot, a point of it, moves and turns by q = (along x, along y, rotation), as its mounting leaves it: q' = E s with
/// the modal velocities s. A body that nothing holds has E = 1, k = 3 modes; one that slides between walls has the one that
/// they leave. The velocity of the centre of mass and the rate of rotation are V = B s, B = D E, where D(angle) is what
/// motions of the pivot do to the centre, d away from it:
///
///     B^T diag(m, m, I) V' = B^T (force, moment) - E^T (K q + C q'),   n . v = N^T s
///
/// K, C: springs and dampers at the pivot. It answers a load f on its modes by S s = g + dt f; with second-order backward
/// differences of V, and of q where there are springs, dt V' = b V - h_V and q = (dt q' + h_q) / b,
///
///     S = b B^T diag(m, m, I) B + E^T (dt C + dt^2/b K) E
///     g = B^T diag(m, m, I) h_V + dt (B^T (own force, moment) - E^T K h_q / b)
///
/// Where its case gives a part of its motion, q = p(t), it has one more mode, of which the velocity is 1: the last column
/// of E is p'. That mode has so much inertia that no load changes it, to the last bit.

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
#include "solid_solver/rigid/mounting.hpp"

namespace fsi::rigid {

using bodies::Outline;

struct Pose {
  Vec2 centre = Vec2::Zero();  ///< of mass
  double angle = 0;            ///< turned since t = 0 [rad], whole turns counted
};

/// Of the reference body, per depth.
struct Masses {
  double mass = 0;               ///< [mass/depth]
  double moment_of_inertia = 0;  ///< about the centre of mass [mass*length^2/depth]

  Vec3 diagonal() const { return {mass, mass, moment_of_inertia}; }
};

class RigidBody {
 public:
  RigidBody(Outline outline, const Inertia& inertia, double rho, Mounting mounting);
  /// One more side, along which another gas is. Outlines have numbers from 0.
  void add_outline(Outline outline) { outlines_.push_back(std::move(outline)); }

  /// Starts with velocity `V` of the centre and rate of rotation, as far as the mounting leaves it: what an impulse that
  /// would give a body without one this velocity gives it.
  void start(const Vec3& V);
  /// Predicts pose and velocity at `t`, after a step of size dt: q + dt q' + dt^2/2 q'', s + dt s'.
  void advance(double t, double dt);
  /// S and g of S s = g + dt f at the end of the step, with the own load there.
  Eigen::MatrixXd response() const;
  Eigen::VectorXd history(const Vec3& own_load) const;
  /// Ends the step with the modal velocities `s`. The pose is integrated by the trapezoidal rule; against springs by
  /// backward differences.
  void correct(const Eigen::VectorXd& s);

  std::size_t outlines() const { return outlines_.size(); }
  std::size_t points(std::size_t outline = 0) const { return outlines_[outline].x.size() / 2; }
  Eigen::Index modes() const { return E_.cols(); }
  const Masses& masses() const { return masses_; }
  const Outline& outline(std::size_t outline = 0) const { return outlines_[outline]; }
  const Vec2& reference_centre() const { return reference_centre_; }
  Pose pose() const;
  Vec3 velocity() const { return velocity_of(s_); }
  /// V = B s.
  Vec3 velocity_of(const Eigen::VectorXd& s) const { return modes_now() * s; }
  const Eigen::VectorXd& modal_velocity() const { return s_; }
  Eigen::MatrixXd mass_matrix() const;  ///< B^T diag(m, m, I) B
  /// N, k x n: normal velocity of every point of an outline for every mode.
  Eigen::MatrixXd mode_vectors(std::size_t outline = 0) const;
  /// B^T load.
  Eigen::VectorXd modal_load(const Vec3& load) const { return modes_now().transpose() * load; }

  void archive(Archive& archive);

  /// Where a point of the reference body is now, and how fast.
  Vec2 position(const Vec2& x_bar) const;
  Vec2 velocity_at(const Vec2& x) const;
  /// The same for a whole outline, 2 n.
  std::vector<double> positions(std::size_t outline = 0) const;
  std::vector<double> velocities(std::span<const double> x) const;
  /// Before the first step: does it turn, or slow down?
  bool starts_unevenly() const {
    return velocity()[2] != 0 || !acceleration_.isZero(0) || !given_acceleration_.isZero(0);
  }
  /// Of points at x then, without a load: 2 n.
  std::vector<double> initial_accelerations(std::span<const double> x) const;

  double kinetic_energy() const { return 0.5 * s_.dot(mass_matrix() * s_); }
  double spring_energy() const { return 0.5 * q_.dot(mounting_.spring.cwiseProduct(q_)); }
  Vec2 momentum() const { return masses_.mass * velocity().head<2>(); }
  /// About the origin.
  double angular_momentum() const;

 private:
  std::vector<Outline> outlines_;
  Vec2 reference_centre_, arm_;  ///< of the centre of mass; from the pivot to it [length]
  Masses masses_;
  Mounting mounting_;
  double t_ = 0;
  Eigen::Matrix3Xd E_;                      ///< now
  Vec3 given_acceleration_ = Vec3::Zero();  ///< p'' at t = 0
  Vec3 q_ = Vec3::Zero(), old_q_ = Vec3::Zero(),
       older_q_ = Vec3::Zero();  ///< now, before the step, and before
  Eigen::VectorXd s_, old_s_;    ///< modal velocities now, and before the step
  Vec3 old_V_ = Vec3::Zero(),
       older_V_ = Vec3::Zero();              ///< of the centre: before the step, and one more before
  Eigen::VectorXd acceleration_, old_mean_;  ///< at the last corrected time; mean of the step before
  double dt_ = 0, old_dt_ = 0;

  BackwardDifference difference() const { return backward_difference(dt_, old_dt_); }
  Vec2 arm() const;
  Eigen::Matrix3d at_centre() const;
  Eigen::MatrixXd modes_now() const;
  Eigen::MatrixXd resisted(Eigen::MatrixXd S) const;
  Eigen::VectorXd pushed(Eigen::VectorXd g) const;
  Eigen::VectorXd modes_at_rest() const;
  Eigen::VectorXd unloaded_acceleration() const;
  void go_as_given(double t);
  void take_acceleration();
};

}  // namespace fsi::rigid
