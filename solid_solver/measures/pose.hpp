#pragma once
/// Where a deforming body is and how far it has turned.

#include <span>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/intervals.hpp"

namespace fsi::solid {

struct Pose {
  Vec2 centre = Vec2::Zero();    ///< of mass, in physical space
  Vec2 velocity = Vec2::Zero();  ///< of the centre
  double angle = 0;              ///< of the rotation that fits the motion best [rad], in (-pi, pi]
};

/// `reference`: planes x_bar1, x_bar2; `state`: planes u1, u2, v1, v2 first. Homogeneous density.
Pose pose_of(ConstFieldView reference, ConstFieldView state);

/// One grid of a composite one: as above, the `areas` that its points stand for (grid::area_weights), and which
/// points these are.
struct PosePart {
  ConstFieldView reference, state, areas;
  const grid::RowSets* points = nullptr;
};

/// The same of a body that several grids cover.
Pose pose_of(std::span<const PosePart> parts);

}  // namespace fsi::solid
