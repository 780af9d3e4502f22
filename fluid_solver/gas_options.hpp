#pragma once
/// What a user chooses about the gas: its law, its scheme, and what holds on each side of its grid.

#include <functional>
#include <variant>

#include "common/core/choices.hpp"

namespace fsi::fluid {

/// Primitive state of the gas at a point.
struct State {
  double rho = 0;  ///< density [mass/volume]
  double v1 = 0;   ///< velocity along x [velocity]
  double v2 = 0;   ///< velocity along y [velocity]
  double p = 0;    ///< pressure [pressure]
};

/// State as a function of position and time: initial data, inflow, exact solutions.
using StateField = std::function<State(double x, double y, double t)>;

using Riemann = RiemannSolver;
using Limiter = GasLimiter;

/// A background that is finest where the gas or a body needs it.
struct Refinement {
  int levels = 1;  ///< each three times as coarse as the next finer one; 1: the same spacing everywhere
  RefinedQuantity quantity = RefinedQuantity::rho;
  double threshold = 3e-3;  ///< refine where undivided second differences exceed this part of the range [-]
  int buffer = 2;           ///< points of the coarser level around what is to be refined
  int every = 6;            ///< steps between two adaptations
};

struct GasOptions {
  double gamma = 1.4;  ///< ratio of specific heats [-]
  double p_e = 0;      ///< pressure at which an interface carries no load [pressure]
  Riemann riemann = Riemann::roe;
  Limiter limiter = Limiter::minmod;  ///< none: centred slopes
  double entropy_fix = 0.1;           ///< width of the sonic-point fix, as part of the sound speed [-]
  double shock_viscosity = 0;         ///< coefficient of max(0, -div v) on undivided differences [-]
  double linear_diffusion = 0;        ///< of undivided second differences of the conserved variables [1/time]
  bool wave_curve = true;  ///< density at an interface along the wave curve; false: at constant entropy
  Refinement refine = {};
  double cfl = 0.9;  ///< safety factor C_CFL of the time step [-]
};

/// Meets a solid: normal velocity and pressure are the projected ones.
struct Interface {};
/// Impermeable wall that moves with the grid's side, or stands where the grid stands.
struct SlipWall {};
/// Straight mirror line.
struct Symmetry {};
/// All four values given on the boundary; what lies behind is extrapolated.
struct Inflow {
  StateField state;
};
/// Nothing given: what leaves is extrapolated, what would enter is taken as undisturbed.
struct Outflow {};
/// A given state beyond the boundary: what comes in along characteristics is its, what goes out leaves.
struct FarField {
  StateField state;
};
/// All four values given on the boundary and behind it.
struct Dirichlet {
  StateField state;
};
/// The last point of a line is the first point of the next period.
struct Periodic {};
/// Nothing is done: no advanced point lies there (its points interpolate or are not used).
struct Idle {};

using Boundary =
    std::variant<Interface, SlipWall, Symmetry, Inflow, Outflow, FarField, Dirichlet, Periodic, Idle>;

}  // namespace fsi::fluid
