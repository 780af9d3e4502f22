#pragma once
/// What upwinding does to the stress, and where it must not: paper eq. (36) takes K grad v* with the velocities v* of the
/// faces, and their upwind part makes the stress decay at the rates of M = sum over directions of K Z^-1 n^T |grad r|. Where
/// K is positive on all velocity gradients, no rate is negative. Under pressure K is not: a rotation of the strained body then
/// has a negative eigenvalue. Waves stay real, but what no wave carries grows. There a share of M gives way to a decay of all
/// components of P alike (docs/theory_solid.md, *Solids under pressure*).

#include <algorithm>
#include <cmath>

#include "solid_solver/kernels/sweep/sweep_data.hpp"
#include "solid_solver/kernels/sweep/sweep_work.hpp"

namespace fsi::solid {

/// tr(S N T N^T) of symmetric S and T.
[[gnu::always_inline]] inline double trace_of_product(const SymmetricTensor2& S, const Tensor2& N,
                                                      const SymmetricTensor2& T) {
  return (S.a11 * N.a11 + S.a12 * N.a21) * (N.a11 * T.a11 + N.a12 * T.a12) +
         (S.a11 * N.a12 + S.a12 * N.a22) * (N.a11 * T.a12 + N.a12 * T.a22) +
         (S.a12 * N.a11 + S.a22 * N.a21) * (N.a21 * T.a11 + N.a22 * T.a12) +
         (S.a12 * N.a12 + S.a22 * N.a22) * (N.a21 * T.a12 + N.a22 * T.a22);
}

/// The non-zero eigenvalues of M are those of the block matrix ((Z1, X), (X^T, Z2)) with X = Z1^-1/2 N Z2^-1/2;
/// this is |X|^2 = tr(Z1^-1 N Z2^-1 N^T), with Z = (A + d I) / sqrt(tr A + 2 d), d = sqrt(det A).
/// @param N a1 K a2 of the two area vectors
[[gnu::always_inline]] inline double shared_upwinding(const SymmetricTensor2& A1, const SymmetricTensor2& A2,
                                                      const Tensor2& N) {
  const double d1 = std::sqrt(A1.a11 * A1.a22 - A1.a12 * A1.a12),
               d2 = std::sqrt(A2.a11 * A2.a22 - A2.a12 * A2.a12);
  const double roots = d1 * d2 * std::sqrt((A1.a11 + A1.a22 + 2.0 * d1) * (A2.a11 + A2.a22 + 2.0 * d2));
  // det(A) / d times (A + d I)^-1
  const SymmetricTensor2 B1 = {.a11 = A1.a22 + d1, .a12 = -A1.a12, .a22 = A1.a11 + d1};
  const SymmetricTensor2 B2 = {.a11 = A2.a22 + d2, .a12 = -A2.a12, .a22 = A2.a11 + d2};
  return trace_of_product(B1, N, B2) / roots;
}

/// Whether wave_coupling is beyond some limit, without a division or a root.
[[gnu::always_inline]] inline bool couples_beyond(double limit, const SymmetricTensor2& A1,
                                                  const SymmetricTensor2& A2, const Tensor2& N) {
  const SymmetricTensor2 B1 = {.a11 = A1.a22, .a12 = -A1.a12, .a22 = A1.a11};
  const SymmetricTensor2 B2 = {.a11 = A2.a22, .a12 = -A2.a12, .a22 = A2.a11};
  const double dets = (A1.a11 * A1.a22 - A1.a12 * A1.a12) * (A2.a11 * A2.a22 - A2.a12 * A2.a12);
  const double det = N.a11 * N.a22 - N.a12 * N.a21, sum = trace_of_product(B1, N, B2);
  const double allowed = limit * dets;
  return (sum > 2.0 * allowed) | (limit * (allowed - sum) + det * det < 0.0);
}

/// How far the waves along r1 and r2 are coupled: the square of the largest singular value of A1^-1/2 N A2^-1/2. K, the block
/// matrix ((A1, N), (N^T, A2)), is positive where it is less than 1; at rest it is 1, since a rotation makes no stress.
[[gnu::always_inline]] inline double wave_coupling(const SymmetricTensor2& A1, const SymmetricTensor2& A2,
                                                   const Tensor2& N) {
  const double per_det = 1.0 / ((A1.a11 * A1.a22 - A1.a12 * A1.a12) * (A2.a11 * A2.a22 - A2.a12 * A2.a12));
  const SymmetricTensor2 B1 = {.a11 = A1.a22, .a12 = -A1.a12, .a22 = A1.a11};
  const SymmetricTensor2 B2 = {.a11 = A2.a22, .a12 = -A2.a12, .a22 = A2.a11};
  const double det = N.a11 * N.a22 - N.a12 * N.a21;
  const double sum = per_det * trace_of_product(B1, N, B2), product = per_det * det * det;
  return 0.5 * (sum + std::sqrt(std::max(0.0, sum * sum - 4.0 * product)));
}

/// The coupling beyond which stress would grow in spite of relaxation: per step upwinding makes it grow by at most
/// 2 (coupling - 1) c_p dt |grad r|, summed over the directions, and by paper eq. (45) c_p dt |grad r| is then at most 1. Without
/// relaxation noise may grow by less than a factor of ten in ten thousand steps.
constexpr double coupling_limit(double beta_r) {
  constexpr double without_relaxation = 1e-4;
  return 1.0 + std::max(0.5 * beta_r, without_relaxation);
}

/// The part of upwinding that stays as in paper eq. (36). False comparisons, of what is no number, leave it whole.
[[gnu::always_inline]] inline double upwind_share(double coupling, double limit) {
  const double ratio = limit / coupling;
  return coupling > limit ? ratio * ratio : 1.0;
}

/// The passes over a row that put the other part right, after those of the sweep that they are named for. They change
/// nothing, to the bit, where the share is 1.
template <class Row, Limiter limiter>
class StressUpwinding {
 public:
  StressUpwinding(const SweepData& data, const ReferenceMetrics& metrics, const SweepWork& work)
      : d_(data), metrics_(metrics), work_(work) {}

  /// Shares of the points of a run of the present row, c_p of the rest times the area along both directions, and P at t + dt/2.
  [[gnu::noinline]] void find_shares(RowRun run) const;
  /// Faces i - 1/2 on both sides of the points of a run of the present row.
  [[gnu::noinline]] void correct_faces1(RowRun run) const;
  /// Faces j - 1/2 between the last row and row j.
  [[gnu::noinline]] void correct_faces2(RowRun run) const;
  /// The decay of all components alike of the points of a run, in the place of that of the faces below them.
  [[gnu::noinline]] void find_decay(RowRun run) const;
  /// Takes out what it does to the tractions of loaded sides.
  void spare_tractions(RowRun run) const;
  /// Adds it to the step.
  [[gnu::noinline]] void add_decay(RowRun run) const;

 private:
  /// Of the solution at a face, v* - (1 - share) (v* - mean of both sides).
  [[gnu::always_inline]] static void take_back(double share, double left, double right, double& face) {
    face -= (1.0 - share) * (face - 0.5 * (left + right));
  }
  /// What the limited slopes of four values leave of the jump that the middle ones have at t + dt/2.
  [[gnu::always_inline]] static double jump(double middle, double a, double b, double c, double d) {
    return middle - (half_slope<limiter>(a, b, c) + half_slope<limiter>(b, c, d));
  }

  /// The same at the face i - 1/2 of a row.
  [[gnu::always_inline]] static double along(int i, const double* q, const double* middle) {
    return jump(middle[i] - middle[i - 1], q[i - 2], q[i - 1], q[i], q[i + 1]);
  }

  const SweepData& d_;
  const ReferenceMetrics& metrics_;
  const SweepWork& work_;
};

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::find_shares(RowRun run) const {
  const Row row(metrics_, run.j);
  const AcousticRows along1 = work_.acoustic1(), along2 = work_.acoustic2(run.j);
  const StiffnessRows stiff = work_.stiffness(run.j);
  double *share = work_.share(run.j), *rest1 = work_.rest1(), *rest2 = work_.rest2(run.j);
  const double limit = d_.coupling_limit, per_rho = 1.0 / d_.rho;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const SymmetricTensor2 A1 = along1.at(i), A2 = along2.at(i);
    const double s = upwind_share(wave_coupling(A1, A2, row.acoustic12(i, stiff.at(i))), limit);
    share[i] = s;
    rest1[i] = (1.0 - s) * std::sqrt(per_rho * wave_eigenvalues(A1).x);
    rest2[i] = (1.0 - s) * std::sqrt(per_rho * wave_eigenvalues(A2).x);
  }
  const StencilRow v1(d_.q, plane::v1, run.j), v2(d_.q, plane::v2, run.j);
  const ConstStressRow P(d_.q, run.j);
  const StressRow centre = work_.centre_stress(run.j);
  const double dt = d_.dt;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const Pair s1 = v1.template half_slopes<limiter>(i), s2 = v2.template half_slopes<limiter>(i);
    const Pair L1 = row.gradient(i, s1.x, s1.y), L2 = row.gradient(i, s2.x, s2.y);
    const Tensor2 dP = contract(stiff.at(i), {L1.x, L1.y, L2.x, L2.y});
    centre.P11[i] = P.P11[i] + dt * dP.a11;
    centre.P12[i] = P.P12[i] + dt * dP.a12;
    centre.P21[i] = P.P21[i] + dt * dP.a21;
    centre.P22[i] = P.P22[i] + dt * dP.a22;
  }
}

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::correct_faces1(RowRun run) const {
  const int j = run.j;
  const FaceRows left = work_.east(), right = work_.west(), face = work_.faces1();
  const ConstStressRow P(d_.q, j), centre = work_.centre_stress(j);
  const StressRow decay = work_.decay1();
  const double *share = work_.share(j), *rest = work_.rest1();
#pragma omp simd
  for (int i = run.begin; i <= run.end; ++i) {
    const double s = 0.5 * (share[i - 1] + share[i]), c = 0.5 * (rest[i - 1] + rest[i]);
    take_back(s, left.v1[i - 1], right.v1[i], face.v1[i]);
    take_back(s, left.v2[i - 1], right.v2[i], face.v2[i]);
    decay.P11[i] = c * along(i, P.P11, centre.P11);
    decay.P12[i] = c * along(i, P.P12, centre.P12);
    decay.P21[i] = c * along(i, P.P21, centre.P21);
    decay.P22[i] = c * along(i, P.P22, centre.P22);
  }
}

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::correct_faces2(RowRun run) const {
  const int j = run.j;
  const FaceRows left = work_.north(j - 1), right = work_.south(), face = work_.faces2(j);
  const ConstStressRow A(d_.q, j - 2), B(d_.q, j - 1), C(d_.q, j), D(d_.q, j + 1);
  const ConstStressRow centre = work_.centre_stress(j), below = work_.centre_stress(j - 1);
  const StressRow decay = work_.decay2(j);
  const double *share = work_.share(j), *share_below = work_.share(j - 1);
  const double *rest = work_.rest2(j), *rest_below = work_.rest2(j - 1);
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const double s = 0.5 * (share_below[i] + share[i]), c = 0.5 * (rest_below[i] + rest[i]);
    take_back(s, left.v1[i], right.v1[i], face.v1[i]);
    take_back(s, left.v2[i], right.v2[i], face.v2[i]);
    decay.P11[i] = c * jump(centre.P11[i] - below.P11[i], A.P11[i], B.P11[i], C.P11[i], D.P11[i]);
    decay.P12[i] = c * jump(centre.P12[i] - below.P12[i], A.P12[i], B.P12[i], C.P12[i], D.P12[i]);
    decay.P21[i] = c * jump(centre.P21[i] - below.P21[i], A.P21[i], B.P21[i], C.P21[i], D.P21[i]);
    decay.P22[i] = c * jump(centre.P22[i] - below.P22[i], A.P22[i], B.P22[i], C.P22[i], D.P22[i]);
  }
}

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::find_decay(RowRun run) const {
  const int j = run.j;
  const Row row(metrics_, j);
  const StressRow along1 = work_.decay1(), low = work_.decay2(j), high = work_.decay2(j + 1);
  const double half_dt = 0.5 * d_.dt;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    const double factor = half_dt * row.inverse_jacobian(i);
    low.P11[i] = factor * ((along1.P11[i + 1] - along1.P11[i]) + (high.P11[i] - low.P11[i]));
    low.P12[i] = factor * ((along1.P12[i + 1] - along1.P12[i]) + (high.P12[i] - low.P12[i]));
    low.P21[i] = factor * ((along1.P21[i + 1] - along1.P21[i]) + (high.P21[i] - low.P21[i]));
    low.P22[i] = factor * ((along1.P22[i + 1] - along1.P22[i]) + (high.P22[i] - low.P22[i]));
  }
}

/// A load is there whatever waves do: if its traction decayed along the side, the characteristics would push the side back in
/// every step, and under pressure the push grows what it comes from.
template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::spare_tractions(RowRun run) const {
  const int j = run.j, last1 = d_.q.layout.n1 - 1, last2 = d_.q.layout.n2 - 1;
  const StressRow decay = work_.decay2(j);
  const auto loaded = [&](Side side) { return d_.loaded[static_cast<std::size_t>(side)]; };
  const bool row_loaded = (j == 0 && loaded(Side::bottom)) || (j == last2 && loaded(Side::top));
  const auto spare = [&](int i, const Vec2& across) {
    const Vec2 n0 = across.normalized();
    const Vec2 of_side = {n0.x() * decay.P11[i] + n0.y() * decay.P21[i],
                          n0.x() * decay.P12[i] + n0.y() * decay.P22[i]};
    decay.subtract(i, n0.x() * of_side.x(), n0.x() * of_side.y(), n0.y() * of_side.x(), n0.y() * of_side.y());
  };
  const auto spare_end = [&](int i) {
    if (row_loaded) {  // two tractions are all of P
      decay.subtract(i, decay.P11[i], decay.P12[i], decay.P21[i], decay.P22[i]);
    } else {
      spare(i, metrics_.at(i, j).r1);
    }
  };
  if (run.begin == 0 && loaded(Side::left)) spare_end(0);
  if (run.end == last1 + 1 && loaded(Side::right)) spare_end(last1);
  for (int i = run.begin; row_loaded && i < run.end; ++i) spare(i, metrics_.at(i, j).r2);
}

template <class Row, Limiter limiter>
void StressUpwinding<Row, limiter>::add_decay(RowRun run) const {
  const StressRow decay = work_.decay2(run.j), P(d_.next, run.j);
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    P.P11[i] += decay.P11[i];
    P.P12[i] += decay.P12[i];
    P.P21[i] += decay.P21[i];
    P.P22[i] += decay.P22[i];
  }
}

}  // namespace fsi::solid
