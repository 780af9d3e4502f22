/// Cost per step of moving grids: marching a body-fitted
/// grid, connecting it to the background, interpolating.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "common/grid/marching/hyperbolic.hpp"
#include "common/grid/overlap/composite_grid.hpp"

namespace fsi::grid {
namespace {

constexpr int around = 257, lines = 12, side = 256;

/// A deforming ring of 256 x 12 in a background of side x side points as wide as suits its spacing.
struct Ring {
  HyperbolicMarch march;
  Field x, x_old;
  std::vector<double> curve;
  double radius = 1;

  explicit Ring(double spacing)
      : march({.name = "ring", .points = around, .lines = lines, .curve = Side::top, .spacing = spacing}),
        x(march.layout(), 2),
        x_old(march.layout(), 2),
        curve(std::size_t{2} * around) {}

  void place(double t) {
    std::swap(x, x_old);
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * (k % (around - 1)) / (around - 1);
      const double r = radius * (1 + 0.05 * std::sin(2 * angle + t) + 0.02 * std::cos(5 * angle - t));
      curve[static_cast<std::size_t>(k)] = 0.1 * std::sin(t) + r * std::cos(angle);
      curve[static_cast<std::size_t>(around + k)] = 0.07 * std::cos(t) + r * std::sin(angle);
    }
    march.march(curve, x.view(), t);
  }
};

constexpr double spacing = 2 * std::numbers::pi / (around - 1);

CartesianGrid background(int n) {
  const double half = 0.5 * (n - 1) * spacing;
  return {.n1 = n, .n2 = n, .x_a = -half, .x_b = half, .y_a = -half, .y_b = half};
}

/// One update of the overlap per iteration, the march outside the clock.
void overlap_update(benchmark::State& state) {
  Ring ring(spacing);
  ring.place(0);
  ring.place(0);
  CompositeGrid grids(background(static_cast<int>(state.range(0))),
                      {{.name = "ring", .n1 = around, .n2 = lines, .curve = Side::top}});
  const ConstFieldView start[] = {ring.x.view()};
  grids.connect(start, 0);
  double t = 0;
  std::size_t exposed = 0;
  for (auto step : state) {
    state.PauseTiming();
    ring.place(t += 0.01);
    const GridPositions x[] = {{ring.x.view(), ring.x_old.view()}};
    state.ResumeTiming();
    grids.update(x, t);
    exposed += grids.counts().exposed;
  }
  state.counters["interpolated"] = static_cast<double>(grids.counts().interpolated);
  state.counters["exposed_per_step"] =
      benchmark::Counter(static_cast<double>(exposed), benchmark::Counter::kAvgIterations);
}

void hyperbolic_march(benchmark::State& state) {
  Ring ring(spacing);
  double t = 0;
  for (auto step : state) ring.place(t += 0.01);
}

void interpolate_four_planes(benchmark::State& state) {
  Ring ring(spacing);
  ring.place(0);
  CompositeGrid grids(background(side), {{.name = "ring", .n1 = around, .n2 = lines, .curve = Side::top}});
  const ConstFieldView x[] = {ring.x.view()};
  grids.connect(x, 0);
  Field plane(grids.layout(0), 4), strip(grids.layout(1), 4);
  const FieldView fields[] = {plane.view(), strip.view()};
  for (auto step : state) {
    grids.interpolate(fields);
    benchmark::ClobberMemory();
  }
}

BENCHMARK(overlap_update)
    ->Arg(side)
    ->Arg(std::int64_t{2} * side)
    ->Arg(std::int64_t{4} * side)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(hyperbolic_march)->Unit(benchmark::kMicrosecond);
BENCHMARK(interpolate_four_planes)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace fsi::grid
