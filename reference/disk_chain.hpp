#pragma once
/// Elastic disk in a gas, the same at every angle, as a chain of rings: solid rings joined by springs and gas
/// rings that are compressed shells, one system of masses in Lagrangian coordinates.
///
///   centre o--o--o--o--o==o==o==o==o==|  wall, or gas at rest far away
///          solid springs   gas shells
///
/// The place of a solid ring is where its point of reference angle 0 is: q = (q1, q2), along and across the
/// reference ray, q1 = (r_bar + u_r) cos u_theta and q2 = (r_bar + u_r) sin u_theta in the paper's letters.
/// In these fixed axes the ring's mass is a constant (no centrifugal nor Coriolis terms) and the deformation
/// gradient is the same function of q for every law, objective or not.

#include <functional>
#include <vector>

#include "reference/chain.hpp"

namespace fsi::reference {

/// What the rotating disk is. The disk has radius 1. Smooth flow: the gas keeps its entropy.
struct DiskProblem {
  Material material = {.law = "saint_venant_kirchhoff"};
  double gamma = 1.4, rho_0 = 1.4, p_0 = 1;  ///< of the gas at rest, t = 0 [-], [mass/volume], [pressure]
  double p_e = 1;                            ///< pressure that leaves the solid without stress [pressure]
  bool load_on_reference = false;            ///< the gas presses on the rim at rest: its area and its normal
  double b = 0;                              ///< radius of a rigid wall; 0: gas without end [length]
  std::function<double(double r_bar)> v_r, v_theta;  ///< initial velocity of the solid
  std::vector<double> times;                         ///< of the outputs, increasing
};

/// Conserved in sum, of the whole disk and gas per unit thickness. The energy of the gas counts from its rest
/// and holds the work of p_e. Loads on the reference configuration keep neither.
struct DiskTotals {
  double kinetic_solid = 0, kinetic_gas = 0, strain = 0, gas = 0;  ///< [energy/depth]
  double angular_momentum = 0;  ///< constant for an objective law [momentum*length/depth]
  double energy() const { return kinetic_solid + kinetic_gas + strain + gas; }
};

/// The solution at one output time, at the masses of the chain.
struct DiskOutput {
  double t = 0;                            ///< [time]
  std::vector<double> r_bar;               ///< reference radius of the solid rings
  std::vector<double> u1, u2, v1, v2;      ///< displacement and velocity, along and across the reference ray
  std::vector<double> P11, P12, P21, P22;  ///< nominal stress in the same axes, Rbar P Rbar^T
  std::vector<double> r, rho, v, p;        ///< gas, by radius
  DiskTotals totals;
};

/// Integrates the chain with `points` masses per unit length; second order in 1/points.
/// @throws UserMistake for an unknown law @throws Diverged when a spring folds
std::vector<DiskOutput> solve_disk(const DiskProblem& problem, int points);

using DiskRun = Run<DiskOutput>;

/// The same, but a spring that folds ends the solution only.
DiskRun solve_disk_while_sound(const DiskProblem& problem, int points);

/// Largest differences between two solutions, the finer one read at the points of the coarser one.
Difference compare(const DiskOutput& fine, const DiskOutput& coarse);

}  // namespace fsi::reference
