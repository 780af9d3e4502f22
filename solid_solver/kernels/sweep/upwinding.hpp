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
/// nothing, to the bit, where the share is 1. No law is in them: upwinding.cpp compiles them once for all.
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

}  // namespace fsi::solid
