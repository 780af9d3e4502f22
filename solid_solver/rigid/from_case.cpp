#include "solid_solver/rigid/from_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/case/schema/boundary_facts.hpp"
#include "common/core/failure.hpp"
#include "common/grid/moving_grid.hpp"
#include "common/program/grid_from_case.hpp"

namespace fsi::rigid {

namespace {

[[noreturn]] void refuse(const SolidSpec& spec, const std::string& what) {
  throw UserMistake(fmt::format("solid \"{}\" is rigid: {}", spec.name, what));
}

const BoundarySpec& at(const std::array<BoundarySpec, 4>& boundary, Side side) {
  return boundary[static_cast<std::size_t>(side)];
}

bool is_interface(const BoundarySpec& spec) {
  return spec.kind == BoundaryKind::interface;
}

/// What the sides of a body leave of its freedom.
class Freedom {
 public:
  explicit Freedom(const SolidSpec& spec) : spec_(spec) {}

  void add(const BoundarySpec& boundary, Side side, const Vec2& along) {
    switch (schema::solid_boundary(boundary.kind).holds) {
      case Hold::normal:
        slide(side, along);
        return;
      case Hold::nothing:
        if (carries_load(boundary))
          refuse(spec_,
                 fmt::format("side {} cannot carry a load of its own; write free, and the load as body_force",
                             name_of(side)));
        return;
      case Hold::motion:
        refuse(spec_,
               fmt::format("the motion of side {} cannot be given; let the side be free", name_of(side)));
      case Hold::others:
        return;
    }
  }

  /// As the sides and the case leave it.
  Mounting mounting(double t_end) const {
    const MountingSpec& held = spec_.mounting;
    return {.pivot = held.pivot,
            .freedoms = freedoms(),
            .spring = Eigen::Map<const Vec3>(held.spring.data()),
            .damper = Eigen::Map<const Vec3>(held.damper.data()),
            .given = GivenMotion(held.given, t_end)};
  }

 private:
  const SolidSpec& spec_;
  std::optional<Vec2> direction_;

  Eigen::Matrix3Xd freedoms() const {
    if (direction_ && !spec_.mounting.moves_as_given()) return Vec3(direction_->x(), direction_->y(), 0);
    Eigen::Matrix3Xd columns(3, std::ranges::count(spec_.mounting.free, true));
    for (Eigen::Index k = 0, column = 0; k < 3; ++k)
      if (spec_.mounting.free[static_cast<std::size_t>(k)]) columns.col(column++) = Vec3::Unit(k);
    return columns;
  }

  void slide(Side side, const Vec2& along) {
    if (spec_.fixed) return;  // it moves nowhere, whatever its sides leave it
    constexpr double parallel = 1e-8;
    const bool same =
        !direction_ || std::abs(direction_->x() * along.y() - direction_->y() * along.x()) < parallel;
    if (!same)
      refuse(spec_,
             fmt::format("side {} and another one slide along different walls, so that nothing can move",
                         name_of(side)));
    direction_ = along;
  }
};

Side opposite(Side side) {
  for (const Side other : all_sides) {
    if (other != side && direction_of(other) == direction_of(side)) return other;
  }
  std::abort();  // each has one
}

/// Direction of a side; `check` lets straight ones slide.
Vec2 direction_along(const std::vector<double>& x) {
  const std::size_t n = x.size() / 2;
  return Vec2(x[n - 1] - x[0], x[2 * n - 1] - x[n]).normalized();
}

void append(std::vector<std::array<double, 2>>& rim, const std::vector<double>& side, bool backwards) {
  const std::size_t n = side.size() / 2;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t at_k = backwards ? n - 1 - k : k;
    rim.push_back({side[at_k], side[n + at_k]});
  }
}

/// All four sides, the body to their left.
std::vector<double> rim_of(const grid::MovingGrid& grid) {
  std::vector<std::array<double, 2>> points;
  append(points, grid.side_points(Side::bottom), false);
  append(points, grid.side_points(Side::right), false);
  append(points, grid.side_points(Side::top), true);
  append(points, grid.side_points(Side::left), true);
  std::vector<double> rim(2 * points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    rim[k] = points[k][0];
    rim[points.size() + k] = points[k][1];
  }
  return rim;
}

BodyFromCase body_of_shape(const SolidSpec& spec, double t_end) {
  const BodyFittedSpec& fitted = spec.body_fitted.front();
  Freedom freedom(spec);
  for (const Side side : all_sides) {
    const BoundarySpec& boundary = at(fitted.boundary, side);
    Vec2 along(1, 0);
    if (fitted.curve.walls && direction_of(side) == 0) {
      const Side wall = (*fitted.curve.walls)[at_upper_end(side) ? 1 : 0];
      if (direction_of(wall) == 0) along = Vec2(0, 1);
      if (!fitted.curve.on.empty()) along = fitted.curve.along[at_upper_end(side) ? 1 : 0];
    }
    freedom.add(boundary, side, along);
  }
  const Inertia inertia = inertia_of(fitted.curve.x);
  const Outline outline{.x = fitted.curve.x,
                        .ends = fitted.curve.closed() ? grid::Curve::closed : grid::Curve::open,
                        .orientation = grid::outward(fitted.side)};
  return {.body = RigidBody(outline, inertia, spec.rho, freedom.mounting(t_end)),
          .area = inertia.area,
          .meets_gas = is_interface(at(fitted.boundary, fitted.side))};
}

BodyFromCase body_of_grid(const SolidSpec& spec, double t_end) {
  const grid::MovingGrid grid(grid_from_case(spec.grid, false), 0);
  Freedom freedom(spec);
  std::vector<Outline> outlines;
  std::vector<std::vector<double>> across;
  const auto add_outline = [&](Side side) {
    const bool closed = grid.periodic(1 - direction_of(side));
    outlines.push_back({.x = grid.side_points(side),
                        .ends = closed ? grid::Curve::closed : grid::Curve::open,
                        .orientation = grid::outward(side)});
    across.push_back(grid.side_points(opposite(side)));
  };
  for (const Side side : all_sides) {
    const BoundarySpec& boundary = at(spec.boundary, side);
    freedom.add(boundary, side, direction_along(grid.side_points(side)));
    if (is_interface(boundary)) add_outline(side);
  }
  const Inertia inertia = inertia_of(rim_of(grid));
  const bool meets_gas = !outlines.empty();
  if (!meets_gas) add_outline(Side::bottom);
  BodyFromCase result{.body = RigidBody(outlines.front(), inertia, spec.rho, freedom.mounting(t_end)),
                      .area = inertia.area,
                      .meets_gas = meets_gas,
                      .across = std::move(across)};
  for (std::size_t k = 1; k < outlines.size(); ++k) result.body.add_outline(outlines[k]);
  return result;
}

/// Velocity of the centre, and the rotation that fits the velocities along the outline best.
Vec3 initial_motion(const RigidBody& body, const VectorExpressions& v) {
  const auto value = [&](const Vec2& x) { return Vec2(v.c1(x.x(), x.y(), 0), v.c2(x.x(), x.y(), 0)); };
  const Vec2 centre = body.pose().centre, of_centre = value(centre);
  const std::vector<double>& x = body.outline().x;
  double turning = 0, squares = 0;
  for (std::size_t k = 0; k < body.points(); ++k) {
    const Vec2 at_k(x[k], x[body.points() + k]);
    const Vec2 r = at_k - centre, difference = value(at_k) - of_centre;
    turning += r.x() * difference.y() - r.y() * difference.x();
    squares += r.squaredNorm();
  }
  return {of_centre.x(), of_centre.y(), turning / squares};
}

}  // namespace

BodyFromCase body_from_case(const SolidSpec& spec, double t_end) {
  if (spec.initial_from_reference || spec.initial_u) {
    refuse(spec, "initial may give `v`, and nothing else");
  }
  BodyFromCase result = spec.body_fitted.empty() ? body_of_grid(spec, t_end) : body_of_shape(spec, t_end);
  if (spec.fixed && spec.initial_v)
    refuse(spec, "it is fixed, but `initial` gives it a velocity; leave one of them out");
  if (spec.initial_v) result.body.start(initial_motion(result.body, *spec.initial_v));
  return result;
}

}  // namespace fsi::rigid
