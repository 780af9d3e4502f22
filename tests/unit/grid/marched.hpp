#pragma once
/// A grid marched from a shape, for the tests of marching.

#include <vector>

#include "common/core/field.hpp"
#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/shapes/plane_curve.hpp"

namespace fsi::grid {

struct Marched {
  HyperbolicGrid description;
  std::vector<double> curve;
  Field x;
};

inline Marched march(const PlaneCurve& shape, const HyperbolicGrid& description, double t = 0) {
  Marched result{description, points_on(shape, description.points),
                 Field(Layout(description.points, description.lines), 2)};
  HyperbolicMarch(description).march(result.curve, result.x.view(), t);
  return result;
}

}  // namespace fsi::grid
