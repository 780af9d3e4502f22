#pragma once
/// One-dimensional piston as a chain of masses and springs:
/// solid and gas in Lagrangian coordinates, one system.
///
///   u(t) |--o--o--o--o--o==o==o==o==o==o==|  wall, or gas at rest far away
///            solid springs   gas springs
///
/// Independent of the coupled programs in everything: no interface condition is needed (the mass at the
/// interface feels a solid spring on one side and a gas spring on the other), no Riemann problem, no
/// upwinding, no moving grid.

#include <functional>
#include <vector>

#include "common/exact/riemann.hpp"
#include "reference/chain.hpp"

namespace fsi::reference {

/// What a piston is. Smooth flow: the gas keeps its entropy.
struct PistonProblem {
  Material material = {.law = "linear_elastic"};
  double x_a = -1, x_b = 0;     ///< reference domain of the solid [length]
  double x_end = 1.5;           ///< where the gas ends at t = 0 [length]
  double gamma = 1.4, p_e = 0;  ///< [-], [pressure]
  bool wall = true;  ///< a rigid wall at x_end; otherwise the gas goes on beyond the reach of any wave
  std::function<double(double t)> drive;            ///< displacement of the solid's left end
  std::function<double(double x_bar)> u_0, v_0;     ///< initial displacement and velocity of the solid
  std::function<exact::TubeState(double x)> gas_0;  ///< initial state of the gas, isentropic from there on
  std::vector<double> times;                        ///< of the outputs, increasing
};

/// The solution at one output time, at the masses of the chain.
struct PistonOutput {
  double t = 0;                                   ///< [time]
  std::vector<double> x_bar, u, v_bar, P11, P22;  ///< solid, by reference position
  std::vector<double> x, rho, v, p;               ///< gas, by position
};

/// Integrates the chain with `points` masses per unit length; second order in 1/points.
/// @throws UserMistake for an unknown law @throws Diverged when a spring folds
std::vector<PistonOutput> solve_piston(const PistonProblem& problem, int points);

using PistonRun = Run<PistonOutput>;

/// The same, but a spring that folds ends the solution only.
PistonRun solve_piston_while_sound(const PistonProblem& problem, int points);

/// Largest differences between two solutions, the finer one read at the points of the coarser one, at the output times
/// that both have.
Difference compare(const std::vector<PistonOutput>& fine, const std::vector<PistonOutput>& coarse);

}  // namespace fsi::reference
