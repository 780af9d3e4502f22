/// The same body in other units moves the same to the bit, where the units differ by powers of two: no number in the
/// code has a dimension.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "solid_solver/boundary/every_boundary.hpp"
#include "tests/convergence/solid/disk.hpp"
#include "tests/convergence/solid/solvers.hpp"

namespace fsi::solid {
namespace {

/// Factors of lengths, times and densities.
struct Units {
  double length = 1, time = 1, density = 1;
  double speed() const { return length / time; }
  double pressure() const { return density * speed() * speed(); }
};

SolidOptions options_in(const Units& units) {
  const double rate = 0.5 / units.time;
  return {.rho = 1.4 * units.density,
          .limiter = Limiter::minmod,
          .tangential_stress = {.rate = rate, .scaled = 0.1},
          .displacement = {.rate = rate, .scaled = 0.1},
          .relaxation = {.rate = rate, .scaled = 0.1},
          .bulk_diffusion = 0.5 * rate};
}

template <class L>
L law_in(const Units& units) {
  return {.lambda = 1.1 * units.pressure(), .mu = 0.7 * units.pressure()};
}

/// A vector of a dimension, as function of place and time, in these units.
VectorFunction in(const Units& units, double factor, const VectorFunction& vector) {
  return [=](double x, double y, double t) -> Vec2 {
    return factor * vector(x / units.length, y / units.length, t / units.time);
  };
}

template <class L>
void start(SolidSolver<L>& solver, const Units& units) {
  solver.assign_initial_conditions(in(units, units.length,
                                      [](double x, double y, double) -> Vec2 {
                                        return {0.02 * x * y, -0.01 * y * y};
                                      }),
                                   in(units, units.speed(), [](double x, double y, double) -> Vec2 {
                                     return {0.1 * std::sin(3 * y), -0.2 * x * y};
                                   }));
}

/// What a gas might answer: most of the velocity, and a pressure that grows.
template <class L>
void close(SolidSolver<L>& solver, double t, int step, const Units& units) {
  if (solver.grids() == 1) return solver.apply_solid_bcs(t);
  SolidInterface state;
  solver.interface_state(Side::bottom, state, 1);
  const std::size_t n = state.x.size() / 2;
  std::vector<double> normal(2 * n), v_n(n), w_n(n, -0.01 * step * units.pressure());
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = 6.25 * static_cast<double>(k) / static_cast<double>(n);
    normal[k] = std::cos(angle), normal[n + k] = std::sin(angle);
    v_n[k] = 0.9 * (state.v[k] * normal[k] + state.v[n + k] * normal[n + k]);
  }
  const InterfaceValues values[] = {{.side = Side::bottom, .n = normal, .v_n = v_n, .w_n = w_n, .grid = 1}};
  solver.apply_solid_bcs(t, values);
}

/// Steps as long as each of them can take, and compares the states as if they had the units of `one`.
template <class L>
void expect_same(SolidSolver<L>& one, SolidSolver<L>& other, const Units& units) {
  start(one, {});
  start(other, units);
  double t = 0, time = 0;
  for (int step = 1; step <= 15; ++step) {
    const double dt = one.compute_time_step().dt, of_other = other.compute_time_step().dt;
    ASSERT_EQ(units.time * dt, of_other) << "step " << step;
    one.advance_solid(t, dt);
    other.advance_solid(time, of_other);
    close(one, t += dt, step, {});
    close(other, time += of_other, step, units);
  }
  const double length = units.length, speed = units.speed(), p = units.pressure();
  const std::array<double, plane::count> factors{length, length, speed, speed, p, p, p, p};
  for (int grid = 0; grid < one.grids(); ++grid) {
    const ConstFieldView q = one.state(grid), r = other.state(grid);
    std::size_t different = 0;
    for (int j = 0; j < q.layout.n2; ++j) {
      for (const grid::Interval& run : one.valid(grid).row(j)) {
        for (int i = run.begin; i < run.end; ++i) {
          for (int c = 0; c < plane::count; ++c)
            different += factors[static_cast<std::size_t>(c)] * q(c, i, j) == r(c, i, j) ? 0U : 1U;
        }
      }
    }
    EXPECT_EQ(different, 0U) << "grid " << grid;
  }
  EXPECT_EQ(one.health().min_det_F, other.health().min_det_F);
}

template <class L>
SolidSolver<L> disk(const Units& units) {
  Boundary rim;
  rim.condition = Interface::condition;
  test::DiskGrids grids = test::disk_of(12, std::move(rim), 9, units.length);
  return {std::move(grids.parts), grids.bodies, law_in<L>(units), options_in(units), 0};
}

/// A curved block: held, loaded, sliding, free.
template <class L>
SolidSolver<L> block(const Units& units) {
  const double length = units.length;
  Boundaries sides;
  sides[0].condition = Displacement::condition;
  sides[1].vector = in(units, units.pressure(), [](double, double y, double t) -> Vec2 {
    return {-0.05 * t, 0.03 * y};
  });
  sides[2].condition = SlipWall::condition;
  return {grid::MovingGrid({.name = "block",
                            .n1 = 21,
                            .n2 = 15,
                            .mapping = [length](double r, double s, double) -> Vec2 {
                              return {length * (r + 0.1 * s * s), length * s * (0.7 + 0.1 * r)};
                            }},
                           0),
          law_in<L>(units), options_in(units), sides, 0};
}

template <class L>
class SolidInUnits : public ::testing::Test {};
using Laws = ::testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHookean>;
TYPED_TEST_SUITE(SolidInUnits, Laws);

constexpr std::array<Units, 4> powers_of_two{{{.length = 0x1p-10},
                                              {.time = 0x1p-17},
                                              {.density = 0x1p9},
                                              {.length = 0x1p7, .time = 0x1p-5, .density = 0x1p-12}}};

TYPED_TEST(SolidInUnits, DiskOnTwoGridsBesideAGas) {
  for (const Units& units : powers_of_two) {
    auto one = disk<TypeParam>({}), other = disk<TypeParam>(units);
    expect_same(one, other, units);
  }
}

TYPED_TEST(SolidInUnits, CurvedBlockThatIsHeldAndLoaded) {
  for (const Units& units : powers_of_two) {
    auto one = block<TypeParam>({}), other = block<TypeParam>(units);
    expect_same(one, other, units);
  }
}

}  // namespace
}  // namespace fsi::solid
