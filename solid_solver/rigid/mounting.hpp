#pragma once
/// How a rigid body is held.

#include <Eigen/Core>
#include <optional>

#include "common/core/types.hpp"
#include "solid_solver/rigid/given_motion.hpp"

namespace fsi::rigid {

/// What holds a body, at a point of it. At rest where the body is at t = 0.
struct Mounting {
  std::optional<Vec2> pivot = {};  ///< that point at t = 0; none: the centre of mass
  /// E: what it is free to do there, orthogonal unit vectors of (along x, along y, rotation) in columns.
  Eigen::Matrix3Xd freedoms = Eigen::Matrix3d::Identity();
  Vec3 spring = Vec3::Zero();  ///< K [force/length/depth], of the rotation [force*length/depth]
  Vec3 damper = Vec3::Zero();  ///< C, the same times time
  GivenMotion given = {};      ///< p(t), of what `freedoms` leave out
};

}  // namespace fsi::rigid
