#pragma once
/// Where a deforming body is and how far it has turned.

#include <cstddef>
#include <span>
#include <vector>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/intervals.hpp"

namespace fsi::solid {

struct Pose {
  Vec2 centre = Vec2::Zero();    ///< of mass, in physical space
  Vec2 velocity = Vec2::Zero();  ///< of the centre
  double angle = 0;              ///< of the rotation that fits the motion best [rad], in (-pi, pi]
};

/// What a pose is made of, summed over the pieces of a row of a grid, each weighted by its area. Rows are summed one by
/// one and then in their order, whoever has them.
struct PoseSums {
  double area = 0;
  Vec2 x = Vec2::Zero(), u = Vec2::Zero(), v = Vec2::Zero();
  double x_cross_u = 0, x_dot_u = 0, x_dot_x = 0;

  /// Inlined by force: the sums then stay in registers.
  [[gnu::always_inline]] void add(double dA, const Vec2& at, const Vec2& its_u, const Vec2& its_v) {
    area += dA;
    x += dA * at;
    u += dA * its_u;
    v += dA * its_v;
    x_cross_u += dA * (at[0] * its_u[1] - at[1] * its_u[0]);
    x_dot_u += dA * at.dot(its_u);
    x_dot_x += dA * at.squaredNorm();
  }
  void add(const PoseSums& row);

  static constexpr std::size_t size = 10;
  /// As numbers for other ranks.
  void write(std::vector<double>& to) const;
  static PoseSums read(std::span<const double> from);
};

/// Cells between rows j and j + 1 of a body on one grid, each represented by its middle. `reference`: planes x_bar1,
/// x_bar2; `state`: planes u1, u2, v1, v2 first. Positions are taken from the first point.
PoseSums pose_sums(ConstFieldView reference, ConstFieldView state, int j);

/// One grid of a composite one: as above, the `areas` that its points stand for (grid::area_weights), and which
/// points these are.
struct PosePart {
  ConstFieldView reference, state, areas;
  const grid::RowSets* points = nullptr;
};
/// Points of row j, with positions from `origin`.
PoseSums pose_sums(const PosePart& part, const Vec2& origin, int j);

/// The first point of a body's first grid: positions are taken from there, so that bodies far from the origin of
/// space lose no digits.
Vec2 origin_of_sums(ConstFieldView reference);
/// From the sums over all rows.
Pose pose_from(const PoseSums& sums, const Vec2& origin);

/// Of a body on one grid. Homogeneous density.
Pose pose_of(ConstFieldView reference, ConstFieldView state);
/// The same of a body that several grids cover.
Pose pose_of(std::span<const PosePart> parts);

}  // namespace fsi::solid
