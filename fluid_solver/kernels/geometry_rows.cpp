#include "fluid_solver/kernels/geometry_rows.hpp"

#include <cmath>

namespace fsi::fluid {

void metric_row(const PointRows& x_old, const PointRows& x, double dt, const MetricRow& metric, Range range) {
  const auto [a_below, a, a_above] = x_old;
  const auto [b_below, b, b_above] = x;
  const MetricRow m = metric;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const double x_r1 = 0.25 * ((a.x[i + 1] - a.x[i - 1]) + (b.x[i + 1] - b.x[i - 1]));
    const double y_r1 = 0.25 * ((a.y[i + 1] - a.y[i - 1]) + (b.y[i + 1] - b.y[i - 1]));
    const double x_r2 = 0.25 * ((a_above.x[i] - a_below.x[i]) + (b_above.x[i] - b_below.x[i]));
    const double y_r2 = 0.25 * ((a_above.y[i] - a_below.y[i]) + (b_above.y[i] - b_below.y[i]));
    const double J_g = x_r1 * y_r2 - x_r2 * y_r1;
    const double inverse = 1.0 / J_g, scale = dt * inverse;
    const double dx = b.x[i] - a.x[i], dy = b.y[i] - a.y[i];
    m.r1_x[i] = scale * y_r2;
    m.r1_y[i] = -scale * x_r2;
    m.r2_x[i] = -scale * y_r1;
    m.r2_y[i] = scale * x_r1;
    m.drift1[i] = inverse * (y_r2 * dx - x_r2 * dy);
    m.drift2[i] = inverse * (x_r1 * dy - y_r1 * dx);
    m.volume[i] = J_g;
  }
}

void corner_row(PointRow lower, PointRow upper, double* x, double* y, Range range) {
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    x[i] = 0.25 * ((lower.x[i] + lower.x[i + 1]) + (upper.x[i] + upper.x[i + 1]));
    y[i] = 0.25 * ((lower.y[i] + lower.y[i + 1]) + (upper.y[i] + upper.y[i + 1]));
  }
}

namespace {

/// Normal, area and speed of the face from corner a to corner
/// b, seen with the larger r on the right of a -> b.
struct Face {
  double n1, n2, area, speed;
};

/// The two corners of a face at one time.
struct Edge {
  double ax, ay, bx, by;
};

[[gnu::always_inline]] inline Face face_between(const Edge& old, const Edge& now, double dt) {
  const double S1 = 0.5 * ((old.by - old.ay) + (now.by - now.ay));
  const double S2 = 0.5 * ((old.ax - old.bx) + (now.ax - now.bx));
  const double swept = 0.5 * ((now.ax - old.bx) * (now.by - old.ay) - (now.ay - old.by) * (now.bx - old.ax));
  const double area = std::sqrt(S1 * S1 + S2 * S2);
  const double inverse = 1.0 / area;
  return {.n1 = S1 * inverse, .n2 = S2 * inverse, .area = dt * area, .speed = swept * inverse / dt};
}

}  // namespace

void face_row_1(const CornerRow& below, const CornerRow& above, double dt, const FaceRow& face, Range range) {
  const CornerRow a = below, b = above;
  const FaceRow f = face;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const Face here =
        face_between({a.x_old[i], a.y_old[i], b.x_old[i], b.y_old[i]}, {a.x[i], a.y[i], b.x[i], b.y[i]}, dt);
    f.n1[i] = here.n1;
    f.n2[i] = here.n2;
    f.area[i] = here.area;
    f.speed[i] = here.speed;
  }
}

void face_row_2(const CornerRow& corners, double dt, const FaceRow& face, Range range) {
  const CornerRow c = corners;
  const FaceRow f = face;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    const Face here = face_between({c.x_old[i], c.y_old[i], c.x_old[i - 1], c.y_old[i - 1]},
                                   {c.x[i], c.y[i], c.x[i - 1], c.y[i - 1]}, dt);
    f.n1[i] = here.n1;
    f.n2[i] = here.n2;
    f.area[i] = here.area;
    f.speed[i] = here.speed;
  }
}

void volume_row(const CornerRow& below, const CornerRow& above, double* V_old, double* V, Range range) {
  const CornerRow a = below, b = above;
#pragma omp simd
  for (int i = range.first; i < range.last; ++i) {
    V_old[i] = 0.5 * ((b.x_old[i] - a.x_old[i - 1]) * (b.y_old[i - 1] - a.y_old[i]) -
                      (b.y_old[i] - a.y_old[i - 1]) * (b.x_old[i - 1] - a.x_old[i]));
    V[i] =
        0.5 * ((b.x[i] - a.x[i - 1]) * (b.y[i - 1] - a.y[i]) - (b.y[i] - a.y[i - 1]) * (b.x[i - 1] - a.x[i]));
  }
}

}  // namespace fsi::fluid
