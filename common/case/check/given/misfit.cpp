#include "common/case/check/given/misfit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/case/check/given/given.hpp"
#include "common/case/schema/boundary_facts.hpp"
#include "common/core/failure.hpp"
#include "common/exact/disk_table.hpp"

namespace fsi {

namespace {

using Found = std::optional<Misfit>;

/// The first of them that finds something.
template <class... Search>
Found first_of(const Case& problem, Search... search) {
  Found found;
  static_cast<void>(((found = search(problem)) || ...));
  return found;
}

Found not_one_of_each(const Case& problem) {
  if (problem.fluids.size() == 1 && problem.solids.size() == 1) return {};
  return {{"reference.kind", fmt::format("`{}` is computed with one gas and one solid; leave it out",
                                         name_of(problem.reference.kind))}};
}

// --- the piston

Found not_side_by_side(const Case& problem) {
  const FluidSpec& fluid = problem.fluids.front();
  const SolidSpec& solid = problem.solids.front();
  const bool straight = solid.grid.kind == GridSpec::Kind::rectangle && solid.grid.rotation == 0 &&
                        fluid.grid.kind == GridSpec::Kind::rectangle && fluid.grid.rotation == 0;
  const bool meets =
      fluid.boundary[0].kind == BoundaryKind::interface && solid.boundary[1].kind == BoundaryKind::interface;
  if (straight && meets && solid.body_fitted.empty() && fluid.body_fitted.empty()) return {};
  return {
      {"reference.kind",
       fmt::format("the one-dimensional run needs rectangles along x, the gas to the right of solid `{}`; "
                   "leave it out",
                   solid.name)}};
}

/// What lies beyond the two long sides must not be felt.
Found felt_across(const Case& problem) {
  const FluidSpec& fluid = problem.fluids.front();
  const SolidSpec& solid = problem.solids.front();
  for (const Side side : {Side::bottom, Side::top}) {
    const auto k = static_cast<std::size_t>(side);
    const Hold hold = schema::solid_boundary(solid.boundary[k].kind).holds;
    const bool of_gas = fluid.boundary[k].kind == BoundaryKind::far_field;
    const bool of_solid = hold == Hold::motion || (hold == Hold::nothing && solid.lambda != 0);
    if (!of_gas && !of_solid) continue;
    return {{fmt::format("{}.boundary.{}", of_gas ? fluid.path : "solids." + solid.name, name_of(side)),
             "is felt in the one-dimensional motion that `reference` computes; write symmetry or slip_wall, "
             "or periodic "
             "sides, or leave `reference` out"}};
  }
  return {};
}

/// The chain takes no force along it.
Found pulled(const Case& problem) {
  const SolidSpec& solid = problem.solids.front();
  if (!solid.body_force) return {};
  return {{fmt::format("solids.{}.body_force", solid.name),
           "the one-dimensional run has no body force; leave it out, or `reference`"}};
}

/// Of x alone, and along x.
Found varies_across(const Case& problem) {
  const FluidSpec& fluid = problem.fluids.front();
  const SolidSpec& solid = problem.solids.front();
  const auto is_along = [](const Expression& along, const Expression& across, const GridSpec& grid,
                           double t) {
    constexpr int samples = 8;
    for (int a = 0; a <= samples; ++a) {
      for (int b = 0; b <= samples; ++b) {
        const double x = grid.x_a + (grid.x_b - grid.x_a) * a / samples;
        const double y = grid.y_a + (grid.y_b - grid.y_a) * b / samples;
        if (across(x, y, t) != 0 || !(std::fabs(along(x, y, t) - along(x, 0, t)) <= 1e-9)) return false;
      }
    }
    return true;
  };
  const Expression none(0.0);
  const std::string words =
      "must depend on x alone, and point along x, for the one-dimensional run; or leave out "
      "`reference`";
  if (const auto& gas = fluid.initial) {
    const bool good = is_along(gas->v1, gas->v2, fluid.grid, 0) && is_along(gas->rho, none, fluid.grid, 0) &&
                      is_along(gas->p, none, fluid.grid, 0);
    if (!good) return {{fluid.path + ".initial", words}};
  }
  for (const auto& [key, field] : {std::pair{"u", &solid.initial_u}, std::pair{"v", &solid.initial_v}}) {
    if (*field && !is_along((*field)->c1, (*field)->c2, solid.grid, 0))
      return {{fmt::format("solids.{}.initial.{}", solid.name, key), words}};
  }
  GridSpec left = solid.grid;
  left.x_b = left.x_a;
  const auto& drive = solid.boundary[0].vector;
  for (int k = 0; drive && k < looked_at_times; ++k) {
    if (!is_along(drive->c1, drive->c2, left, looked_at_time(problem, k)))
      return {{fmt::format("solids.{}.boundary.left.value", solid.name), words}};
  }
  return {};
}

/// Its left end is moved.
Found not_driven(const Case& problem) {
  const SolidSpec& solid = problem.solids.front();
  const BoundarySpec& left = solid.boundary[0];
  const bool given = schema::solid_boundary(left.kind).holds == Hold::motion;
  if (given || left.from_reference) return {};
  return {
      {fmt::format("solids.{}.boundary.left", solid.name),
       "the one-dimensional run needs `displacement` or clamped here; write that, or leave out `reference`"}};
}

/// Beyond the reach of waves the chain's gas stays as it was at first: a state that is given there must be
/// that one at all times.
Found unquiet_end(const Case& problem) {
  constexpr double tolerance = 1e-9;
  const FluidSpec& fluid = problem.fluids.front();
  const BoundarySpec& right = fluid.boundary[1];
  if (!right.state || !fluid.initial) return {};
  const double x = fluid.grid.x_b;
  const auto apart = [&](const Expression& at_first, const Expression& given, double t) {
    const double value = at_first(x, 0, 0);
    const double middle = (fluid.grid.y_a + fluid.grid.y_b) / 2;
    return std::ranges::any_of(std::array{fluid.grid.y_a, middle, fluid.grid.y_b}, [&](double y) {
      return !(std::fabs(given(x, y, t) - value) <= tolerance * (1 + std::fabs(value)));
    });
  };
  for (int k = 0; k < looked_at_times; ++k) {
    const double t = looked_at_time(problem, k);
    const GasExpressions &first = *fluid.initial, &given = *right.state;
    if (!apart(first.rho, given.rho, t) && !apart(first.v1, given.v1, t) && !apart(first.v2, given.v2, t) &&
        !apart(first.p, given.p, t))
      continue;
    return {{fluid.path + ".boundary.right.state",
             fmt::format(
                 "the one-dimensional run has at the right a wall or a gas that stays as `{}.initial` has it "
                 "at x = {:g}, but at t = {:.4g} the state is another; give that state, or write slip_wall "
                 "or outflow",
                 fluid.path, x, t)}};
  }
  return {};
}

// --- the disk

/// Points off the axes of x and y, where a motion that is not a rotation shows.
constexpr std::array<std::pair<double, double>, 4> in_disk{
    {{0.3, 0.4}, {-0.2, 0.5}, {0.6, -0.3}, {-0.1, -0.2}}};
constexpr std::array<std::pair<double, double>, 3> in_gas{{{1.05, 0}, {0, 1.1}, {-0.8, -0.8}}};

/// The unit disk about the origin, whichever grids it has.
Found another_outline(const Case& problem) {
  constexpr double tolerance = 1e-6;  // below what a coupled run can show
  const SolidSpec& solid = problem.solids.front();
  const std::string path = fmt::format("solids.{}.shape", solid.name);
  if (solid.body_fitted.empty())
    return {{path, "the rotating disk needs the unit disk; write {kind: circle, radius: 1}"}};
  const CurveSpec& outline = solid.body_fitted.front().curve;
  const auto n = static_cast<std::size_t>(outline.points());
  for (std::size_t k = 0; k < n; ++k) {
    const double x = outline.x[k], y = outline.x[n + k];
    if (std::fabs(std::hypot(x, y) - 1) <= tolerance) continue;
    return {{path, fmt::format(
                       "the rotating disk needs the unit circle about the origin, but ({:.6g}, {:.6g}) is on "
                       "the outline; write {{kind: circle, radius: 1}}",
                       x, y)}};
  }
  return {};
}

/// Free of forces, and turned by nothing at t = 0.
Found loaded_or_displaced(const Case& problem) {
  const SolidSpec& solid = problem.solids.front();
  if (solid.body_force) {
    return {{fmt::format("solids.{}.body_force", solid.name),
             "the rotating disk has no body force; leave it out, or `reference`"}};
  }
  if (!solid.initial_u) return {};
  for (const auto& [x, y] : in_disk) {
    const double u1 = solid.initial_u->c1(x, y, 0), u2 = solid.initial_u->c2(x, y, 0);
    if (u1 == 0 && u2 == 0) continue;
    return {
        {fmt::format("solids.{}.initial.u", solid.name),
         fmt::format("the rotating disk starts without displacement, but it is ({:.3g}, {:.3g}) at ({}, {}); "
                     "leave it out",
                     u1, u2, x, y)}};
  }
  return {};
}

Found another_motion(const Case& problem) {
  const SolidSpec& solid = problem.solids.front();
  if (solid.initial_from_reference) return {};
  const auto& numbers = problem.reference.numbers;
  const auto given = numbers.find("omega_0");
  const double omega_0 = given == numbers.end() ? exact::default_omega_0 : given->second;
  for (const auto& [x, y] : in_disk) {
    const double V = exact::angular_velocity(omega_0, std::hypot(x, y));
    const auto& v = solid.initial_v;
    const double e1 = (v ? v->c1(x, y, 0) : 0) + V * y, e2 = (v ? v->c2(x, y, 0) : 0) - V * x;
    if (std::hypot(e1, e2) <= 1e-9 * (1 + std::fabs(omega_0))) continue;
    return {
        {fmt::format("solids.{}.initial.v", solid.name),
         fmt::format("is not the rotation of `reference`: at ({}, {}) it is off by ({:.3g}, {:.3g}); write "
                     "[\"-y * V\", \"x * V\"] with V = omega_0 * (4 * r * (1 - r))^4",
                     x, y, e1, e2)}};
  }
  return {};
}

Found gas_moves(const Case& problem) {
  const FluidSpec& fluid = problem.fluids.front();
  if (!fluid.initial) return {};
  const auto [x_0, y_0] = in_gas.front();
  const double rho_0 = fluid.initial->rho(x_0, y_0, 0), p_0 = fluid.initial->p(x_0, y_0, 0);
  for (const auto& [x, y] : in_gas) {
    const bool same = std::fabs(fluid.initial->rho(x, y, 0) / rho_0 - 1) < 1e-12 &&
                      std::fabs(fluid.initial->p(x, y, 0) / p_0 - 1) < 1e-12;
    const bool rests = fluid.initial->v1(x, y, 0) == 0 && fluid.initial->v2(x, y, 0) == 0;
    if (same && rests) continue;
    return {{fluid.path + ".initial", "the rotating disk needs a gas at rest with one rho and one p"}};
  }
  return {};
}

}  // namespace

std::optional<Misfit> misfit_of_piston(const Case& problem) {
  return first_of(problem, not_one_of_each, not_side_by_side, felt_across, pulled, varies_across, not_driven,
                  unquiet_end);
}

std::optional<Misfit> misfit_of_disk(const Case& problem) {
  return first_of(problem, not_one_of_each, another_outline, loaded_or_displaced, another_motion, gas_moves);
}

void expect_none(const std::optional<Misfit>& found, const std::string& file) {
  if (found) throw UserMistake(fmt::format("{}: {}: {}", file, found->path, found->text));
}

}  // namespace fsi
