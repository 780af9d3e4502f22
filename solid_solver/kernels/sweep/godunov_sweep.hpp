#pragma once
/// One time step of paper eq. (32) at the discretised points of a grid, row by row.
///
/// Row j goes through five loops, each a pass over whole runs of points of structure-of-arrays rows that stay
/// in cache: `find_stiffness` (F, K; of laws whose K is quick, in the next), `predict` (slopes, states at t + dt/2), `solve_faces2` (faces between rows j - 1
/// and j), `update` (row j - 1, whose four faces are now known, with what dissipation and relaxation add to it), and
/// `solve_faces1` (faces inside row j). One Riemann problem per face. Wide grids are swept in strips of columns. Where
/// pressure makes upwinding of the stress amplify it, the passes of `StressUpwinding` go between these.

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "solid_solver/kernels/sweep/blocks.hpp"
#include "solid_solver/kernels/sweep/stiffness_at.hpp"
#include "solid_solver/kernels/sweep/sweep_data.hpp"
#include "solid_solver/kernels/sweep/sweep_work.hpp"
#include "solid_solver/kernels/sweep/upwinding.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

template <Law L, class Row, Limiter limiter>
class GodunovSweep {
 public:
  GodunovSweep(const SweepData& data, const ReferenceMetrics& metrics, const L& law)
      : GodunovSweep(data, metrics, law, Strip()) {}

  /// `terms_of` makes for row j what is added to the step of each of its points while it is made: a function of the index i
  /// and the new state. `after` is called for each run of points, RowRun, whose step was made; all of their row and the
  /// rows beside it keep the state at t.
  template <class TermsOf, class AfterRun>
  SweepResult run(const TermsOf& terms_of, const AfterRun& after) const;
  SweepResult run() const {
    return run([](int) { return NoTerms(); }, [](RowRun) {});
  }

 private:
  /// Columns that are swept at a time.
  struct Strip {
    int begin = 0, end = 0;
    bool first = true, last = true;

    /// Ghost points beside a strip, but for those beside the grid, are counted in another one.
    bool counts(int i) const { return (first || i >= begin) && (last || i < end); }
  };

  GodunovSweep(const SweepData& data, const ReferenceMetrics& metrics, const L& law, const Strip& strip)
      : d_(data), metrics_(metrics), law_(law), strip_(strip), work_(data.work, strip.begin) {}

  template <class TermsOf, class AfterRun>
  SweepResult run_strip(const TermsOf& terms_of, const AfterRun& after) const;
  template <class Act>
  void each_run(int j, std::span<const grid::Interval> runs, int reach, const Act& act) const;

  // Functions of their own: inlined into run() they would be too much for the compiler to inline what their
  // loops call, and no loop with a call in it vectorises.
  [[gnu::noinline]] void find_stiffness(RowRun run) const;
  [[gnu::noinline]] void predict(RowRun run) const;
  [[gnu::noinline]] SweepResult waves(RowRun run) const;
  template <bool softened>
  [[gnu::noinline]] double spread_squared(RowRun run) const;
  [[gnu::noinline]] double settle(RowRun run) const;
  [[gnu::noinline]] void solve_faces1(RowRun run) const;
  [[gnu::noinline]] void solve_faces2(RowRun run) const;
  template <class Terms>
  [[gnu::noinline]] void update(RowRun run, const Terms& terms_at) const;
  [[gnu::noinline]] void take_from_edge(RowRun run) const;
  [[gnu::noinline]] SweepResult look_at_soundness(RowRun run) const;
  void look_at_waves(RowRun run, SweepResult& result) const;

  const double* force(int c, int j) const { return d_.force.planes > 0 ? d_.force.row(c, j) : work_.zero(); }

  const SweepData& d_;
  const ReferenceMetrics& metrics_;
  const L& law_;
  Strip strip_;
  SweepWork work_;
  StressUpwinding<Row, limiter> softer_{d_, metrics_, work_};
};

template <Law L, class Row, Limiter limiter>
template <class TermsOf, class AfterRun>
SweepResult GodunovSweep<L, Row, limiter>::run(const TermsOf& terms_of, const AfterRun& after) const {
  const grid::Interval columns = d_.points->columns();
  const int begin = block_with(columns.begin), width = columns.end - begin;
  const int strips = (width + sweep_work.n1 - 1) / sweep_work.n1;
  SweepResult result;
  for (int k = 0, first = begin; k < strips; ++k) {
    const int end =
        k + 1 == strips ? columns.end : first + block_with((width + strips - 1) / strips + block - 1);
    const Strip strip = {.begin = first, .end = end, .first = k == 0, .last = k + 1 == strips};
    result.add(GodunovSweep(d_, metrics_, law_, strip).run_strip(terms_of, after));
    first = end;
  }
  return result;
}

template <Law L, class Row, Limiter limiter>
template <class TermsOf, class AfterRun>
SweepResult GodunovSweep<L, Row, limiter>::run_strip(const TermsOf& terms_of, const AfterRun& after) const {
  const int n2 = d_.q.layout.n2;
  const grid::RowRange rows = {d_.rows.first, std::min(d_.rows.end, n2)};
  const SolidPoints& points = *d_.points;
  SweepResult result;
  if (rows.first >= rows.end) return result;
  for (int j = rows.first - 1; j <= rows.end; ++j) {
    each_run(j, points.predicted(j), 1, [&](RowRun run) {
      if constexpr (!quick_stiffness<L>) find_stiffness(run);
      predict(run);
    });
    each_run(j, points.beside(j), 1, [&](RowRun run) {
      const double settled = settle(run);
      if (rows.contains(std::clamp(j, 0, n2 - 1))) result.settled += settled;
    });
    if (d_.softened) each_run(j, points.predicted(j), 1, [&](RowRun run) { softer_.find_shares(run); });
    if (d_.look == Look::all && rows.contains(j))
      each_run(j, points.discretised(j), 0, [&](RowRun run) { look_at_waves(run, result); });
    if (j >= rows.first) {
      each_run(j, points.faces(j), 0, [&](RowRun run) { solve_faces2(run); });
      if (d_.softened) each_run(j, points.faces(j), 0, [&](RowRun run) { softer_.correct_faces2(run); });
    }
    if (j > rows.first) {
      each_run(j - 1, points.discretised(j - 1), 0, [&](RowRun run) {
        result.add(look_at_soundness(run));
        update(run, terms_of(run.j));
        if (d_.softened) {
          softer_.find_decay(run);
          softer_.spare_tractions(run);
          softer_.add_decay(run);
        }
        after(run);
      });
    }
    if (rows.contains(j)) {
      each_run(j, points.discretised(j), 0, [&](RowRun run) { solve_faces1(run); });
      if (d_.softened)
        each_run(j, points.discretised(j), 0, [&](RowRun run) { softer_.correct_faces1(run); });
    }
  }
  return result;
}

/// Calls act for what the strip has of these runs of row j, `reach` columns beside it included.
template <Law L, class Row, Limiter limiter>
template <class Act>
void GodunovSweep<L, Row, limiter>::each_run(int j, std::span<const grid::Interval> runs, int reach,
                                             const Act& act) const {
  for (const grid::Interval& run : runs) {
    const RowRun part = {j, std::max(run.begin, strip_.begin - reach), std::min(run.end, strip_.end + reach)};
    if (part.begin < part.end) act(part);
  }
}

template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::look_at_waves(RowRun run, SweepResult& result) const {
  result.add(waves(run));
  if (!d_.measures_spread) return;
  result.spread_squared =
      std::max(result.spread_squared, d_.softened ? spread_squared<true>(run) : spread_squared<false>(run));
}

/// A loop of its own: K of some blocks is long in the coming, and other blocks have theirs meanwhile.
template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::find_stiffness(RowRun run) const {
  const Row row(metrics_, run.j);
  const StateRows q(d_.q, run.j);
  const PointRows to = work_.points(run.j);
  const L law = law_;
  const double half = 0.5 * d_.dt;
  for (int b = block_with(run.begin); b < run.end; b += block) {
#pragma omp simd
    for (int i = b; i < b + block; ++i) stiffness_at(law, row, q, i, half, to);
  }
}

/// Slopes of v and P; states of the four faces and of the centre at t + dt/2, the last giving its share of u, paper eq.
/// (37).
template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::predict(RowRun run) const {
  const int j = run.j;
  const Row row(metrics_, j);
  const StateRows q(d_.q, j);
  const FaceRows to_east = work_.east(), to_west = work_.west(), to_north = work_.north(j),
                 to_south = work_.south();
  const PointRows points = work_.points(j);
  const L law = law_;
  const double *b1 = force(0, j), *b2 = force(1, j);
  double *centre1 = work_.centre(0, j), *centre2 = work_.centre(1, j);
  const double dt = d_.dt, dt_rho = dt / d_.rho;
  for (int b = block_with(run.begin); b < run.end; b += block) {
#pragma omp simd
    for (int i = b; i < b + block; ++i) {
      const Pair s1 = q.v1.template half_slopes<limiter>(i), s2 = q.v2.template half_slopes<limiter>(i);
      const Pair s11 = q.P11.template half_slopes<limiter>(i), s12 = q.P12.template half_slopes<limiter>(i);
      const Pair s21 = q.P21.template half_slopes<limiter>(i), s22 = q.P22.template half_slopes<limiter>(i);
      const Pair L1 = row.gradient(i, s1.x, s1.y), L2 = row.gradient(i, s2.x, s2.y);
      const Stiffness K =
          quick_stiffness<L> ? stiffness_at(law, row, q, i, 0.5 * dt, points) : points.stiff.at(i);
      const Tensor2 dP = contract(K, {L1.x, L1.y, L2.x, L2.y});
      const double v1 = q.v1[i] + dt_rho * (row.gradient(i, s11.x, s11.y).x +
                                            row.gradient(i, s21.x, s21.y).y + 0.5 * b1[i]);
      const double v2 = q.v2[i] + dt_rho * (row.gradient(i, s12.x, s12.y).x +
                                            row.gradient(i, s22.x, s22.y).y + 0.5 * b2[i]);
      const Tensor2 P = {q.P11[i] + dt * dP.a11, q.P12[i] + dt * dP.a12, q.P21[i] + dt * dP.a21,
                         q.P22[i] + dt * dP.a22};
      centre1[i] = v1;
      centre2[i] = v2;
      to_east.set(i, v1 + s1.x, v2 + s2.x,
                  row.force_east(i, {P.a11 + s11.x, P.a12 + s12.x, P.a21 + s21.x, P.a22 + s22.x}));
      to_west.set(i, v1 - s1.x, v2 - s2.x,
                  row.force_west(i, {P.a11 - s11.x, P.a12 - s12.x, P.a21 - s21.x, P.a22 - s22.x}));
      to_north.set(i, v1 + s1.y, v2 + s2.y,
                   row.force_north(i, {P.a11 + s11.y, P.a12 + s12.y, P.a21 + s21.y, P.a22 + s22.y}));
      to_south.set(i, v1 - s1.y, v2 - s2.y,
                   row.force_south(i, {P.a11 - s11.y, P.a12 - s12.y, P.a21 - s21.y, P.a22 - s22.y}));
    }
  }
}

/// What `find_stiffness` left in the rows of run.j; for SweepResult::rate_squared, min_phi_s and coupled.
template <Law L, class Row, Limiter limiter>
SweepResult GodunovSweep<L, Row, limiter>::waves(RowRun run) const {
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
template <Law L, class Row, Limiter limiter>
template <bool softened>
double GodunovSweep<L, Row, limiter>::spread_squared(RowRun run) const {
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

/// Ghost points have a displacement that was extrapolated, and beside a corner with a singular stress it may
/// turn the material inside out or leave it no wave speed, though the body itself is far from that. What such
/// a point brings to its face is then its state at t, and K and the acoustic matrix of the point of the body beside
/// it. Returns the number of such points, each in one strip.
template <Law L, class Row, Limiter limiter>
double GodunovSweep<L, Row, limiter>::settle(RowRun run) const {
  const int j = run.j;
  double settled = 0;
  for (int i = run.begin; i < run.end; ++i) {
    const AcousticRows along1 = work_.acoustic1(), along2 = work_.acoustic2(j);
    if (bears_waves(along1.at(i)) && bears_waves(along2.at(i))) continue;
    for (const auto& [a, b] : {std::pair(i - 1, j), {i + 1, j}, {i, j - 1}, {i, j + 1}}) {
      if (b < 0 || b >= d_.q.layout.n2 || !d_.points->is_discretised(a, b)) continue;
      const Stiffness K = law_.K(deformation_gradient(Row(metrics_, b), StateRows(d_.q, b), a, 0.5 * d_.dt));
      const Row row(metrics_, j);
      work_.stiffness(j).set(i, K);
      along1.set(i, row.acoustic1(i, K));
      along2.set(i, row.acoustic2(i, K));
      const StateRows q(d_.q, j);
      const Tensor2 P = {q.P11[i], q.P12[i], q.P21[i], q.P22[i]};
      work_.east().set(i, q.v1[i], q.v2[i], row.force_east(i, P));
      work_.west().set(i, q.v1[i], q.v2[i], row.force_west(i, P));
      work_.north(j).set(i, q.v1[i], q.v2[i], row.force_north(i, P));
      work_.south().set(i, q.v1[i], q.v2[i], row.force_south(i, P));
      settled += strip_.counts(i) ? 1 : 0;
      break;
    }
  }
  return settled;
}

/// Faces i - 1/2 on both sides of the points of a run of the present row.
template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::solve_faces1(RowRun run) const {
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

/// Faces j - 1/2 between the last row and row j.
template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::solve_faces2(RowRun run) const {
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

/// det F of the points of a run, and which of them broke.
template <Law L, class Row, Limiter limiter>
SweepResult GodunovSweep<L, Row, limiter>::look_at_soundness(RowRun run) const {
  const double* sound = work_.soundness(run.j);
  double min_J = std::numeric_limits<double>::infinity(), broken = 0;
#pragma omp simd reduction(min : min_J) reduction(+ : broken)
  for (int i = run.begin; i < run.end; ++i) {
    min_J = sound[i] < min_J ? sound[i] : min_J;
    broken += sound[i] > 0.0 ? 0.0 : 1.0;
  }
  return {.min_det_F = min_J, .broken = broken};
}

/// The step of the points of a run, from where `update` put a block that reaches beyond it.
template <Law L, class Row, Limiter limiter>
void GodunovSweep<L, Row, limiter>::take_from_edge(RowRun run) const {
  const StateRow<double> from = work_.edge(), to = state_row(d_.next, run.j);
  for (int i = run.begin; i < run.end; ++i) to.set(i, from.at(i));
}

/// The step of the points of a run, whose four faces are known, and what `terms` add to it there.
template <Law L, class Row, Limiter limiter>
template <class Terms>
void GodunovSweep<L, Row, limiter>::update(RowRun run, const Terms& terms_at) const {
  const int j = run.j;
  const Terms terms = terms_at;
  const UpdateRows<Row> rows = {.row = Row(metrics_, j),
                                .q = state_row(d_.q, j),
                                .along1 = work_.faces1(),
                                .low = work_.faces2(j),
                                .high = work_.faces2(j + 1),
                                .stiff = work_.stiffness(j),
                                .centre1 = work_.centre(0, j),
                                .centre2 = work_.centre(1, j),
                                .b1 = force(0, j),
                                .b2 = force(1, j),
                                .dt = d_.dt,
                                .dt_rho = d_.dt / d_.rho,
                                .dt_mean = 0.5 * mean_velocity_share * d_.dt,
                                .dt_centre = (1.0 - mean_velocity_share) * d_.dt};
  const StateRow<double> next = state_row(d_.next, j), beside = work_.edge();
  for (int b = block_with(run.begin); b < run.end; b += block) {
    const int first = std::max(b, run.begin), end = std::min(b + block, run.end);
    const bool whole = end - first == block;
    const StateRow<double> to = whole ? next : beside;
#pragma omp simd
    for (int i = b; i < b + block; ++i) {
      const auto added = terms.at(i);
      to.set(i, added.to(rows.updated(i)));
    }
    if (!whole) take_from_edge({j, first, end});
  }
}

}  // namespace fsi::solid
