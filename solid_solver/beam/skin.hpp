#pragma once
/// The outline of a beam: where the gas meets it.
///
///     o---o---o---o---o   outline        x = c(s) + Lambda(s) r
///     |   |   |   |   |                  v = c'(s) + theta'(s) e_z x Lambda(s) r
///     +---+---+---+---+   centre line    s, r: of each point of the outline, found at rest
///
/// Between the nodes the centre line and the rotation are the cubic through four of them, so that the outline
/// has no corners at the nodes. A load on the outline acts on the degrees of freedom by the transpose: force
/// and power are the same on both.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/core/types.hpp"
#include "solid_solver/beam/motion.hpp"
#include "solid_solver/bodies/outline.hpp"

namespace fsi::beam {

/// A point that moves with a section of the beam.
struct Attached {
  std::array<int, 4> node{};       ///< around the section
  std::array<double, 4> weight{};  ///< of their values at the section
  Vec2 r = Vec2::Zero();           ///< from the centre line, at rest
  double s = 0;                    ///< place on the line, in elements [-]
};

/// The section nearest to a point. @param line four nodes or more
Attached attach(const Line& line, const Vec2& x);

struct PointState {
  Vec2 x, v, arm;    ///< arm: from the centre line
  double theta = 0;  ///< [rad]
};

/// Where an attached point is, and how fast.
PointState state_of(const BeamMotion& beam, const Attached& point);

/// The points of an outline with the beam: components one after the other, as in messages.
struct SkinState {
  std::vector<double> x, v;
  std::vector<Vec2> arm;  ///< Lambda r of every point
};

class Skin {
 public:
  /// @param on_wall whether the first and the last point of an open outline slide along a wall that the gas has there
  Skin(const Line& line, bodies::Outline outline, const std::array<End, 2>& ends,
       const std::array<bool, 2>& on_wall = {false, false});

  const bodies::Outline& outline() const { return outline_; }
  std::size_t points() const { return places_.size(); }
  const Attached& place(std::size_t k) const { return places_[k]; }
  SkinState state(const BeamMotion& beam) const;
  /// Outward unit normals of the outline at these positions.
  /// An end whose section cannot turn keeps that of rest.
  std::vector<double> normals(const std::vector<double>& x) const;
  /// Marks of such ends, as in wire::Freedom.
  std::vector<std::uint8_t> freedom() const;
  /// N, modes x points: normal velocity of every point for every free motion of the beam.
  Eigen::SparseMatrix<double> mode_vectors(const SkinState& state, const std::vector<double>& normals) const;

 private:
  /// What a degree of freedom of a node adds to an entry of N.
  struct Part {
    std::size_t entry = 0;      ///< among the values of N
    std::size_t component = 0;  ///< 0, 1: along the normal; 2: turning
    double weight = 0, part = 0;
  };
  /// Normals of the walls along which the first and the last point slide; zero: along none.
  using Walls = std::array<Vec2, 2>;
  static Vec2 along_wall(const Vec2& wall, const Vec2& d) { return d - wall.dot(d) * wall; }
  void find_walls(const Line& line, const std::array<End, 2>& ends, const std::array<bool, 2>& on_wall);
  void find_places_of_modes(const Line& line, const std::array<End, 2>& ends);

  bodies::Outline outline_;
  std::vector<Attached> places_;
  std::array<bool, 2> upright_{false,
                               false};  ///< the first and the last point belong to a section that cannot turn
  Walls walls_{Vec2::Zero(), Vec2::Zero()};
  std::vector<double> n_at_rest_;
  Eigen::SparseMatrix<double> modes_;  ///< the places of N, which never change
  std::vector<Part> parts_;            ///< of all points, in this order
  std::vector<std::size_t> ends_of_parts_;
};

}  // namespace fsi::beam
