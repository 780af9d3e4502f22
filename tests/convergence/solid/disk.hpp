#pragma once
/// A disk of radius 1 covered by a Cartesian background and an annulus marched inward from its outline.

#include <cmath>
#include <utility>
#include <vector>

#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/overlap/composite_grid.hpp"
#include "common/grid/shapes/circle.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
#include "solid_solver/solid_component.hpp"

namespace fsi::solid::test {

struct DiskGrids {
  std::vector<SolidPart> parts;
  std::vector<grid::BodyFittedGrid> bodies;
};

/// An annulus of these points, lines and spacing, and a square background of spacing h, `half` to either side; `rim` is the
/// condition on the outline, side bottom of grid 1.
inline DiskGrids body_of(const grid::PlaneCurve& outline, const grid::HyperbolicGrid& annulus, Boundary rim,
                         double h, double half) {
  Boundaries nothing, sides;
  for (Boundary& boundary : nothing) boundary.condition = no_condition;
  sides[0].condition = sides[1].condition = Periodic::condition;
  sides[2] = std::move(rim);
  sides[3].condition = no_condition;
  const double low = -half, high = half;
  const int n = static_cast<int>(std::lround((high - low) / h)) + 1;
  DiskGrids disk;
  disk.parts.push_back({grid::MovingGrid({.name = "inside",
                                          .n1 = n,
                                          .n2 = n,
                                          .mapping = [=](double r, double s, double) -> Vec2 {
                                            return {low + (high - low) * r, low + (high - low) * s};
                                          }},
                                         0),
                        nothing});
  disk.parts.push_back(
      {grid::MovingGrid(grid::marched_from(annulus, grid::points_on(outline, annulus.points)), 0), sides});
  disk.bodies.push_back({.name = annulus.name, .n1 = annulus.points, .n2 = annulus.lines});
  return disk;
}

/// `cells` per `unit` of length, in the background and along the outline.
inline DiskGrids body_of(const grid::PlaneCurve& outline, int cells, Boundary rim, int lines = 9,
                         double unit = 1) {
  const double h = unit / cells;
  const int points = static_cast<int>(grid::length_of(outline) / unit * cells) + 1;
  return body_of(outline, {.name = "annulus", .points = points, .lines = lines, .spacing = h}, std::move(rim),
                 h, 1.25 * unit);
}

inline DiskGrids disk_of(int cells, Boundary rim, int lines = 9, double unit = 1) {
  return body_of(grid::circle({0, 0}, unit), cells, std::move(rim), lines, unit);
}

}  // namespace fsi::solid::test
