#pragma once
/// Metrics of one row of a mapped, moving grid.
///
///     c ------- c        c  corners: averages of four vertices
///     |         |        o  vertex: the gas lives here
///     |    o    |        The control volume is the polygon of the corners; faces go straight from corner to
///     |         |        corner and sweep exactly what linearly moving corners sweep.
///     c ------- c
///
/// Differs from the paper: (31) is kept in its conservative form, V^{n+1} q^{n+1} = V^n q^n - fluxes, with
/// volumes and swept volumes from the polygons, instead of centred differences for the fourth term of (31).
/// Both say the same; here the areas of a volume's faces add to zero and the volumes they sweep add to
/// V^{n+1} - V^n by geometry, so that uniform flow stays uniform to round-off however the grid deforms.

#include "fluid_solver/kernels/rows.hpp"

namespace fsi::fluid {

/// Transformation at the vertices of a row, at half time:
/// dt times the metrics J_g dr_k/dx_j of (30) over J_g.
struct MetricRow {
  double *r1_x, *r1_y, *r2_x, *r2_y;  ///< dt dr_k/dx_j
  double *drift1, *drift2;            ///< dt g_dot . grad r_k
  double* volume;                     ///< J_g
};

/// Faces of a row: unit normal towards larger r, area times dt, normal speed of the face.
struct FaceRow {
  double *n1, *n2, *area, *speed;
};

/// Rows j - 1, j, j + 1 of the vertices at one time.
struct PointRows {
  PointRow below, here, above;
  PointRows(ConstFieldView x, int j) : below(x, j - 1), here(x, j), above(x, j + 1) {}
};

/// Corners of a row at the old and the new time; corner i lies between points i and i + 1.
struct CornerRow {
  double *x_old, *y_old, *x, *y;
};

/// Metrics of the transformation (30). paper eq. (30)
void metric_row(const PointRows& x_old, const PointRows& x, double dt, const MetricRow& metric, Range range);

/// Corners between two rows of vertices.
void corner_row(PointRow lower, PointRow upper, double* x, double* y, Range range);

/// Faces between the points of a row, from the corners below and above it.
void face_row_1(const CornerRow& below, const CornerRow& above, double dt, const FaceRow& face, Range range);

/// Faces between two rows of points, from the corners between them.
void face_row_2(const CornerRow& corners, double dt, const FaceRow& face, Range range);

/// Control volumes of a row at both times.
void volume_row(const CornerRow& below, const CornerRow& above, double* V_old, double* V, Range range);

}  // namespace fsi::fluid
