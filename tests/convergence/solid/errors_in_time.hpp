#pragma once
/// Errors of a solver at a time, or the largest over several.

#include <algorithm>
#include <cmath>
#include <span>

#include "solid_solver/solid_solver.hpp"

namespace fsi::solid {

/// From t to t_end in equal steps as far as the solver allows, the last one to the end; sets t.
template <class Solver>
void advance_to(Solver& solver, double& t, double t_end) {
  while (t < t_end - 1e-12) {
    const double left = t_end - t, dt = left / std::ceil(left / solver.compute_time_step().dt);
    solver.advance_solid(t, dt);
    t += dt;
    solver.apply_solid_bcs(t);
  }
}

/// From t = 0. A single time will not do: errors go up and down with the waves in them.
template <class Solver>
Errors largest_errors(Solver& solver, const StateFunction& exact, std::span<const double> times) {
  Errors largest;
  double t = 0;
  for (const double time : times) {
    advance_to(solver, t, time);
    const Errors now = solver.errors(exact, t);
    largest = {
        .u = std::max(largest.u, now.u), .v = std::max(largest.v, now.v), .P = std::max(largest.P, now.P)};
  }
  return largest;
}

}  // namespace fsi::solid
