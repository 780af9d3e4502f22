#pragma once
/// What a user of the solid solver chooses: scheme parameters, boundary conditions, data as functions.

#include <array>
#include <functional>

#include "common/core/choices.hpp"
#include "common/core/types.hpp"
#include "solid_solver/laws/law.hpp"

namespace fsi::solid {

/// Unknowns of the first-order system, paper eq. (4), at one point.
struct SolidState {
  Vec2 u = Vec2::Zero();  ///< displacement
  Vec2 v = Vec2::Zero();  ///< velocity
  Tensor2 P;              ///< nominal stress
};

/// Vector or state as a function of the reference position and time.
using VectorFunction = std::function<Vec2(double x, double y, double t)>;
using StateFunction = std::function<SolidState(double x, double y, double t)>;
using TensorFunction = std::function<Tensor2(double x, double y, double t)>;

/// A solution by choice: sources in all equations and at the sides make u, v and P exact, which need not
/// belong to each other.
struct ChosenSolution {
  StateFunction state;
  StateFunction source;   ///< added to the rates of u, v and P
  TensorFunction offset;  ///< P - P(F(u))
};

/// Coefficient with a rate and a 1/dt part: beta = rate * dt + scaled.
struct Beta {
  double rate = 0;    ///< [1/time]
  double scaled = 0;  ///< [-]

  constexpr double at(double dt) const { return rate * dt + scaled; }
  constexpr bool active() const { return rate != 0 || scaled != 0; }
};

using Limiter = SolidLimiter;

/// Scheme of the solid. All dissipation is off unless asked for.
struct SolidOptions {
  double rho = 1;                   ///< density of the reference configuration [mass/volume]
  Limiter limiter = Limiter::none;  ///< of the slopes of v and P, and of the ghost extrapolation
  Beta tangential_stress = {};      ///< beta^P of paper eq. (39)
  Beta displacement = {};           ///< beta^u of paper eq. (40)
  Beta relaxation = {};             ///< beta^r of paper eq. (41)
  double bulk_diffusion = 0;        ///< factor of undivided second differences of v and P [1/time]
  double cfl = 0.9;                 ///< safety factor C_CFL of the time step [-]
};

/// What the scheme keeps on one side of the reference grid, as an answer to each of three questions. A kind of boundary
/// (boundary/kinds) is a combination of them; the scheme asks for the answers and knows no kind.
struct Condition {
  /// How do the points of the side move?
  enum class Motion {
    free,        ///< as the equations say
    along_wall,  ///< n0 . u = n0 . v = 0, without shear
    given        ///< u = `vector(x, y, t)`, v = `velocity(x, y, t)`; empty means clamped
  };
  /// Which traction do they bear?
  enum class Traction {
    unknown,    ///< that of the stress inside, and of the motion
    given,      ///< `vector(x, y, t)`, per unit area; empty means free
    projected,  ///< that of the gas on the other side: values come with apply_solid_bcs
  };
  /// What is beyond the side?
  enum class Ghosts {
    extrapolated,  ///< what continues the inside; where motion or traction are known, it makes P(F) agree with them
    mirrored,  ///< mirror images across a straight side; extrapolated where the grid has no mirror image
    repeated,  ///< the opposite side again
    state,     ///< u, v and P = `state(x, y, t)`, on the side as well
    nothing    ///< nothing is done: the side is interpolated, or lies in holes of a composite grid
  };
  Motion motion = Motion::free;
  Traction traction = Traction::unknown;
  Ghosts ghosts = Ghosts::extrapolated;

  constexpr bool loaded() const { return traction != Traction::unknown; }
  /// The traction is known at all times.
  constexpr bool knows_rate() const { return traction == Traction::given; }
  constexpr bool meets_gas() const { return traction == Traction::projected; }
  constexpr bool walled() const { return motion == Motion::along_wall; }
  /// A wall whose ghost points must be found.
  constexpr bool slips() const { return walled() && ghosts == Ghosts::extrapolated; }
  constexpr bool moved() const { return motion == Motion::given; }
  constexpr bool mirrored() const { return ghosts == Ghosts::mirrored; }
  constexpr bool repeated() const { return ghosts == Ghosts::repeated; }
  /// Ghost points are images of inner ones.
  constexpr bool imaged() const { return mirrored() || repeated(); }
  constexpr bool has_state() const { return ghosts == Ghosts::state; }
  constexpr bool open() const { return ghosts == Ghosts::nothing; }

  friend constexpr bool operator==(const Condition&, const Condition&) = default;
};

/// Of a side that nothing is done at.
inline constexpr Condition no_condition{.ghosts = Condition::Ghosts::nothing};

/// The condition on one side, and its values.
struct Boundary {
  Condition condition = {.traction = Condition::Traction::given};
  LoadConfiguration load = LoadConfiguration::current;
  VectorFunction vector = {};
  VectorFunction velocity = {};
  StateFunction state = {};
};

using Boundaries = std::array<Boundary, 4>;  ///< left, right, bottom, top

}  // namespace fsi::solid
