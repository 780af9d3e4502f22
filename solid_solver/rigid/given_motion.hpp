#pragma once
/// The motion of a rigid body that its case gives, whatever the gas does.

#include <Eigen/Core>
#include <array>
#include <optional>

#include "common/core/input/expression.hpp"

namespace fsi::rigid {

using Vec3 = Eigen::Vector3d;  ///< along x, along y, rotation

/// q(t) of the pivot: along x, along y, rotation. What is not given is 0.
class GivenMotion {
 public:
  using Formulas = std::array<std::optional<Expression>, 3>;

  GivenMotion() = default;
  /// @param t_end of the case: differences in time are taken over a small part of it [time]
  GivenMotion(Formulas formulas, double t_end);

  /// Is there any?
  explicit operator bool() const { return step_ > 0; }
  /// Puts the given components of q where they are at t.
  void put(double t, Vec3& q) const;
  /// By differences of fourth order: central ones, forward ones at t = 0, before which there is no motion.
  Vec3 rate(double t) const { return difference(t, 1); }
  Vec3 acceleration(double t) const { return difference(t, 2); }

 private:
  Formulas formulas_ = {};
  double step_ = 0;  ///< of differences [time]

  Vec3 difference(double t, int order) const;
};

}  // namespace fsi::rigid
