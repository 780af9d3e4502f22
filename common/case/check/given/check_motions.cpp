#include "common/case/check/given/check_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/case/check/given/sample.hpp"
#include "common/core/types.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

constexpr int looks = 2000;      ///< times at which a motion is looked at
constexpr double no_way = 1e-9;  ///< of the furthest it goes

double time_of(const Case& problem, int look) {
  return problem.time.end * look / looks;
}

/// Has a value at all times. Returns the furthest it goes.
double furthest_of(const Case& problem, const Expression& q, const Node& node, const std::string& path) {
  double furthest = 0;
  for (int look = 0; look <= looks; ++look) {
    const double t = time_of(problem, look), value = q(0, 0, t);
    if (!std::isfinite(value))
      fail(node.place, path, fmt::format("is {} at t = {:.6g}; must be finite", value, t));
    furthest = std::max(furthest, std::fabs(value));
  }
  return furthest;
}

void check_start(const Expression& q, double least, const Node& node, const std::string& path) {
  const double start = q(0, 0, 0);
  if (std::fabs(start) <= least) return;
  fail(
      node.place, path,
      fmt::format("is {:.6g} at t = 0, but its outline is where the body is then: let it begin at 0, and put "
                  "the outline there",
                  start));
}

/// A jump is as high however closely one looks at it.
void check_jumps(const Case& problem, const Expression& q, double least, const Node& node,
                 const std::string& path) {
  constexpr int halvings = 30;
  constexpr double sharp = 0.2;  // of the way between two looks, in a billionth of the time between them
  for (int look = 0; look < looks; ++look) {
    double a = time_of(problem, look), b = time_of(problem, look + 1);
    const auto way = [&](double from, double to) { return std::fabs(q(0, 0, to) - q(0, 0, from)); };
    const double whole = way(a, b);
    if (whole <= least) continue;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (a + b) / 2;
      (way(a, middle) > way(middle, b) ? b : a) = middle;
    }
    if (way(a, b) <= sharp * whole) continue;
    fail(node.place, path,
         fmt::format("jumps by {:.4g} at t = {:.6g}; let it go there within some time, as with "
                     "`min(max((t - 1) / 0.1, 0), 1)`",
                     q(0, 0, b) - q(0, 0, a), b));
  }
}

/// Of the area within a closed curve.
Vec2 centre_of(const std::vector<Vec2>& outline) {
  double twice_area = 0;
  Vec2 moment = Vec2::Zero();
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 a = outline[k] - outline[0], b = outline[(k + 1) % outline.size()] - outline[0];
    twice_area += cross(a, b);
    moment += cross(a, b) / 3 * (a + b);
  }
  return outline[0] + moment / twice_area;
}

/// Where a body whose motion is known altogether is at any time.
class Way {
 public:
  Way(const SolidSpec& solid, std::vector<Vec2> outline)
      : given_(solid.mounting.given),
        outline_(std::move(outline)),
        pivot_(solid.mounting.pivot ? *solid.mounting.pivot : centre_of(outline_)) {}

  std::vector<Vec2> at(double t) const {
    std::array<double, 3> q{};
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = given_[k] ? (*given_[k])(0, 0, t) : 0;
    const double c = std::cos(q[2]), s = std::sin(q[2]);
    std::vector<Vec2> now;
    for (const Vec2& x : outline_) {
      const Vec2 r = x - pivot_;
      now.emplace_back(pivot_ + Vec2(q[0] + c * r.x() - s * r.y(), q[1] + s * r.x() + c * r.y()));
    }
    return now;
  }

 private:
  std::array<std::optional<Expression>, 3> given_;
  std::vector<Vec2> outline_;
  Vec2 pivot_;
};

/// @param path of the section `motion`
void check_stays_in(const Case& problem, const FluidSpec& gas, const SolidSpec& solid, const Node& node,
                    const std::string& path) {
  constexpr int often = 20;  // looks between two at which all of the outline is looked at
  const auto fitted = std::ranges::find(gas.body_fitted, solid.name, &BodyFittedSpec::solid);
  if (fitted == gas.body_fitted.end() || !fitted->curve.closed() ||
      gas.grid.kind != GridSpec::Kind::rectangle)
    return;
  const Way way(solid, outline_points(fitted->curve));
  for (int look = 0; look <= looks; look += often) {
    const double t = time_of(problem, look);
    for (const Vec2& x : way.at(t)) {
      const bool within =
          x.x() > gas.grid.x_a && x.x() < gas.grid.x_b && x.y() > gas.grid.y_a && x.y() < gas.grid.y_b;
      if (within) continue;
      fail(node.place, path,
           fmt::format("takes the body out of its gas: at t = {:.4g} a point of its outline is at ({:.4g}, "
                       "{:.4g}), and "
                       "the grid of the gas has x: [{:.4g}, {:.4g}], y: [{:.4g}, {:.4g}]; make that larger, "
                       "the motion "
                       "smaller, or end before",
                       t, x.x(), x.y(), gas.grid.x_a, gas.grid.x_b, gas.grid.y_a, gas.grid.y_b));
    }
  }
}

}  // namespace

void check_motions(const Case& problem, const Node& root) {
  for (const SolidSpec& solid : problem.solids) {
    const MountingSpec& mounting = solid.mounting;
    if (!mounting.moves_as_given()) continue;
    const Node& node = *root.find("solids")->find(solid.name)->find("motion");
    const std::string path = fmt::format("solids.{}.motion", solid.name);
    for (std::size_t k = 0; k < rigid_motions.size(); ++k) {
      if (!mounting.given[k]) continue;
      const Node& formula = *node.find(rigid_motions[k]);
      const std::string of = fmt::format("{}.{}", path, rigid_motions[k]);
      const double least = no_way * furthest_of(problem, *mounting.given[k], formula, of);
      check_start(*mounting.given[k], least, formula, of);
      check_jumps(problem, *mounting.given[k], least, formula, of);
    }
    if (std::ranges::count(mounting.free, true) > 0) continue;  // where it goes is for the gas to say
    for (const FluidSpec& gas : problem.fluids) check_stays_in(problem, gas, solid, node, path);
  }
}

}  // namespace fsi
