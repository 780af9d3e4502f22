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

/// The configuration whose area and normal the load of a side belongs to.
enum class LoadConfiguration {
  current,    ///< the deformed body: eta of paper eq. (13), a pressure along the present normal
  reference,  ///< the undeformed body: eta = 1, a pressure along n0, as in small-strain theory. Differs from
              ///< the paper: with the linear law, ripples of an interface that follows its load grow without
              ///< bound, the shorter the faster, once the load is a few shear moduli (docs/theory_solid.md)
};

/// Condition on one side of the reference grid.
struct Boundary {
  enum class Kind {
    interface,     ///< the gas is on the other side: values come with apply_solid_bcs
    traction,      ///< `vector(x, y, t)` is the traction per unit area; empty means free
    displacement,  ///< u = `vector(x, y, t)`, v = `velocity(x, y, t)`; empty means clamped
    slip,          ///< n0 . u = 0 and no shear
    symmetry,      ///< mirror images across a straight side
    dirichlet,     ///< u, v and P = `state(x, y, t)` on the side and its ghost lines
    periodic,      ///< continues at the opposite side
    none           ///< nothing is done: the side is interpolated, or lies in holes of a composite grid
  };
  Kind kind = Kind::traction;
  LoadConfiguration load = LoadConfiguration::current;
  VectorFunction vector = {};
  VectorFunction velocity = {};
  StateFunction state = {};
};

using Boundaries = std::array<Boundary, 4>;  ///< left, right, bottom, top

}  // namespace fsi::solid
