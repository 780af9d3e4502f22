#include "common/grid/geometry/near_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/core/failure.hpp"

namespace fsi::grid {

namespace {

constexpr double far = std::numeric_limits<double>::infinity();

struct Bounds {
  double x_a = far, x_b = -far, y_a = far, y_b = -far;

  explicit Bounds(std::span<const double> x) {
    const std::size_t n = x.size() / 2;
    for (std::size_t k = 0; k < n; ++k) {
      x_a = std::min(x_a, x[k]), x_b = std::max(x_b, x[k]);
      y_a = std::min(y_a, x[n + k]), y_b = std::max(y_b, x[n + k]);
    }
  }
  bool holds(const Vec2& x, double margin) const {
    return x[0] > x_a - margin && x[0] < x_b + margin && x[1] > y_a - margin && x[1] < y_b + margin;
  }
};

/// The smaller one of z and 1, from one to the other by a parabola around 1: grid velocities do not jump.
double at_most_one(double z) {
  constexpr double width = NearCurves::onset / NearCurves::lines_between - 1;
  constexpr double least = 0.01;  // of curves that cross: their grids fold, which is told
  if (z >= 1 + width) return 1;
  const double over = std::max(0.0, z - (1 - width));
  return std::max(least, z - over * over / (4 * width));
}

}  // namespace

NearCurves::NearCurves(std::vector<FittedCurve> curves)
    : curves_(std::move(curves)), parts_(curves_.size()), touching_(curves_.size() * curves_.size(), false) {
  constexpr double round_off = 1e-6;  // of a line's distance
  for (std::size_t a = 0; a < curves_.size(); ++a) {
    for (std::size_t b = 0; b < curves_.size(); ++b) {
      touching_[a * curves_.size() + b] =
          a != b && gap_between(curves_[a].x, curves_[b].x).distance <= round_off * curves_[a].step;
    }
  }
  measure();
}

void NearCurves::place(std::size_t k, std::span<const double> x) {
  curves_[k].x.assign(x.begin(), x.end());
}

void NearCurves::measure() {
  nearest_ = {.gap = {.distance = far}};
  for (std::vector<double>& part : parts_) part.clear();
  for (std::size_t a = 0; a < curves_.size(); ++a) {
    for (std::size_t b = 0; b < curves_.size(); ++b) {
      if (a != b && !touching(a, b) && !touching(b, a)) look(a, b);
    }
  }
}

/// What curve b leaves of the depth along curve a.
void NearCurves::look(std::size_t a, std::size_t b) {
  const std::span<const double> x = curves_[a].x;
  const std::size_t n = x.size() / 2;
  const double reach = onset * curves_[a].step;
  const Bounds other(curves_[b].x);
  std::vector<double>& part = parts_[a];
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 here(x[k], x[n + k]);
    if (!other.holds(here, reach)) continue;
    const double distance = distance_to(curves_[b].x, here);
    if (distance >= reach) continue;
    if (distance < nearest_.gap.distance) nearest_ = {.a = a, .b = b, .gap = {distance, here}};
    if (part.empty()) part.assign(n, 1.0);
    part[k] = std::min(part[k], at_most_one(distance / (lines_between * curves_[a].step)));
  }
}

void report_too_near(const NearCurves& near, const CompositeGrid& composite, double t) {
  const double cell = std::min(composite.background().dx(), composite.background().dy());
  const Approach& nearest = near.nearest();
  if (nearest.gap.distance >= NearCurves::fewest_cells * cell) return;
  const auto called = [&](std::size_t k) {
    const BodyFittedGrid& body = composite.body(static_cast<int>(k) + 1);
    return body.of.empty() ? fmt::format("the curve of grid \"{}\"", body.name) : body.of;
  };
  throw Diverged(
      fmt::format(
          "{} and {} are {:.3g} apart, less than {} of a cell of the gas's background ({:.3g}): gas is not "
          "computed between bodies so near to each other, nor is contact; let {}, or let "
          "them come nearer with a greater grid.factor",
          called(nearest.a), called(nearest.b), nearest.gap.distance, NearCurves::fewest_cells, cell,
          t > 0 ? "the run end before" : "them begin farther apart"),
      {.t = t, .position = {nearest.gap.x[0], nearest.gap.x[1]}});
}

NearCurves leave_room(std::span<MovingGrid* const> grids, std::span<const BodyFittedGrid> bodies, double t) {
  std::vector<FittedCurve> curves;
  for (std::size_t k = 0; k < grids.size(); ++k)
    curves.push_back({.x = grids[k]->side_points(bodies[k].curve), .step = grids[k]->line_distance()});
  NearCurves near(std::move(curves));
  for (std::size_t k = 0; k < grids.size(); ++k) {
    if (near.part(k).empty()) continue;
    grids[k]->leave_part(near.part(k));
    for (int level = 0; level < 2; ++level) grids[k]->move(t);  // now and before
  }
  return near;
}

}  // namespace fsi::grid
