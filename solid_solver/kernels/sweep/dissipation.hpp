#pragma once
/// Terms that are added to the sweep's result where they are asked for: dissipation of tangential stress and
/// displacement, relaxation of the stress towards the law, bulk diffusion. Each is one pass over a run of
/// points from the old state to the new one; a term whose coefficient is zero is not run at all. They are not
/// inlined, so that the compiler has room to inline what their loops call and to vectorise them.

#include "solid_solver/kernels/sweep/update_rows.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

/// paper eq. (38) with m = 4: (-D+ D-)^2 / 2^4 of five values; the highest mode +-1 gives 1.
[[gnu::always_inline]] inline double fourth_difference(double a, double b, double c, double d, double e) {
  return ((a + e) - 4.0 * (b + d) + 6.0 * c) * 0.0625;
}

/// One plane of a field around row j, for five-point stencils.
struct WideRow {
  const double *here, *below, *above, *below2, *above2;

  WideRow(ConstFieldView q, int k, int j)
      : here(q.row(k, j)),
        below(q.row(k, j - 1)),
        above(q.row(k, j + 1)),
        below2(q.row(k, j - 2)),
        above2(q.row(k, j + 2)) {}
  /// D^(4) along r1 and r2.
  [[gnu::always_inline]] Pair fourth(int i) const {
    return {fourth_difference(here[i - 2], here[i - 1], here[i], here[i + 1], here[i + 2]),
            fourth_difference(below2[i], below[i], here[i], above[i], above2[i])};
  }
  /// Their sum.
  [[gnu::always_inline]] double fourth_of_both(int i) const {
    const Pair d = fourth(i);
    return d.x + d.y;
  }
  /// Sum over the directions of the undivided second differences.
  [[gnu::always_inline]] double second(int i) const {
    return (here[i - 1] + here[i + 1]) + (below[i] + above[i]) - 4.0 * here[i];
  }
  /// Fourth-order central first differences over one index along r1 and r2.
  [[gnu::always_inline]] Pair first(int i) const {
    constexpr double inner = 2.0 / 3.0, outer = 1.0 / 12.0;
    return {inner * (here[i + 1] - here[i - 1]) - outer * (here[i + 2] - here[i - 2]),
            inner * (above[i] - below[i]) - outer * (above2[i] - below2[i])};
  }
};

/// Gradients from fourth-order differences on a mapped grid: the grid's own derivatives are differenced
/// alike, so that a linear displacement still has the exact gradient.
class MappedGradient4 {
 public:
  static constexpr bool bends = true;
  MappedGradient4(ConstFieldView x, const ReferenceMetrics& /*metrics*/, int j) : x_(x, 0, j), y_(x, 1, j) {}
  [[gnu::always_inline]] Tensor2 operator()(int i, Pair d1, Pair d2) const {
    const Pair x = x_.first(i), y = y_.first(i);
    const double scale = 1.0 / (x.x * y.y - x.y * y.x);
    return {.a11 = scale * (d1.x * y.y - d1.y * y.x),
            .a12 = scale * (d1.y * x.x - d1.x * x.y),
            .a21 = scale * (d2.x * y.y - d2.y * y.x),
            .a22 = scale * (d2.y * x.x - d2.x * x.y)};
  }
  /// Sums over the directions of D^(4) x and D^(4) y.
  [[gnu::always_inline]] Pair bend(int i) const { return {x_.fourth_of_both(i), y_.fourth_of_both(i)}; }

 private:
  WideRow x_, y_;
};

/// The same on a Cartesian grid.
class CartesianGradient4 {
 public:
  static constexpr bool bends = false;
  CartesianGradient4(ConstFieldView /*x*/, const ReferenceMetrics& metrics, int /*j*/)
      : i1_(1.0 / metrics.h1()), i2_(1.0 / metrics.h2()) {}
  [[gnu::always_inline]] Tensor2 operator()(int /*i*/, Pair d1, Pair d2) const {
    return {.a11 = d1.x * i1_, .a12 = d1.y * i2_, .a21 = d2.x * i1_, .a22 = d2.y * i2_};
  }
  [[gnu::always_inline]] Pair bend(int /*i*/) const { return {0.0, 0.0}; }

 private:
  double i1_, i2_;
};

/// Rows of the stress around row j, for five-point stencils.
struct WideStress {
  WideRow P11, P12, P21, P22;

  WideStress(ConstFieldView q, int j)
      : P11(q, plane::P11, j), P12(q, plane::P12, j), P21(q, plane::P21, j), P22(q, plane::P22, j) {}
  [[gnu::always_inline]] Tensor2 here(int i) const {
    return {P11.here[i], P12.here[i], P21.here[i], P22.here[i]};
  }
};

/// Paper eq. (39) at a point: the part of D^(4) P that no wave carries along r1 or r2, times beta^P / 2.
template <class Row>
[[gnu::always_inline]] inline Tensor2 tangential_part(const Row& row, const WideStress& P, int i,
                                                      double factor) {
  const Pair t1 = row.tangent1(i), t2 = row.tangent2(i);
  const Pair d11 = P.P11.fourth(i), d12 = P.P12.fourth(i), d21 = P.P21.fourth(i), d22 = P.P22.fourth(i);
  const double along1_1 = factor * (t1.x * d11.x + t1.y * d21.x),
               along1_2 = factor * (t1.x * d12.x + t1.y * d22.x);
  const double along2_1 = factor * (t2.x * d11.y + t2.y * d21.y),
               along2_2 = factor * (t2.x * d12.y + t2.y * d22.y);
  return {.a11 = t1.x * along1_1 + t2.x * along2_1,
          .a12 = t1.x * along1_2 + t2.x * along2_2,
          .a21 = t1.y * along1_1 + t2.y * along2_1,
          .a22 = t1.y * along1_2 + t2.y * along2_2};
}

/// The same on a Cartesian grid, whose lines have the axes as tangents. With the zero a product is rounded by
/// itself, as sums of products are, wherever it goes.
[[gnu::always_inline]] inline Tensor2 tangential_part(const CartesianRow& /*row*/, const WideStress& P, int i,
                                                      double factor) {
  return {.a11 = factor * P.P11.fourth(i).y + 0.0,
          .a12 = factor * P.P12.fourth(i).y + 0.0,
          .a21 = factor * P.P21.fourth(i).x + 0.0,
          .a22 = factor * P.P22.fourth(i).x + 0.0};
}

/// Paper eq. (41) at a point: what P has beyond P(F), F from fourth-order differences, times beta^r.
template <Law L>
[[gnu::always_inline]] inline Tensor2 surplus(const L& law, const Tensor2& du, const Tensor2& P_now,
                                              double beta) {
  const Tensor2 P = law.P({1.0 + du.a11, du.a12, du.a21, 1.0 + du.a22});
  return {.a11 = beta * (P_now.a11 - P.a11),
          .a12 = beta * (P_now.a12 - P.a12),
          .a21 = beta * (P_now.a21 - P.a21),
          .a22 = beta * (P_now.a22 - P.a22)};
}

/// What differences of u over indices have beyond those of the linear displacement with the gradient du: positions have some of
/// their own where grid lines bend, and so has u = (R - 1) x of a body that only turns. On Cartesian grids that is all of them.
/// @param of_u of both components, @param of_x of the positions
template <class Gradient>
[[gnu::always_inline]] inline Pair beyond_linear(Pair of_u, const Tensor2& du, Pair of_x) {
  if constexpr (!Gradient::bends) return of_u;
  return {of_u.x - (du.a11 * of_x.x + du.a12 * of_x.y), of_u.y - (du.a21 * of_x.x + du.a22 * of_x.y)};
}

/// Paper eq. (40) at a point: D^(4) of u beyond that of a linear displacement, times beta^u / 2.
template <class Gradient>
[[gnu::always_inline]] inline Pair displacement_part(const Gradient& gradient, const Tensor2& du,
                                                     const WideRow& u1, const WideRow& u2, int i,
                                                     double factor) {
  const Pair d = beyond_linear<Gradient>({u1.fourth_of_both(i), u2.fourth_of_both(i)}, du, gradient.bend(i));
  return {factor * d.x, factor * d.y};
}

/// A run of points of paper eq. (39). beta = beta^P.
template <class Row>
[[gnu::noinline]] void add_tangential_stress_dissipation(ConstFieldView q, FieldView next,
                                                         const ReferenceMetrics& metrics, double beta,
                                                         RowRun run) {
  const Row row(metrics, run.j);
  const WideStress P(q, run.j);
  const StressRow to(next, run.j);
  const double factor = 0.5 * beta;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const Tensor2 part = tangential_part(row, P, i, factor);
    to.subtract(i, part.a11, part.a12, part.a21, part.a22);
  }
}

/// A run of points of paper eq. (40). beta = beta^u.
template <class Gradient>
[[gnu::noinline]] void add_displacement_dissipation(ConstFieldView q, FieldView next,
                                                    const Gradient& gradient, double beta, RowRun run) {
  const WideRow u1(q, plane::u1, run.j), u2(q, plane::u2, run.j);
  double *to1 = next.row(plane::u1, run.j), *to2 = next.row(plane::u2, run.j);
  const double factor = 0.5 * beta;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const Pair part = displacement_part(gradient, gradient(i, u1.first(i), u2.first(i)), u1, u2, i, factor);
    to1[i] -= part.x;
    to2[i] -= part.y;
  }
}

/// A run of points of paper eq. (41). beta = beta^r.
template <class Gradient, Law L>
[[gnu::noinline]] void add_relaxation(ConstFieldView q, FieldView next, const Gradient& gradient,
                                      const L& law_at, double beta, RowRun run) {
  const L law = law_at;
  const WideRow u1(q, plane::u1, run.j), u2(q, plane::u2, run.j);
  const WideStress P(q, run.j);
  const StressRow to(next, run.j);
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const Tensor2 part = surplus(law, gradient(i, u1.first(i), u2.first(i)), P.here(i), beta);
    to.subtract(i, part.a11, part.a12, part.a21, part.a22);
  }
}

/// Coefficients of paper eq. (39) to paper eq. (41) [-].
struct DissipationBetas {
  double P = 0, u = 0, r = 0;
};

/// All three in one row of points, added to their step while the sweep makes it: stress and displacement are read once.
template <class Row, class Gradient, Law L>
class AllDissipation {
 public:
  AllDissipation(ConstFieldView q, const Row& row, const Gradient& gradient, const L& law,
                 DissipationBetas betas, int j)
      : row_(row),
        gradient_(gradient),
        law_(law),
        u1_(q, plane::u1, j),
        u2_(q, plane::u2, j),
        P_(q, j),
        factor_P_(0.5 * betas.P),
        factor_u_(0.5 * betas.u),
        beta_r_(betas.r) {}

  /// At a point.
  struct Parts {
    double u1, u2;
    Tensor2 tangential, surplus;

    [[gnu::always_inline]] PointState to(PointState s) const {
      return {.u1 = s.u1 - u1,
              .u2 = s.u2 - u2,
              .v1 = s.v1,
              .v2 = s.v2,
              .P11 = (s.P11 - tangential.a11) - surplus.a11,
              .P12 = (s.P12 - tangential.a12) - surplus.a12,
              .P21 = (s.P21 - tangential.a21) - surplus.a21,
              .P22 = (s.P22 - tangential.a22) - surplus.a22};
    }
  };
  /// The law comes first: it takes longest.
  [[gnu::always_inline]] Parts at(int i) const {
    const Tensor2 du = gradient_(i, u1_.first(i), u2_.first(i));
    const Tensor2 two = surplus(law_, du, P_.here(i), beta_r_);
    const Tensor2 one = tangential_part(row_, P_, i, factor_P_);
    const Pair u = displacement_part(gradient_, du, u1_, u2_, i, factor_u_);
    return {.u1 = u.x, .u2 = u.y, .tangential = one, .surplus = two};
  }

 private:
  Row row_;
  Gradient gradient_;
  L law_;
  WideRow u1_, u2_;
  WideStress P_;
  double factor_P_, factor_u_, beta_r_;
};

/// A run of points of the bulk diffusion of v and P: factor
/// times the sum of the undivided second differences.
[[gnu::noinline]] inline void add_bulk_diffusion(ConstFieldView q, FieldView next, double factor,
                                                 RowRun run) {
  for (int k = plane::v1; k <= plane::P22; ++k) {
    const WideRow values(q, k, run.j);
    double* target = next.row(k, run.j);
#pragma omp simd
    for (int i = run.begin; i < run.end; ++i) target[i] += factor * values.second(i);
  }
}

}  // namespace fsi::solid
