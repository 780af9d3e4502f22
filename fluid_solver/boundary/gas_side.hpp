#pragma once
/// One side of a component grid as its kind of boundary sees it. A kind is a file in `kinds/`; of what follows it
/// declares what it needs, and what it leaves out is not done:
///
///     facts                              what it tells others: GasBoundaryFacts
///     from(BoundaryData)                 makes it of what a case says
///     set_point(GasSide, k)              what the boundary knows better at its point k. Of two such sides with the same
///                                        precedence neither goes first where they meet: the mean of both orders holds
///     set_points(GasSide)                all points at once, where more is to do than `set_point` at each that is needed
///     mirror(GasSide, reach)             ghosts that are images of inner points, `reach` points beyond the ends too
///     set_ghosts(GasSide)                other ghosts, beside the points of the side
///     set_after_corners(GasSide)         what holds in the corners of the ghost frame, too

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "common/case/schema/boundary_facts.hpp"
#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "fluid_solver/boundary/ghost_lines.hpp"
#include "fluid_solver/boundary/interface.hpp"
#include "fluid_solver/boundary/side_points.hpp"
#include "fluid_solver/boundary/wall_motion.hpp"
#include "fluid_solver/forcing.hpp"
#include "fluid_solver/gas_options.hpp"
#include "fluid_solver/state_vector.hpp"

namespace fsi::fluid {

/// What a case says of a boundary: values of its kind's keys.
struct BoundaryData {
  StateField state = {};                       ///< key `state`
  std::map<std::string, double> numbers = {};  ///< other keys, by name
  std::map<std::string, std::function<double(double x, double y, double t)>> fields = {};  ///< the same
};

struct GasSide {
  FieldView q;        ///< rho, v1, v2, p
  ConstFieldView x;   ///< positions
  SidePoints points;  ///< of the side
  double t;           ///< [time]
  const GasOptions& options;
  const WallMotion& motion;            ///< of the side's points, which go with the grid
  const Forcing* forcing;              ///< of a chosen solution; null: there is none
  const InterfaceValues* projected;    ///< of a side that meets a solid, else null
  bool closed;                         ///< the side is periodic along itself
  bool mirrored_first, mirrored_last;  ///< ghosts beyond its ends along the side are images
  std::array<bool, 2> held;            ///< at its first and last point an interface and a wall meet
  /// Normals, there, of the interfaces that cross it at its first and last point.
  std::array<std::optional<Vec2>, 2> crossing;
  const std::string& grid;  ///< its name
  std::uint64_t&
      bounded;  ///< points of the side at which a bound acted, each time it did (docs/output.md, "Fallbacks")

  bool limited() const { return options.limiter != Limiter::none; }
  /// Of the chosen solution.
  StateVector exact(const Vec2& place) const { return to_vector(forcing->exact()(place[0], place[1], t)); }
  StateVector exact(int k) const { return exact(position(x, points, k, 0)); }
  /// The side as a wall with these normals, velocities and accelerations.
  Wall wall(std::span<const double> n, std::span<const double> v, std::span<const double> a) const {
    return {.n = n,
            .v = v,
            .a = a,
            .closed = closed,
            .mirrored_first = mirrored_first,
            .mirrored_last = mirrored_last,
            .held_first = held[0],
            .held_last = held[1]};
  }
};

/// Ghosts that continue the gas.
inline void extrapolate_ghosts(const GasSide& side) {
  side.bounded += extrapolated_ghosts(side.q, side.points, side.limited());
}

/// Ghosts at a wall. Gas with a chosen solution may cross it: the momentum equation on it does not hold then.
inline void set_wall_ghosts(const GasSide& side, const Wall& wall) {
  if (side.forcing != nullptr) {
    extrapolate_ghosts(side);
  } else {
    side.bounded += wall_ghosts(side.q, side.x, side.points, wall, side.options);
  }
}

}  // namespace fsi::fluid
