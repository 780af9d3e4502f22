#pragma once
/// One time step of paper eq. (32) at the discretised points of a grid, row by row.
///
/// Row j goes through five loops, each a pass over whole runs of points of structure-of-arrays rows that stay
/// in cache: `find_stiffness` (F, K; of laws whose K is quick, in the next), `predict` (slopes, states at t + dt/2), `solve_faces2` (faces between rows j - 1
/// and j), `update` (row j - 1, whose four faces are now known, with what dissipation and relaxation add to it), and
/// `solve_faces1` (faces inside row j). One Riemann problem per face. Wide grids are swept in strips of columns. Where
/// pressure makes upwinding of the stress amplify it, the passes of `StressUpwinding` go between these.
///
/// Of the passes `predict` alone has the law and the limiter; those with the law are in point_passes.hpp, those with the limiter
/// in upwinding.hpp, those with neither in wave_passes.hpp: each is compiled as often as it has to be.

#include <algorithm>
#include <span>

#include "solid_solver/kernels/sweep/blocks.hpp"
#include "solid_solver/kernels/sweep/point_passes.hpp"
#include "solid_solver/kernels/sweep/stiffness_at.hpp"
#include "solid_solver/kernels/sweep/sweep_data.hpp"
#include "solid_solver/kernels/sweep/sweep_work.hpp"
#include "solid_solver/kernels/sweep/upwinding.hpp"
#include "solid_solver/kernels/sweep/wave_passes.hpp"
#include "solid_solver/solid_points.hpp"

namespace fsi::solid {

template <Law L, class Row, Limiter limiter>
class GodunovSweep {
 public:
  GodunovSweep(const SweepData& data, const ReferenceMetrics& metrics, const L& law)
      : GodunovSweep(data, metrics, law, SweepStrip()) {}

  /// `terms_of` makes for row j what is added to the step of each of its points while it is made: a function of the index i
  /// and the new state. `after` is called for each run of points, RowRun, whose step was made; all of their row and the
  /// rows beside it keep the state at t.
  template <class TermsOf, class AfterRun>
  SweepResult run(const TermsOf& terms_of, const AfterRun& after) const;
  SweepResult run() const {
    return run([](int) { return NoTerms(); }, [](RowRun) {});
  }

 private:
  GodunovSweep(const SweepData& data, const ReferenceMetrics& metrics, const L& law, const SweepStrip& strip)
      : d_(data), metrics_(metrics), law_(law), strip_(strip), work_(data.work, strip.begin) {}

  template <class TermsOf, class AfterRun>
  SweepResult run_strip(const TermsOf& terms_of, const AfterRun& after) const;
  template <class Act>
  void each_run(int j, std::span<const grid::Interval> runs, int reach, const Act& act) const;

  // Like all passes a function of its own: inlined into run() they would be too much for the compiler to inline what
  // their loops call, and no loop with a call in it vectorises.
  [[gnu::noinline]] void predict(RowRun run) const;

  const SweepData& d_;
  const ReferenceMetrics& metrics_;
  const L& law_;
  SweepStrip strip_;
  SweepWork work_;
  PointPasses<L, Row> point_{d_, metrics_, law_, work_};
  WavePasses<Row> wave_{d_, metrics_, work_};
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
    const SweepStrip strip = {.begin = first, .end = end, .first = k == 0, .last = k + 1 == strips};
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
      if constexpr (!quick_stiffness<L>) point_.find_stiffness(run);
      predict(run);
    });
    each_run(j, points.beside(j), 1, [&](RowRun run) {
      const double settled = point_.settle(run, strip_);
      if (rows.contains(std::clamp(j, 0, n2 - 1))) result.settled += settled;
    });
    if (d_.softened) each_run(j, points.predicted(j), 1, [&](RowRun run) { softer_.find_shares(run); });
    if (d_.look == Look::all && rows.contains(j))
      each_run(j, points.discretised(j), 0, [&](RowRun run) { wave_.look_at_waves(run, result); });
    if (j >= rows.first) {
      each_run(j, points.faces(j), 0, [&](RowRun run) { wave_.solve_faces2(run); });
      if (d_.softened) each_run(j, points.faces(j), 0, [&](RowRun run) { softer_.correct_faces2(run); });
    }
    if (j > rows.first) {
      each_run(j - 1, points.discretised(j - 1), 0, [&](RowRun run) {
        result.add(wave_.look_at_soundness(run));
        point_.update(run, terms_of(run.j));
        if (d_.softened) {
          softer_.find_decay(run);
          softer_.spare_tractions(run);
          softer_.add_decay(run);
        }
        after(run);
      });
    }
    if (rows.contains(j)) {
      each_run(j, points.discretised(j), 0, [&](RowRun run) { wave_.solve_faces1(run); });
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
  const double *b1 = force_row(d_, work_, 0, j), *b2 = force_row(d_, work_, 1, j);
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

}  // namespace fsi::solid
