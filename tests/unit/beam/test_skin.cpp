/// The outline of a beam.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "beams.hpp"
#include "common/grid/shapes/smoothed_polygon.hpp"
#include "solid_solver/beam/skin.hpp"

namespace fsi::beam {
namespace {

using namespace testing;

const Section soft{.EA = 3, .GA = 1, .EI = 0.02, .mass = 0.5, .inertia = 0.01};

/// A slab with rounded ends around the line.
bodies::Outline slab() {
  const grid::SmoothedPolygon polygon{.corners = {{-0.05, -0.05}, {1.05, -0.05}, {1.05, 0.05}, {-0.05, 0.05}},
                                      .ends = grid::Curve::closed};
  return {.x = grid::points_on(grid::smoothed_polygon(polygon), 121)};
}

/// Bent far, and on its way.
BeamMotion bent(const std::array<End, 2>& ends) {
  BeamMotion motion(straight(soft, 12), ends);
  for (int k = 0; k < 6; ++k) motion.advance(0.2, on_tip(motion.model(), 1, 0.05), nullptr);
  EXPECT_GT(std::abs(motion.u()[motion.model().freedoms() - 1]), 0.2);
  return motion;
}

TEST(BeamSkin, AtRestItIsTheOutlineGiven) {
  const BeamMotion motion(straight(soft, 12), loose);
  const Skin skin(motion.model().line(), slab(), loose);
  const std::vector<double> x = skin.state(motion).x;
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], skin.outline().x[k], 1e-15);
}

TEST(BeamSkin, ItsModeVectorsGiveTheNormalVelocityOfItsPoints) {
  for (const auto& ends : {cantilever, loose}) {
    const BeamMotion motion = bent(ends);
    const Skin skin(motion.model().line(), slab(), ends);
    const SkinState state = skin.state(motion);
    const std::vector<double>&x = state.x, &v = state.v, n = skin.normals(x);
    const Eigen::VectorXd v_n = skin.mode_vectors(state, n).transpose() * motion.q_dot();
    const std::size_t points = skin.points();
    for (std::size_t k = 0; k < points; ++k)
      EXPECT_NEAR(v_n[static_cast<Eigen::Index>(k)], n[k] * v[k] + n[points + k] * v[points + k], 1e-14);
  }
}

/// One side of the beam, between walls at its ends: these neither turn nor slide off them with free sections.
TEST(BeamSkin, FreeEndsKeepToTheWallsAndSoDoTheirModes) {
  constexpr std::size_t points = 21;
  bodies::Outline side{.x = std::vector<double>(2 * points, 0.05), .ends = grid::Curve::open};
  for (std::size_t k = 0; k < points; ++k) side.x[k] = static_cast<double>(k) / (points - 1);
  const BeamMotion motion = bent(loose);
  const Skin skin(motion.model().line(), side, loose, {true, true});
  const SkinState state = skin.state(motion);
  for (const std::size_t end : {std::size_t{0}, points - 1}) {
    EXPECT_NEAR(state.x[end], side.x[end], 1e-15);
    EXPECT_NEAR(state.v[end], 0, 1e-15);
    EXPECT_GT(std::abs(state.x[points + end] - 0.05), 0.01);
  }
  EXPECT_GT(std::abs(state.v[1]), 1e-3);
  const std::vector<double> n = skin.normals(state.x);
  const Eigen::VectorXd v_n = skin.mode_vectors(state, n).transpose() * motion.q_dot();
  for (std::size_t k = 0; k < points; ++k)
    EXPECT_NEAR(v_n[static_cast<Eigen::Index>(k)], n[k] * state.v[k] + n[points + k] * state.v[points + k],
                1e-14);
}

/// The section of a hinge turns: what lies off the line there would leave the wall.
TEST(BeamSkin, TheFootOfAHingeStaysWhereItIs) {
  constexpr std::array hinged{End::pinned, End::free};
  constexpr std::size_t points = 21;
  bodies::Outline side{.x = std::vector<double>(2 * points, 0.05), .ends = grid::Curve::open};
  for (std::size_t k = 0; k < points; ++k) side.x[k] = static_cast<double>(k) / (points - 1);
  const BeamMotion motion = bent(hinged);
  EXPECT_GT(std::abs(motion.u()[2]), 0.05);
  const Skin skin(motion.model().line(), side, hinged, {true, true});
  const SkinState state = skin.state(motion);
  EXPECT_NEAR(state.x[0], 0, 1e-15);
  EXPECT_NEAR(state.v[0], 0, 1e-15);
  const std::vector<double> n = skin.normals(state.x);
  const Eigen::VectorXd v_n = skin.mode_vectors(state, n).transpose() * motion.q_dot();
  EXPECT_NEAR(v_n[0], n[0] * state.v[0] + n[points] * state.v[points], 1e-14);
}

/// The face of a bar in a duct: its corners slide along the walls, which is where the bar goes.
TEST(BeamSkin, TheFaceOfABarGoesWithIt) {
  constexpr std::size_t points = 9;
  bodies::Outline face{.x = std::vector<double>(2 * points, 1), .ends = grid::Curve::open};
  for (std::size_t k = 0; k < points; ++k)
    face.x[points + k] = 0.1 * static_cast<double>(k) / (points - 1) - 0.05;
  BeamMotion motion(straight(plate_section(2, 3, 3, 0.1), 10), loose);
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(motion.model().freedoms());
  for (int node = 0; node < motion.model().nodes(); ++node) rates[freedom_of(node)] = 0.3;
  motion.start(rates);
  const Skin skin(motion.model().line(), face, loose, {true, true});
  const SkinState state = skin.state(motion);
  const Eigen::VectorXd v_n = skin.mode_vectors(state, skin.normals(state.x)).transpose() * motion.q_dot();
  for (std::size_t k = 0; k < points; ++k) {
    EXPECT_NEAR(state.v[k], 0.3, 1e-15);
    EXPECT_NEAR(std::abs(v_n[static_cast<Eigen::Index>(k)]), 0.3, 1e-14);
  }
}

TEST(BeamSkin, ItsVelocitiesAreThoseOfItsPositions) {
  BeamMotion motion = bent(loose);
  const Skin skin(motion.model().line(), slab(), loose);
  const auto [before, v, arm] = skin.state(motion);
  constexpr double dt = 1e-5;
  motion.advance(dt, Eigen::VectorXd::Zero(motion.model().freedoms()), nullptr);
  const std::vector<double> after = skin.state(motion).x;
  for (std::size_t k = 0; k < v.size(); ++k) EXPECT_NEAR((after[k] - before[k]) / dt, v[k], 2e-4);
}

TEST(BeamSkin, APressureActsWithItsForceAndItsMoment) {
  const BeamMotion motion = bent(loose);
  const Skin skin(motion.model().line(), slab(), loose);
  const std::vector<double> x = skin.state(motion).x, n = skin.normals(x);
  const Eigen::SparseMatrix<double> N = skin.mode_vectors(skin.state(motion), n);
  Eigen::VectorXd pull(N.cols());
  Eigen::Vector3d exact = Eigen::Vector3d::Zero(), found = Eigen::Vector3d::Zero();
  const std::size_t points = skin.points();
  for (std::size_t k = 0; k < points; ++k) {
    const double w = std::sin(0.1 * static_cast<double>(k));
    pull[static_cast<Eigen::Index>(k)] = w;
    exact += w * Eigen::Vector3d(n[k], n[points + k], x[k] * n[points + k] - x[points + k] * n[k]);
  }
  const Eigen::VectorXd f = motion.free_motions() * (N * pull);
  for (int node = 0; node < motion.model().nodes(); ++node) {
    const Vec2 at =
        motion.model().line().x[static_cast<std::size_t>(node)] + motion.u().segment<2>(freedom_of(node));
    const Vec2 force = f.segment<2>(freedom_of(node));
    found += Eigen::Vector3d(force.x(), force.y(), at.x() * force.y() - at.y() * force.x() + f[3 * node + 2]);
  }
  EXPECT_LE((found - exact).head<2>().norm(), 1e-13);
  // Cubics carry the turn of a bent line over to (l kappa)^4 or so.
  EXPECT_LE(std::abs(found[2] - exact[2]), 1e-4);
}

TEST(BeamSkin, BetweenTheNodesItHasNoCorners) {
  // The direction of a bent outline between points closer than
  // the nodes, by fourth-order smoothness of the cubics.
  const BeamMotion motion = bent(cantilever);
  bodies::Outline line{.x = {}, .ends = grid::Curve::open};
  constexpr std::size_t points = 97;
  for (const double y : {0.0, 1.0}) {
    for (std::size_t k = 0; k < points; ++k)
      line.x.push_back(y > 0 ? 0.05 : static_cast<double>(k) / (points - 1));
  }
  const Skin skin(motion.model().line(), line, cantilever);
  const std::vector<double> n = skin.normals(skin.state(motion).x);
  double largest = 0, total = 0;
  for (std::size_t k = 1; k + 1 < points; ++k) {
    const double turn = std::abs(n[k] * n[points + k + 1] - n[points + k] * n[k + 1]);
    largest = std::max(largest, turn);
    total += turn;
  }
  EXPECT_LE(largest,
            4 * total / points);  // the clamp bends most; corners at 12 nodes would be 8 times the mean
  EXPECT_EQ(skin.freedom().front(), 2);  // the clamped end keeps its normal
  EXPECT_EQ(skin.freedom().back(), 0);
}

}  // namespace
}  // namespace fsi::beam
