/// Rigid bodies from case files.

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/core/failure.hpp"
#include "solid_solver/rigid/from_case.hpp"

namespace fsi::rigid {
namespace {

BodyFromCase body_of(const std::string& name, const std::vector<std::string>& overrides,
                     const std::vector<std::string>& laws = {}) {
  const Case problem = load_case(configs_folder() + "/" + name + ".yaml", overrides, laws);
  return body_from_case(problem.solids.front(), problem.time.end);
}

std::string refusal(const std::string& name, const std::vector<std::string>& overrides,
                    const std::vector<std::string>& laws = {}) {
  try {
    body_of(name, overrides, laws);
  } catch (const UserMistake& mistake) {
    return mistake.what();
  }
  return "";
}

TEST(RigidFromCase, AnEllipseHasTheMassAndMomentOfItsArea) {
  const BodyFromCase result = body_of("shock_ellipse", {}, {"ellipse=rigid"});
  const double a = 1.25, b = 0.5, mass = 0.1 * std::numbers::pi * a * b;
  EXPECT_TRUE(result.meets_gas);
  EXPECT_EQ(result.body.modes(), 3);
  EXPECT_NEAR(result.body.masses().mass / mass, 1, 1e-3);
  EXPECT_NEAR(result.body.masses().moment_of_inertia / (mass * (a * a + b * b) / 4), 1, 1e-3);
}

TEST(RigidFromCase, WallsLeaveThePistonItsMotionAlongThem) {
  const BodyFromCase result = body_of("rigid_piston", {"parameters.angle=30"});
  ASSERT_EQ(result.body.modes(), 1);
  EXPECT_NEAR(result.area, 0.5, 1e-14);
  const Eigen::MatrixXd N = result.body.mode_vectors();
  for (Eigen::Index k = 0; k < N.cols(); ++k) EXPECT_NEAR(std::abs(N(0, k)), 1, 1e-13);
}

TEST(RigidFromCase, IsHeldAsTheCaseSays) {
  const RigidBody body = body_of("sprung_foil", {"parameters.incidence=0", "grid.factor=1"}).body;
  ASSERT_EQ(body.modes(), 2);
  const Vec3 up = body.velocity_of(Vec2(1, 0)), turn = body.velocity_of(Vec2(0, 1));
  EXPECT_LE((up - Vec3(0, 1, 0)).norm(), 1e-14);
  EXPECT_LE((turn - Vec3(0, 0.15, 1)).norm(), 1e-3);  // about the axis at -0.15
}

TEST(RigidFromCase, AnInitialVelocityGivesTranslationAndRotation) {
  const BodyFromCase result = body_of("spinning_block", {}, {"block=rigid"});
  EXPECT_FALSE(result.meets_gas);
  EXPECT_LE((result.body.velocity() - Vec3(0, 0, 0.5)).norm(), 1e-14);
}

TEST(RigidFromCase, WhatARigidBodyCannotMeetIsRefused) {
  EXPECT_NE(
      refusal("rigid_piston", {"solids.solid.boundary.left=clamped"}).find("cannot have its motion given"),
      std::string::npos);
  EXPECT_NE(refusal("rigid_piston", {"solids.solid.boundary.left=slip_wall"}).find("it cannot move"),
            std::string::npos);
  EXPECT_EQ(refusal("rigid_piston", {"solids.solid.boundary.left=slip_wall", "solids.solid.motion=fixed"}),
            "");
  EXPECT_NE(
      refusal("moving_together_disk", {"solids.disk.initial={u: [0.1, 0]}"}, {"disk=rigid"}).find("`v`"),
      std::string::npos);
  EXPECT_NE(refusal("rigid_piston", {"interface.projection=traditional"}).find("interface.projection"),
            std::string::npos);
  EXPECT_NE(refusal("elastic_piston", {}, {"solid=rigid"}).find("may begin with `v`"), std::string::npos);
}

}  // namespace
}  // namespace fsi::rigid
