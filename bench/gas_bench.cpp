/// Points the gas solver advances per second and core: one
/// step of the sweep, and a whole step of the time loop.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "fluid_solver/gas_solver.hpp"

namespace {

using fsi::Vec2;
using namespace fsi::fluid;

constexpr double pi = std::numbers::pi;

/// Periodic unit square of n x n points, at rest on a lattice or with lines that swing. The formula is a
/// cheap one: it is not what is measured.
fsi::grid::GridDescription square(int n, bool moving) {
  fsi::grid::GridDescription grid;
  grid.n1 = grid.n2 = n;
  grid.moving = moving;
  grid.periodic1 = grid.periodic2 = true;
  grid.mapping = [moving](double r, double s, double t) {
    const double a = r - std::floor(r), b = s - std::floor(s), tau = t - std::floor(t);
    const double hill = a * (1 - a) * b * (1 - b), swing = moving ? 5 * hill * hill : 0.0;
    return Vec2(r + swing * (1 - tau), s + swing * tau * (1 - tau));
  };
  return grid;
}

/// Arguments: points per side, moving, limiter, Riemann solver.
GasSolver solver_of(const benchmark::State& state) {
  GasOptions options;
  options.limiter = static_cast<Limiter>(state.range(2));
  options.riemann = static_cast<Riemann>(state.range(3));
  GasSolver gas(fsi::grid::MovingGrid(square(static_cast<int>(state.range(0)), state.range(1) != 0), 0),
                options, {Periodic{}, Periodic{}, Periodic{}, Periodic{}}, 0);
  gas.assign_initial_conditions([](double x, double y, double) {
    const double wave = std::sin(2 * pi * x) * std::sin(2 * pi * y);
    return State{.rho = 1 + 0.2 * wave, .v1 = 0.5, .v2 = 0.3, .p = 1 / 1.4 + 0.05 * wave};
  });
  return gas;
}

void report(benchmark::State& state, const GasSolver& gas) {
  const auto updates = static_cast<double>(gas.points()) * static_cast<double>(state.iterations());
  state.counters["point_updates_per_s"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
}

/// The sweep alone: predict, Riemann problems, update, wave rates.
void advance_fluid(benchmark::State& state) {
  GasSolver gas = solver_of(state);
  const double dt = 0.5 * gas.compute_time_step().dt;
  double t = 0;
  for (auto _ : state) {
    t += dt;
    state.PauseTiming();
    gas.move_grids(t, dt);
    state.ResumeTiming();
    gas.advance_fluid(t, dt);
    state.PauseTiming();
    gas.apply_fluid_bcs(t);
    state.ResumeTiming();
  }
  report(state, gas);
}

/// A whole step: dt, grid motion (the mapping's formula included), sweep, boundaries.
void whole_step(benchmark::State& state) {
  GasSolver gas = solver_of(state);
  double t = 0;
  for (auto _ : state) {
    const double dt = gas.compute_time_step().dt;
    t += dt;
    gas.move_grids(t, dt);
    gas.advance_fluid(t, dt);
    gas.apply_fluid_bcs(t);
  }
  report(state, gas);
}

constexpr int none = static_cast<int>(Limiter::none), minmod = static_cast<int>(Limiter::minmod);
constexpr int roe = static_cast<int>(Riemann::roe), hllc = static_cast<int>(Riemann::hllc);

void cases(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"n", "moving", "limiter", "riemann"});
  for (const int moving : {0, 1}) {
    for (const int limiter : {none, minmod}) {
      for (const int riemann : {roe, hllc}) bench->Args({512, moving, limiter, riemann});
    }
  }
  bench->Unit(benchmark::kMillisecond);
}

BENCHMARK(advance_fluid)->Apply(cases);
BENCHMARK(whole_step)
    ->Args({512, 0, minmod, roe})
    ->Args({512, 1, minmod, roe})
    ->ArgNames({"n", "moving", "limiter", "riemann"})
    ->Unit(benchmark::kMillisecond);

}  // namespace
