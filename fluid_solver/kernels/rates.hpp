#pragma once
/// How large a time step the points of a row allow.

#include "fluid_solver/kernels/sweep.hpp"

namespace fsi::fluid {

/// 1 / dt of (45) at the points of row j from Lambda_i, the sum over directions of (|n.(v - g_dot)| + a) /
/// spacing, and -Lambda_r, 8 times the coefficient of the undivided second differences. The grid's velocity
/// is that of its last step, of length dt (0: the grid has not moved yet). paper eq. (44)
void step_rate_row(ConstFieldView q, const StepGrid& grid, double dt, const Scheme& scheme, int j,
                   double* rate, Range range);

/// Largest value of a row.
double largest(const double* values, Range range);

}  // namespace fsi::fluid
