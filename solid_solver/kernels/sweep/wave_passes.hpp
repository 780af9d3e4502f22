#pragma once
/// The passes of a sweep in which there is neither a law nor a limiter: the Riemann problems of the faces, and what the wave
/// speeds of the points say. wave_passes.cpp compiles them once for all.

#include "solid_solver/kernels/sweep/sweep_data.hpp"
#include "solid_solver/kernels/sweep/sweep_work.hpp"

namespace fsi::solid {

template <class Row>
class WavePasses {
 public:
  WavePasses(const SweepData& data, const ReferenceMetrics& metrics, const SweepWork& work)
      : d_(data), metrics_(metrics), work_(work) {}

  /// Faces i - 1/2 on both sides of the points of a run of the present row, paper eq. (34).
  [[gnu::noinline]] void solve_faces1(RowRun run) const;
  /// Faces j - 1/2 between the last row and row j.
  [[gnu::noinline]] void solve_faces2(RowRun run) const;
  /// Adds what the stiffness of the points of a run says of SweepResult::rate_squared, min_phi_s and coupled, and where
  /// it is measured of spread_squared.
  void look_at_waves(RowRun run, SweepResult& result) const;
  /// det F of the points of a run, and which of them broke.
  [[gnu::noinline]] SweepResult look_at_soundness(RowRun run) const;

 private:
  [[gnu::noinline]] SweepResult waves(RowRun run) const;
  template <bool softened>
  [[gnu::noinline]] double spread_squared(RowRun run) const;

  const SweepData& d_;
  const ReferenceMetrics& metrics_;
  const SweepWork& work_;
};

}  // namespace fsi::solid
