// An interface that goes round the corners of a body's one grid.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/grid/geometry/interface_geometry.hpp"
#include "common/interface/riemann.hpp"
#include "common/wire/messages.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
#include "solid_solver/boundary/joined_sides.hpp"
#include "solid_solver/boundary/traction_ghost.hpp"
#include "solid_solver/neo_hookean_solver.hpp"
#include "tests/convergence/solid/block_in_gas.hpp"

namespace fsi::solid {
namespace {

using Solver = SolidSolver<NeoHookean>;

const NeoHookean rubber{.lambda = 20, .mu = 1};
constexpr SolidOptions usual = {.rho = 1.5,
                                .limiter = Limiter::minmod,
                                .tangential_stress = {.scaled = 0.5},
                                .displacement = {.scaled = 0.5},
                                .relaxation = {.scaled = 0.2}};

Vec2 at_rest(double, double, double) {
  return {0, 0};
}

/// A turned parallelogram, all of whose sides meet a gas, or all but the one that is clamped.
struct Block {
  static constexpr int n1 = 8, n2 = 12;
  Solver solver;
  JoinedSides outline;

  explicit Block(std::optional<Side> clamped = {})
      : solver(grid(), rubber, usual, boundaries(clamped), 0), outline(sides(clamped)) {}

  static grid::MovingGrid grid() {
    return {{.name = "block",
             .n1 = n1 + 1,
             .n2 = n2 + 1,
             .mapping = [](double r, double s, double) -> Vec2 {
               return {0.3 + 0.8 * r - 0.4 * s, 0.2 + 0.3 * r + 1.2 * s};
             }},
            0};
  }
  static Boundaries boundaries(std::optional<Side> clamped) {
    Boundaries all;
    for (Boundary& one : all) one.condition = Interface::condition;
    if (clamped) all[static_cast<std::size_t>(*clamped)].condition = Displacement::condition;
    return all;
  }
  static JoinedSides sides(std::optional<Side> clamped) {
    std::vector<Stretch> stretches{{Side::bottom}, {Side::right}, {Side::top, true}, {Side::left, true}};
    if (clamped) stretches.erase(stretches.begin());  // the bottom
    std::vector<int> points;
    for (const Stretch& stretch : stretches)
      points.push_back(direction_of(stretch.side) == 0 ? n2 + 1 : n1 + 1);
    return {stretches, points, !clamped};
  }

  SolidInterface shown() const {
    std::vector<SolidInterface> each(outline.stretches().size());
    for (std::size_t k = 0; k < each.size(); ++k)
      solver.interface_state(outline.stretches()[k].side, each[k]);
    SolidInterface whole;
    outline.join(each, whole);
    return whole;
  }
  std::vector<double> normals(const SolidInterface& state) const {
    return grid::normals(state.x, outline.closed() ? grid::Curve::closed : grid::Curve::open, 1);
  }
  /// Tells all points to move with v, under a pressure.
  void tell(double t, const Vec2& v, double p) {
    const SolidInterface state = shown();
    const std::vector<double> n = normals(state);
    const std::size_t count = outline.points();
    std::vector<double> v_n(count), w_n(count, -p);
    for (std::size_t k = 0; k < count; ++k) v_n[k] = n[k] * v[0] + n[count + k] * v[1];
    std::vector<InterfaceValues> values;
    outline.split({.n = n, .v_n = v_n, .w_n = w_n}, values);
    solver.apply_solid_bcs(t, values);
  }
};

/// The stretch c at which a block that is stretched alike everywhere has a pressure.
double stretch_under(double p) {
  double low = 0.5, high = 1;
  for (int k = 0; k < 100; ++k) {
    const double c = 0.5 * (low + high);
    const double pressure = -rubber.P({c, 0, 0, c}).a11 / c;
    (pressure > p ? low : high) = c;
  }
  return low;
}

TEST(Corners, AnOutlineHasTheBodyToItsLeftAndEachCornerOnce) {
  const Block block;
  const SolidInterface state = block.shown();
  const std::size_t n = block.outline.points();
  ASSERT_EQ(n, 2U * (Block::n1 + Block::n2) + 1);
  EXPECT_EQ(state.x[0], state.x[n - 1]);
  EXPECT_EQ(state.x[n], state.x[2 * n - 1]);
  double area = 0;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    EXPECT_GT(std::hypot(state.x[k + 1] - state.x[k], state.x[n + k + 1] - state.x[n + k]), 0.05) << k;
    area += 0.5 * (state.x[k] * state.x[n + k + 1] - state.x[k + 1] * state.x[n + k]);
  }
  EXPECT_NEAR(area, 0.8 * 1.2 + 0.4 * 0.3, 1e-14);
  for (std::size_t k = 0; k < n; ++k)
    EXPECT_GT(state.Z[k] * state.Z[2 * n + k], state.Z[n + k] * state.Z[n + k]);
}

TEST(Corners, ABlockUnderAPressureShowsItAlongTheNormalOfTheChordAtItsCornersToo) {
  Block block;
  const double p = 0.7, c = stretch_under(p);
  block.solver.assign_initial_conditions(
      [c](double x, double y, double) -> Vec2 {
        return {(c - 1) * x, (c - 1) * y};
      },
      at_rest);
  block.tell(0, {0, 0}, p);
  const SolidInterface state = block.shown();
  const std::vector<double> n = block.normals(state);
  for (std::size_t k = 0; k < n.size(); ++k) EXPECT_NEAR(state.w[k], -p * n[k], 1e-12) << k;
}

TEST(Corners, ABlockUnderAPressureStaysAtRestAndThatWhichMovesWithItGoesOn) {
  for (const Vec2& v : {Vec2(0, 0), Vec2(0.4, -0.7)}) {
    Block block;
    const double p = 0.7, c = stretch_under(p);
    block.solver.assign_initial_conditions(
        [c](double x, double y, double) -> Vec2 {
          return {(c - 1) * x, (c - 1) * y};
        },
        [v](double, double, double) { return v; });
    double t = 0;
    for (int step = 0; step < 40; ++step) {
      const double dt = block.solver.compute_time_step().dt;
      block.solver.advance_solid(t, dt);
      t += dt;
      block.tell(t, v, p);
    }
    const SolidInterface state = block.shown();
    const std::size_t n = block.outline.points();
    for (std::size_t k = 0; k < n; ++k) {
      EXPECT_NEAR(state.v[k], v[0], 1e-11) << k;
      EXPECT_NEAR(state.v[n + k], v[1], 1e-11) << k;
    }
  }
}

TEST(Corners, OfABodyOnAWallTheOutlineBeginsAndEndsThereWithHeldPoints) {
  const Block block(Side::bottom);
  const SolidInterface state = block.shown();
  const std::size_t n = block.outline.points();
  ASSERT_EQ(n, static_cast<std::size_t>(Block::n1 + 2 * Block::n2 + 1));
  EXPECT_EQ(state.fixed.front(), wire::Freedom::fixed);
  EXPECT_EQ(state.fixed.back(), wire::Freedom::fixed);
  for (std::size_t k = 1; k + 1 < n; ++k) EXPECT_EQ(state.fixed[k], wire::Freedom::free) << k;
}

TEST(Corners, EachSideIsToldWhatStandsAtItsPoints) {
  Block block;
  const SolidInterface state = block.shown();
  std::vector<InterfaceValues> values;
  const std::size_t n = block.outline.points();
  // Positions in the place of normals come back as the positions of each side.
  block.outline.split({.n = state.x, .v_n = std::span(state.x).first(n), .w_n = std::span(state.x).last(n)},
                      values);
  ASSERT_EQ(values.size(), 4U);
  for (const InterfaceValues& side : values) {
    const std::vector<double> x = block.solver.grid().side_points(side.side);
    EXPECT_TRUE(std::ranges::equal(side.n, x)) << name_of(side.side);
    EXPECT_TRUE(std::ranges::equal(side.v_n, std::span(x).first(x.size() / 2)));
    EXPECT_TRUE(std::ranges::equal(side.w_n, std::span(x).last(x.size() / 2)));
    EXPECT_TRUE(side.goes_on[0] && side.goes_on[1]);
  }
}

TEST(Corners, Eq41NoiseOfANearlyIncompressibleBlockInALightGasDoesNotGrow) {
  for (const double lambda : {1.0, 49.0, 499.0}) {
    const test::NoiseCase noise = {.lambda = lambda, .beta_P = 0.5, .beta_u = 0.5, .beta_r = 0.2};
    EXPECT_LT(test::growth_of_noise_in_gas<NeoHookean>(noise, {}, 3000), 1.0) << lambda;
  }
}

TEST(Corners, Eq18NoiseOfABlockOfLongCellsInAGasDoesNotGrow) {
  for (const double aspect : {0.25, 0.5, 2.0, 4.0, 8.0}) {
    for (const double z_f : {2e-3, 0.5, 10.0}) {
      const test::NoiseCase noise = {.aspect = aspect, .beta_P = 0.5, .beta_u = 0.5, .beta_r = 0.2};
      EXPECT_LT(test::growth_of_noise_in_gas<NeoHookean>(noise, {.z_f = z_f}, 1500), 1.0)
          << aspect << ", " << z_f;
    }
  }
}

TEST(Corners, Eq18NoiseWhereAnInterfaceMeetsAFreeSideDoesNotGrow) {
  for (const double aspect : {0.25, 1.0, 4.0}) {
    for (const double lambda : {1.0, 49.0}) {
      const test::NoiseCase noise = {
          .lambda = lambda, .aspect = aspect, .beta_P = 0.5, .beta_u = 0.5, .beta_r = 0.2};
      EXPECT_LT(
          test::growth_of_noise_in_gas<NeoHookean>(noise, {.gas = test::Surroundings::Gas::not_below}, 1500),
          1.0)
          << aspect << ", " << lambda;
    }
  }
}

TEST(Corners, Eq18NoiseOfANearlyIncompressibleBlockUnderGivenLoadsDoesNotGrow) {
  for (const double lambda : {100.0, 200.0}) {
    const test::NoiseCase noise = {
        .lambda = lambda, .beta_P = 0.5, .beta_u = 0.5, .beta_r = 0.2, .loaded = {false, true, true, true}};
    EXPECT_LT(test::growth_of_noise<NeoHookean>(noise, 5000), 1.0) << lambda;
  }
}

TEST(Corners, Eq43TheStrainOfACornerIsFoundFromAnExtrapolatedOneThatStretchesAreas) {
  const NeoHookean law{.lambda = 49, .mu = 1};
  const Tensor2 P = law.P({1.01, 0.02, -0.01, 1.002});
  for (int stretch = -10; stretch <= 30; ++stretch) {
    for (int shape = -10; shape <= 10; ++shape) {
      const double area = 0.005 * stretch, apart = 0.01 * shape;
      const auto F = match_corner(law, P, {1 + 0.5 * area + apart, 0.02, -0.01, 1 + 0.5 * area - apart});
      ASSERT_TRUE(F) << area << ", " << apart;
      // Up to the rotation that the start has.
      EXPECT_NEAR(law.P(*F).a11, P.a11, 1e-3) << area << ", " << apart;
      EXPECT_NEAR(law.P(*F).a22, P.a22, 1e-3) << area << ", " << apart;
    }
  }
}

}  // namespace
}  // namespace fsi::solid
