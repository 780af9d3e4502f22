#pragma once
/// What a user chooses about the gas: its law and its scheme. What holds on the sides of its grids: boundary/kinds.

#include <functional>

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

}  // namespace fsi::fluid
