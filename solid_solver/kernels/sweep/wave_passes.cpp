#include "solid_solver/kernels/sweep/wave_passes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solid_solver/kernels/sweep/blocks.hpp"
#include "solid_solver/kernels/sweep/upwinding.hpp"

namespace fsi::solid {

template <class Row>
void WavePasses<Row>::solve_faces1(RowRun run) const {
  const FaceRows left = work_.east(), right = work_.west(), solution = work_.faces1();
  const AcousticRows A = work_.acoustic1();
  const double half_rho = 0.5 * d_.rho;
  for (int b = block_with(run.begin); b <= run.end; b += block) {
#pragma omp simd
    for (int i = b; i < b + block; ++i) {
      const SymmetricTensor2 rho_A = {.a11 = half_rho * (A.a11[i - 1] + A.a11[i]),
                                      .a12 = half_rho * (A.a12[i - 1] + A.a12[i]),
                                      .a22 = half_rho * (A.a22[i - 1] + A.a22[i])};
      solution.set(i, riemann_solution(rho_A, left.at(i - 1), right.at(i)));
    }
  }
}

template <class Row>
void WavePasses<Row>::solve_faces2(RowRun run) const {
  const int j = run.j;
  const FaceRows left = work_.north(j - 1), right = work_.south(), solution = work_.faces2(j);
  const AcousticRows A = work_.acoustic2(j - 1), B = work_.acoustic2(j);
  const double half_rho = 0.5 * d_.rho;
  for (int b = block_with(run.begin); b < run.end; b += block) {
#pragma omp simd
    for (int i = b; i < b + block; ++i) {
      const SymmetricTensor2 rho_A = {.a11 = half_rho * (A.a11[i] + B.a11[i]),
                                      .a12 = half_rho * (A.a12[i] + B.a12[i]),
                                      .a22 = half_rho * (A.a22[i] + B.a22[i])};
      solution.set(i, riemann_solution(rho_A, left.at(i), right.at(i)));
    }
  }
}

/// What `find_stiffness` left in the rows of run.j; for SweepResult::rate_squared, min_phi_s and coupled.
template <class Row>
SweepResult WavePasses<Row>::waves(RowRun run) const {
  const Row row(metrics_, run.j);
  const AcousticRows along1 = work_.acoustic1(), along2 = work_.acoustic2(run.j);
  const StiffnessRows stiff = work_.stiffness(run.j);
  const double limit = d_.coupling_limit;
  double rate = 0, min_phi = std::numeric_limits<double>::infinity(), coupled = 0;
#pragma omp simd reduction(max : rate, coupled) reduction(min : min_phi)
  for (int i = run.begin; i < run.end; ++i) {
    const double scale = row.inverse_jacobian(i) * row.inverse_jacobian(i);
    const SymmetricTensor2 A1 = along1.at(i), A2 = along2.at(i);
    const Pair phi1 = wave_eigenvalues(A1), phi2 = wave_eigenvalues(A2);
    const double fastest = scale * (phi1.x + phi2.x + 2.0 * std::sqrt(phi1.x * phi2.x));
    const double slowest = scale * (phi1.y < phi2.y ? phi1.y : phi2.y);
    const double beyond = couples_beyond(limit, A1, A2, row.acoustic12(i, stiff.at(i))) ? 1.0 : 0.0;
    rate = rate < fastest ? fastest : rate;
    min_phi = slowest < min_phi ? slowest : min_phi;
    coupled = coupled < beyond ? beyond : coupled;
  }
  return {.rate_squared = rate / d_.rho, .coupled = coupled, .min_phi_s = min_phi};
}

/// What `find_stiffness` and `find_shares` left in the rows of run.j; for SweepResult::spread_squared.
template <class Row>
template <bool softened>
double WavePasses<Row>::spread_squared(RowRun run) const {
  const Row row(metrics_, run.j);
  const AcousticRows along1 = work_.acoustic1(), along2 = work_.acoustic2(run.j);
  const StiffnessRows stiff = work_.stiffness(run.j);
  const double* shares = work_.share(run.j);
  const double rho = d_.rho;
  double spread = 0;
#pragma omp simd reduction(max : spread)
  for (int i = run.begin; i < run.end; ++i) {
    const SymmetricTensor2 A1 = along1.at(i), A2 = along2.at(i);
    const Pair phi1 = wave_eigenvalues(A1), phi2 = wave_eigenvalues(A2);
    const double both = phi1.x + phi2.x, twice = 2.0 * std::sqrt(phi1.x * phi2.x);
    const double shared = shared_upwinding(A1, A2, row.acoustic12(i, stiff.at(i)));
    const double scale = row.inverse_jacobian(i) * row.inverse_jacobian(i);
    double apart = scale * (both - twice + 4.0 * shared);
    if constexpr (softened) {
      const double share = shares[i];
      const double part =
          share * std::sqrt(apart / rho) + (1.0 - share) * std::sqrt(scale * (both + twice) / rho);
      apart = rho * part * part;
    }
    spread = spread < apart ? apart : spread;
  }
  return spread / rho;
}

template <class Row>
void WavePasses<Row>::look_at_waves(RowRun run, SweepResult& result) const {
  result.add(waves(run));
  if (!d_.measures_spread) return;
  result.spread_squared =
      std::max(result.spread_squared, d_.softened ? spread_squared<true>(run) : spread_squared<false>(run));
}

template <class Row>
SweepResult WavePasses<Row>::look_at_soundness(RowRun run) const {
  const double* sound = work_.soundness(run.j);
  double min_J = std::numeric_limits<double>::infinity(), broken = 0;
#pragma omp simd reduction(min : min_J) reduction(+ : broken)
  for (int i = run.begin; i < run.end; ++i) {
    min_J = sound[i] < min_J ? sound[i] : min_J;
    broken += sound[i] > 0.0 ? 0.0 : 1.0;
  }
  return {.min_det_F = min_J, .broken = broken};
}

template class WavePasses<MappedRow>;
template class WavePasses<CartesianRow>;

}  // namespace fsi::solid
