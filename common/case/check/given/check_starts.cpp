#include "common/case/check/given/check_starts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/case/check/given/given.hpp"
#include "common/case/check/given/sample.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/types.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// Of a formula that the case gives, with the place where it stands.
struct Formula {
  const std::optional<VectorExpressions>& value;
  const Node& node;
  std::string path;
};

void check_finite(const Formula& formula, const std::vector<Vec2>& points) {
  if (!formula.value) return;
  for (const Vec2& x : points) {
    const double c1 = formula.value->c1(x[0], x[1], 0), c2 = formula.value->c2(x[0], x[1], 0);
    if (std::isfinite(c1) && std::isfinite(c2)) continue;
    fail(formula.node.place, formula.path,
         fmt::format("is ({}, {}) at ({:.6g}, {:.6g}), t = 0; must be finite", c1, c2, x[0], x[1]));
  }
}

/// The grids that follow an outline have it where it is at rest.
void check_outline_stays(const SolidSpec& solid, const Formula& u) {
  constexpr double tolerance = 0.05;  // of the distance of points, as in coupler/exchange/matching.cpp
  const std::vector<Vec2> outline = outline_points(solid.body_fitted.front().curve);
  double length = 0;
  for (std::size_t k = 1; k < outline.size(); ++k) length += (outline[k] - outline[k - 1]).norm();
  const double most = tolerance * length / static_cast<double>(outline.size() - 1);
  for (const Vec2& x : outline) {
    const Vec2 moved(u.value->c1(x[0], x[1], 0), u.value->c2(x[0], x[1], 0));
    if (moved.norm() <= most) continue;
    fail(u.node.place, u.path,
         fmt::format(
             "moves the outline by ({:.3g}, {:.3g}) at ({:.6g}, {:.6g}), but the grid of the gas begins "
             "at its `shape`; let it be zero along the outline, or move the `shape`",
             moved[0], moved[1], x[0], x[1]));
  }
}

/// The law has a stress wherever the body starts.
void check_strain(const SolidSpec& solid, const Formula& displacement) {
  if (!is_continuum(solid.law)) return;
  const GivenVector u = given_by(*displacement.value);
  for (const BodyCell& cell : sample_cells(solid)) {
    const std::string wrong = unbearable(solid, deformation_gradient(cell, u, 0));
    if (!wrong.empty())
      fail(displacement.node.place, displacement.path,
           fmt::format("{} in the cell at ({:.6g}, {:.6g}), t = 0", wrong, cell.x[0], cell.x[1]));
  }
}

}  // namespace

void check_starts(const Case& problem, const Node& root) {
  for (const SolidSpec& solid : problem.solids) {
    const Node& node = *root.find("solids")->find(solid.name);
    const std::string path = "solids." + solid.name;
    const std::vector<Vec2> points = sample_points(solid);
    if (const Node* force = node.find("body_force"))
      check_finite({solid.body_force, *force, path + ".body_force"}, points);
    const Node* initial = node.find("initial");
    if (initial == nullptr || solid.initial_from_reference) continue;
    if (const Node* v = initial->find("v")) check_finite({solid.initial_v, *v, path + ".initial.v"}, points);
    const Node* u = initial->find("u");
    if (u == nullptr || !solid.initial_u) continue;
    const Formula displacement{solid.initial_u, *u, path + ".initial.u"};
    check_finite(displacement, points);
    check_strain(solid, displacement);
    if (!problem.fluids.empty() && !solid.body_fitted.empty()) check_outline_stays(solid, displacement);
  }
}

}  // namespace fsi
