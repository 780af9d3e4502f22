#pragma once
/// The passes of a sweep in which there is a law, but no limiter: the stiffness of the points before their faces are
/// solved, and their step after it.

#include <algorithm>
#include <utility>

#include "solid_solver/kernels/sweep/blocks.hpp"
#include "solid_solver/kernels/sweep/stiffness_at.hpp"
#include "solid_solver/kernels/sweep/sweep_data.hpp"
#include "solid_solver/kernels/sweep/sweep_work.hpp"
#include "solid_solver/kernels/sweep/update_rows.hpp"

namespace fsi::solid {

/// The body force of row j, or zeros.
inline const double* force_row(const SweepData& data, const SweepWork& work, int c, int j) {
  return data.force.planes > 0 ? data.force.row(c, j) : work.zero();
}

template <Law L, class Row>
class PointPasses {
 public:
  PointPasses(const SweepData& data, const ReferenceMetrics& metrics, const L& law, const SweepWork& work)
      : d_(data), metrics_(metrics), law_(law), work_(work) {}

  /// K and acoustic matrices of the points of a run at t + dt/2.
  [[gnu::noinline]] void find_stiffness(RowRun run) const;
  /// Gives ghost points that bear no waves those of the body beside them; returns how many in the strip it were.
  [[gnu::noinline]] double settle(RowRun run, const SweepStrip& strip) const;
  /// The step of the points of a run, whose four faces are known, and what `terms` add to it there.
  template <class Terms>
  [[gnu::noinline]] void update(RowRun run, const Terms& terms) const;

 private:
  [[gnu::noinline]] void take_from_edge(RowRun run) const;

  const SweepData& d_;
  const ReferenceMetrics& metrics_;
  const L& law_;
  const SweepWork& work_;
};

/// A loop of its own: K of some blocks is long in the coming, and other blocks have theirs meanwhile.
template <Law L, class Row>
void PointPasses<L, Row>::find_stiffness(RowRun run) const {
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

/// Ghost points have a displacement that was extrapolated, and beside a corner with a singular stress it may
/// turn the material inside out or leave it no wave speed, though the body itself is far from that. What such
/// a point brings to its face is then its state at t, and K and the acoustic matrix of the point of the body beside
/// it. Returns the number of such points, each in one strip.
template <Law L, class Row>
double PointPasses<L, Row>::settle(RowRun run, const SweepStrip& strip) const {
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
      settled += strip.counts(i) ? 1 : 0;
      break;
    }
  }
  return settled;
}

/// The step of the points of a run, from where `update` put a block that reaches beyond it.
template <Law L, class Row>
void PointPasses<L, Row>::take_from_edge(RowRun run) const {
  const StateRow<double> from = work_.edge(), to = state_row(d_.next, run.j);
  for (int i = run.begin; i < run.end; ++i) to.set(i, from.at(i));
}

template <Law L, class Row>
template <class Terms>
void PointPasses<L, Row>::update(RowRun run, const Terms& terms_at) const {
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
                                .b1 = force_row(d_, work_, 0, j),
                                .b2 = force_row(d_, work_, 1, j),
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
