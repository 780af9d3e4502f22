// What a solid program does in a coupled run, without the bus: the ellipse of configs/shock_ellipse.yaml at h = 1/80 in macro
// steps of eight substeps, from the answer of the coupler to the next predicted state. A gas that answers with a given
// characteristic stands for the other programs.

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/grid/geometry/interface_geometry.hpp"
#include "solid_solver/boundary/robin.hpp"
#include "solid_solver/laws/neo_hookean.hpp"
#include "solid_solver/program/port.hpp"

namespace {

using namespace fsi;
using namespace fsi::solid;

constexpr int substeps = 8;

/// A folder for the tables the program writes.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("fsi_bench_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// The coupler's answer for a gas at rest whose waves press the outline together along x and pull it apart along y.
wire::ProjectedInterface answer_to(const wire::PredictedInterface& predicted) {
  const std::size_t n = predicted.x.size() / 2;
  wire::ProjectedInterface answer;
  answer.n = grid::normals(predicted.x, grid::Curve::closed, grid::outward(Side::bottom));
  answer.z_f.assign(n, std::sqrt(1.4));
  answer.robin_t = {predicted.t};
  for (std::size_t k = 0; k < n; ++k) {
    constexpr double strength = 0.3;
    answer.robin_r.push_back(-strength * (answer.n[k] * answer.n[k] - answer.n[n + k] * answer.n[n + k]));
  }
  const SolidInterface solid = {
      .x = predicted.x, .v = predicted.v, .w = predicted.w, .Z = predicted.Z, .fixed = predicted.fixed};
  const ClosedInterface closed = close_with_robin(
      {.z_f = answer.z_f, .t = answer.robin_t, .r = answer.robin_r}, predicted.t, answer.n, solid);
  answer.v_n = closed.v_n;
  answer.w_n = closed.w_n;
  return answer;
}

void ellipse_substeps(benchmark::State& state) {
  const Folder folder;
  const Setup setup = {.problem = load_case(FSI_CONFIGS "/shock_ellipse.yaml", {"grid.factor=8"}),
                       .run_dir = folder.path(),
                       .run = "bench",
                       .name = "ellipse"};
  SolidParticipant solid(setup, solid_of(setup), law_kind<NeoHookean>());
  const double dt = 0.9 * substeps * solid.compute_time_step().dt;
  double t = 0;
  wire::PredictedInterface predicted;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solid.compute_time_step());
    predicted.t = t;
    solid.fill(0, predicted);
    state.PauseTiming();
    const wire::ProjectedInterface answer = answer_to(predicted);
    const wire::ProjectedInterface* answers[] = {&answer};
    state.ResumeTiming();
    solid.apply_bcs(t, answers);
    solid.write_tables(t, dt, answers);
    solid.advance(t, dt, substeps, answers);
    t += dt;
  }
  const double points = static_cast<double>(solid.hello().points);
  state.counters["points"] = points;
  state.counters["point_updates/s"] =
      benchmark::Counter(points * substeps, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["substeps/s"] = benchmark::Counter(substeps, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(ellipse_substeps)->Unit(benchmark::kMillisecond);

}  // namespace
