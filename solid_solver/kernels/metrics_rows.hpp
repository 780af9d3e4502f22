#pragma once
/// The metrics of one row of points as the kernels see them: a Cartesian grid keeps two numbers, a mapped
/// grid ten rows. Both offer the same functions of the index i, so each kernel is written once.

#include "solid_solver/kernels/impedance.hpp"
#include "solid_solver/kernels/reference_metrics.hpp"
#include "solid_solver/kernels/state.hpp"

namespace fsi::solid {

/// Pair of numbers: a vector, or one component per direction.
struct Pair {
  double x = 0, y = 0;
};

/// Uniform spacings along x and y.
class CartesianRow {
 public:
  CartesianRow(const ReferenceMetrics& metrics, int /*j*/)
      : h1_(metrics.h1()), h2_(metrics.h2()), i1_(1.0 / h1_), i2_(1.0 / h2_) {}

  /// Gradient from differences over one index along r1 and r2.
  [[gnu::always_inline]] Pair gradient(int /*i*/, double d1, double d2) const { return {d1 * i1_, d2 * i2_}; }
  /// Force of the nominal stress on the face on the lower or upper side of point i.
  [[gnu::always_inline]] Pair force_west(int /*i*/, const Tensor2& P) const {
    return {h2_ * P.a11, h2_ * P.a12};
  }
  [[gnu::always_inline]] Pair force_east(int /*i*/, const Tensor2& P) const {
    return {h2_ * P.a11, h2_ * P.a12};
  }
  [[gnu::always_inline]] Pair force_south(int /*i*/, const Tensor2& P) const {
    return {h1_ * P.a21, h1_ * P.a22};
  }
  [[gnu::always_inline]] Pair force_north(int /*i*/, const Tensor2& P) const {
    return {h1_ * P.a21, h1_ * P.a22};
  }
  /// Acoustic matrices of the area vectors J grad r1, J grad r2 at the point.
  [[gnu::always_inline]] SymmetricTensor2 acoustic1(int /*i*/, const Stiffness& K) const {
    return {.a11 = h2_ * h2_ * K.k1111, .a12 = h2_ * h2_ * K.k1121, .a22 = h2_ * h2_ * K.k1221};
  }
  [[gnu::always_inline]] SymmetricTensor2 acoustic2(int /*i*/, const Stiffness& K) const {
    return {.a11 = h1_ * h1_ * K.k2112, .a12 = h1_ * h1_ * K.k2122, .a22 = h1_ * h1_ * K.k2222};
  }
  /// What waves along r1 and along r2 share: a1_i K_ijkl a2_l of the two area vectors.
  [[gnu::always_inline]] Tensor2 acoustic12(int /*i*/, const Stiffness& K) const {
    const double area = h1_ * h2_;
    return {area * K.k1112, area * K.k1122, area * K.k2121, area * K.k1222};
  }
  [[gnu::always_inline]] double inverse_area(int /*i*/) const { return i1_ * i2_; }
  [[gnu::always_inline]] double inverse_jacobian(int /*i*/) const { return i1_ * i2_; }

 private:
  double h1_, h2_, i1_, i2_;
};

/// Rows of the stored metrics.
class MappedRow {
 public:
  MappedRow(const ReferenceMetrics& metrics, int j)
      : a1x_(metrics.values().row(ReferenceMetrics::a1x, j)),
        a1y_(metrics.values().row(ReferenceMetrics::a1y, j)),
        a2x_(metrics.values().row(ReferenceMetrics::a2x, j)),
        a2y_(metrics.values().row(ReferenceMetrics::a2y, j)),
        inverse_area_(metrics.values().row(ReferenceMetrics::inverse_area, j)),
        r1x_(metrics.values().row(ReferenceMetrics::r1x, j)),
        r1y_(metrics.values().row(ReferenceMetrics::r1y, j)),
        r2x_(metrics.values().row(ReferenceMetrics::r2x, j)),
        r2y_(metrics.values().row(ReferenceMetrics::r2y, j)),
        jacobian_(metrics.values().row(ReferenceMetrics::jacobian, j)),
        stride_(metrics.values().layout.stride) {}

  [[gnu::always_inline]] Pair gradient(int i, double d1, double d2) const {
    return {d1 * r1x_[i] + d2 * r2x_[i], d1 * r1y_[i] + d2 * r2y_[i]};
  }
  [[gnu::always_inline]] Pair force_west(int i, const Tensor2& P) const { return force(a1x_[i], a1y_[i], P); }
  [[gnu::always_inline]] Pair force_east(int i, const Tensor2& P) const {
    return force(a1x_[i + 1], a1y_[i + 1], P);
  }
  [[gnu::always_inline]] Pair force_south(int i, const Tensor2& P) const {
    return force(a2x_[i], a2y_[i], P);
  }
  [[gnu::always_inline]] Pair force_north(int i, const Tensor2& P) const {
    return force(a2x_[i + stride_], a2y_[i + stride_], P);
  }
  [[gnu::always_inline]] SymmetricTensor2 acoustic1(int i, const Stiffness& K) const {
    return acoustic(jacobian_[i] * r1x_[i], jacobian_[i] * r1y_[i], K);
  }
  [[gnu::always_inline]] SymmetricTensor2 acoustic2(int i, const Stiffness& K) const {
    return acoustic(jacobian_[i] * r2x_[i], jacobian_[i] * r2y_[i], K);
  }
  [[gnu::always_inline]] Tensor2 acoustic12(int i, const Stiffness& K) const {
    const double square = jacobian_[i] * jacobian_[i];
    const double xx = square * r1x_[i] * r2x_[i], xy = square * r1x_[i] * r2y_[i],
                 yx = square * r1y_[i] * r2x_[i], yy = square * r1y_[i] * r2y_[i];
    return {.a11 = (xx * K.k1111 + yy * K.k2112) + (xy + yx) * K.k1112,
            .a12 = (xx * K.k1121 + yy * K.k2122) + (xy * K.k1122 + yx * K.k2121),
            .a21 = (xx * K.k1121 + yy * K.k2122) + (xy * K.k2121 + yx * K.k1122),
            .a22 = (xx * K.k1221 + yy * K.k2222) + (xy + yx) * K.k1222};
  }
  [[gnu::always_inline]] double inverse_area(int i) const { return inverse_area_[i]; }
  [[gnu::always_inline]] double inverse_jacobian(int i) const { return 1.0 / jacobian_[i]; }
  /// Unit tangents of the coordinate lines r1 = const and r2 = const.
  [[gnu::always_inline]] Pair tangent1(int i) const { return unit(-r1y_[i], r1x_[i]); }
  [[gnu::always_inline]] Pair tangent2(int i) const { return unit(-r2y_[i], r2x_[i]); }

 private:
  [[gnu::always_inline]] static Pair force(double ax, double ay, const Tensor2& P) {
    return {ax * P.a11 + ay * P.a21, ax * P.a12 + ay * P.a22};
  }
  [[gnu::always_inline]] static SymmetricTensor2 acoustic(double ax, double ay, const Stiffness& K) {
    const double a11 = ax * ax, a12 = ax * ay, a22 = ay * ay;
    return {.a11 = a11 * K.k1111 + 2.0 * a12 * K.k1112 + a22 * K.k2112,
            .a12 = a11 * K.k1121 + a12 * (K.k1122 + K.k2121) + a22 * K.k2122,
            .a22 = a11 * K.k1221 + 2.0 * a12 * K.k1222 + a22 * K.k2222};
  }
  [[gnu::always_inline]] static Pair unit(double x, double y) {
    const double scale = 1.0 / std::sqrt(x * x + y * y);
    return {x * scale, y * scale};
  }

  const double *a1x_, *a1y_, *a2x_, *a2y_, *inverse_area_, *r1x_, *r1y_, *r2x_, *r2y_, *jacobian_;
  std::ptrdiff_t stride_;
};

}  // namespace fsi::solid
