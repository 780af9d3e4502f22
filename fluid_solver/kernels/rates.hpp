#pragma once
/// How fast waves cross the cells of a row, for the time step.

#include "fluid_solver/kernels/sweep.hpp"

namespace fsi::fluid {

/// Lambda_i of (44) at the points of row j: sum over directions of (|n.(v - g_dot)| + a) / spacing. The
/// grid's velocity is that of its last step, of length dt (0: the grid has not moved yet). paper eq. (44)
void wave_rate_row(ConstFieldView q, const StepGrid& grid, double dt, double gamma, int j, double* rate,
                   Range range);

/// -Lambda_r of (44) at the points of row j: 8 times the coefficient of the undivided second differences.
void diffusion_rate_row(ConstFieldView q, const StepGrid& grid, Viscosity viscosity, int j, double* rate,
                        Range range);

/// Largest value of a row.
double largest(const double* values, Range range);

}  // namespace fsi::fluid
