// Point updates of the solid per second and core: one step is the sweep at all points and all boundary work.

#include <benchmark/benchmark.h>

#include <cmath>

#include "solid_solver/laws/neo_hookean.hpp"
#include "solid_solver/laws/saint_venant_kirchhoff.hpp"
#include "solid_solver/ranks/solid_on_ranks.hpp"

namespace {

using namespace fsi;
using namespace fsi::solid;

constexpr int n = 512;

grid::MovingGrid cartesian_grid() {
  return {{.name = "cartesian",
           .n1 = n,
           .n2 = n,
           .mapping = [](double r, double s, double) -> Vec2 {
             return {r, s};
           }},
          0};
}

grid::MovingGrid wavy_grid() {
  const auto mapping = [](double r, double s, double) -> Vec2 {
    return {r + 0.2 * s + 0.03 * std::sin(3 * s), s + 0.05 * std::sin(3 * r)};
  };
  return {{.name = "wavy", .n1 = n, .n2 = n, .mapping = mapping}, 0};
}

Vec2 at_rest(double, double, double) {
  return {0, 0};
}

Vec2 shaking(double x, double y, double) {
  return {0.02 * std::cos(3 * x) * std::cos(3 * y), 0.02 * std::sin(3 * x * y)};
}

/// Free block that shakes smoothly; dt well below the limit, so that any number of steps is sound.
template <Law L>
void advance(benchmark::State& state, grid::MovingGrid grid, const SolidOptions& options) {
  Boundaries all_free;
  SolidSolver<L> solver(std::move(grid), L{.lambda = 1, .mu = 1}, options, all_free, 0);
  solver.assign_initial_conditions(at_rest, shaking);
  const double dt = 0.3 * solver.compute_time_step().dt;
  double t = 0;
  for (auto _ : state) {
    solver.advance_solid(t, dt);
    t += dt;
    solver.apply_solid_bcs(t);
  }
  state.counters["point_updates/s"] =
      benchmark::Counter(static_cast<double>(solver.points()), benchmark::Counter::kIsIterationInvariantRate);
}

void cartesian_svk(benchmark::State& state) {
  advance<SaintVenantKirchhoff>(state, cartesian_grid(), {.limiter = Limiter::minmod});
}
void cartesian_svk_mc(benchmark::State& state) {
  advance<SaintVenantKirchhoff>(state, cartesian_grid(), {.limiter = Limiter::mc});
}
void cartesian_svk_centred(benchmark::State& state) {
  advance<SaintVenantKirchhoff>(state, cartesian_grid(), {});
}
void curvilinear_svk(benchmark::State& state) {
  advance<SaintVenantKirchhoff>(state, wavy_grid(), {.limiter = Limiter::minmod});
}
void curvilinear_svk_dissipation(benchmark::State& state) {
  advance<SaintVenantKirchhoff>(
      state, wavy_grid(),
      {.tangential_stress = {.scaled = 0.1}, .displacement = {.scaled = 0.1}, .relaxation = {.rate = 0.5}});
}
void cartesian_neo_hookean(benchmark::State& state) {
  advance<NeoHookean>(state, cartesian_grid(), {.limiter = Limiter::minmod});
}
/// The coefficients that a case has unless it says otherwise.
void cartesian_neo_hookean_defaults(benchmark::State& state) {
  advance<NeoHookean>(state, cartesian_grid(),
                      {.limiter = Limiter::mc,
                       .tangential_stress = {.scaled = 0.5},
                       .displacement = {.scaled = 0.5},
                       .relaxation = {.scaled = 0.2}});
}

BENCHMARK(cartesian_svk)->Unit(benchmark::kMillisecond);
BENCHMARK(cartesian_svk_mc)->Unit(benchmark::kMillisecond);
BENCHMARK(cartesian_svk_centred)->Unit(benchmark::kMillisecond);
BENCHMARK(curvilinear_svk)->Unit(benchmark::kMillisecond);
BENCHMARK(curvilinear_svk_dissipation)->Unit(benchmark::kMillisecond);
BENCHMARK(cartesian_neo_hookean)->Unit(benchmark::kMillisecond);
BENCHMARK(cartesian_neo_hookean_defaults)->Unit(benchmark::kMillisecond);

}  // namespace
