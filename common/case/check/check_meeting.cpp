#include "common/case/check/check_meeting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "common/case/grids/grid_points.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/types.hpp"

namespace fsi {

namespace {

/// Position at t = 0 of points on a solid's side, as far as it is known here.
std::vector<Vec2> initial_side(const SolidSpec& solid, Side side) {
  std::vector<Vec2> points;
  for (int k = 0; k < points_along(solid.grid, side); ++k) {
    const Vec2 x_bar = side_point(solid.grid, side, k);
    points.push_back(x_bar);
    if (!solid.initial_u) continue;
    points.back() +=
        Vec2(solid.initial_u->c1(x_bar[0], x_bar[1], 0), solid.initial_u->c2(x_bar[0], x_bar[1], 0));
  }
  return points;
}

/// Distance of x from the straight line between a and b.
double distance_from(const Vec2& a, const Vec2& b, const Vec2& x) {
  const double along = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + along * (b - a) - x).norm();
}

bool repeats_along(const GridSpec& grid, Side side) {
  return grid.periodic[static_cast<std::size_t>(1 - direction_of(side))];
}

}  // namespace

void check_periods_meet(const FluidSpec& fluid, const SolidSpec& solid, Side gas_side, Side solid_side,
                        const config::Node& place) {
  const bool gas = repeats_along(fluid.grid, gas_side), own = repeats_along(solid.grid, solid_side);
  const std::string path = fmt::format("solids.{}.boundary", solid.name);
  if (solid.beam && solid.beam->closed) {
    config::fail(
        place.place, path,
        "a ring by `law: beam` has no ends that would keep a side of the gas on its walls; give it a "
        "`shape`, or, between two gases, a law with a grid, such as neo_hookean");
  }
  if (gas != own) {
    config::fail(place.place, path,
                 fmt::format("the sides beside the interface are {}periodic, those of the gas are {}; write "
                             "`periodic` in both or in neither",
                             own ? "" : "not ", own ? "not" : "periodic"));
  }
  if (own && (solid.law == rigid_law || solid.law == beam_law)) {
    config::fail(
        place.place, path,
        fmt::format(
            "a {} cannot be periodic: write `symmetry` for these sides, here and in the gases that it "
            "meets, or take a law that deforms",
            solid.law == beam_law ? "beam" : "rigid body"));
  }
}

void check_sides_meet(const FluidSpec& fluid, const SolidSpec& solid, Side gas_side, Side solid_side,
                      const config::Node& place) {
  const GridSpec& gas_grid = fluid.grid;
  const std::vector<Vec2> side = initial_side(solid, solid_side);
  double length = 0;
  for (std::size_t l = 1; l < side.size(); ++l) length += (side[l] - side[l - 1]).norm();
  const int n = points_along(gas_grid, gas_side);
  constexpr double tolerance = 0.05;  // of the distance of points, as in coupler/exchange/matching.cpp
  const double most =
      tolerance * length / static_cast<double>(std::min(n, static_cast<int>(side.size())) - 1);
  const auto mistake = [&](const Vec2& x, const Vec2& x_solid) {
    config::fail(
        place.place, fmt::format("{}.boundary.{}", fluid.path, name_of(gas_side)),
        fmt::format(
            "its point at ({:.6g}, {:.6g}) does not meet the {} side of solid `{}`, nearest at ({:.6g}, "
            "{:.6g}); let both grids have the same curve there",
            x[0], x[1], name_of(solid_side), solid.name, x_solid[0], x_solid[1]));
  };
  const auto nearest = [&](const Vec2& x) {
    return *std::ranges::min_element(side, {}, [&](const Vec2& other) { return (other - x).norm(); });
  };
  for (int k = 0; k < n; ++k) {
    const Vec2 x = side_point(gas_grid, gas_side, k);
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t l = 1; l < side.size(); ++l)
      distance = std::min(distance, distance_from(side[l - 1], side[l], x));
    if (distance > most) mistake(x, nearest(x));
  }
  for (const Vec2& end : {side.front(), side.back()}) {
    const Vec2 a = side_point(gas_grid, gas_side, 0), b = side_point(gas_grid, gas_side, n - 1);
    const Vec2 x = (a - end).norm() < (b - end).norm() ? a : b;
    if ((x - end).norm() > most) mistake(x, end);
  }
}

}  // namespace fsi
