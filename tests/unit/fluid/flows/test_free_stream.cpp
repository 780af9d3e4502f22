/// Uniform flow stays uniform to round-off, whatever the grid does.

#include <gtest/gtest.h>

#include "tests/unit/fluid/gas_runs.hpp"

namespace fsi::fluid {
namespace {

// some hundred steps, each with errors of 1e-16 relative to states of order one
constexpr double round_off = 1e-12;

const State stream{1.2, 0.7, -0.4, 0.9};
const State along_walls{1.2, 0.7, 0, 0.9};

StateField field(const State& state) {
  return [state](double, double, double) { return state; };
}

struct Setting {
  std::string name;
  State state;
  std::array<Boundary, 4> boundaries;
  bool periodic = false;
};

std::vector<Setting> settings() {
  const Boundary given = Dirichlet{field(stream)}, inflow = Imposed{field(stream)};
  return {{"outflow", stream, {Outflow{}, Outflow{}, Outflow{}, Outflow{}}},
          {"dirichlet", stream, {given, given, given, given}},
          {"inflow_outflow", stream, {inflow, Outflow{}, Outflow{}, inflow}},
          {"walls", along_walls, {Imposed{field(along_walls)}, Outflow{}, SlipWall{}, Symmetry{}}},
          {"periodic", stream, {Periodic{}, Periodic{}, Periodic{}, Periodic{}}, true}};
}

class Eq31FreeStream : public testing::TestWithParam<std::tuple<Setting, Riemann, Limiter>> {};

TEST_P(Eq31FreeStream, StaysUniformOnAShakenSwingingGrid) {
  const auto& [setting, riemann, limiter] = GetParam();
  grid::GridDescription grid = test::wavy(17, 14, {0, 0}, {1.3, 0.8});
  grid.shake = 0.15;
  grid.periodic1 = grid.periodic2 = setting.periodic;
  const GasOptions options{
      .riemann = riemann, .limiter = limiter, .shock_viscosity = 0.5, .linear_diffusion = 0.3};
  GasSolver gas = test::solver(grid, options, setting.boundaries, field(setting.state));
  test::run(gas, 0.5);
  EXPECT_LT(test::largest_error(gas.errors(field(setting.state), 0)), round_off);
  EXPECT_EQ(gas.health().first_order_fallbacks, 0U);
  EXPECT_EQ(gas.health().bounded_side_points, 0U);
}

INSTANTIATE_TEST_SUITE_P(AllBoundaries, Eq31FreeStream,
                         testing::Combine(testing::ValuesIn(settings()),
                                          testing::Values(Riemann::roe, Riemann::hllc),
                                          testing::Values(Limiter::none, Limiter::minmod)),
                         [](const auto& test) {
                           return std::get<0>(test.param).name +
                                  (std::get<1>(test.param) == Riemann::roe ? "_roe" : "_hllc") +
                                  (std::get<2>(test.param) == Limiter::none ? "_centred" : "_minmod");
                         });

/// Values of an interface that moves with constant velocity v in a gas at pressure p_e.
test::Projection drifting(const Vec2& v) {
  return [v](const GasSolver& gas, double) {
    const auto n = static_cast<std::size_t>(gas.grid().side_size(Side::left));
    test::OwnedInterface side;
    side.n.assign(n, 1);
    side.n.resize(2 * n, 0);
    side.v_n.assign(n, v[0]);
    side.w_n.assign(n, 0);
    side.v.assign(n, v[0]);
    side.v.resize(2 * n, v[1]);
    side.a.assign(2 * n, 0);
    return std::vector{side};
  };
}

TEST(Eq31FreeStreamInterface, GasAndInterfaceDriftTogether) {
  const StateField drift = field(stream);
  grid::GridDescription grid = test::rectangle(17, 14, {0, 0}, {1, 1});
  grid.mapping = [](double r, double s, double t) {
    return Vec2(r + stream.v1 * t, s + 0.1 * std::sin(5 * r + t));
  };
  grid.moving = true;
  GasSolver gas = test::solver(grid, {.p_e = stream.p, .limiter = Limiter::none},
                               {Interface{}, Outflow{}, Outflow{}, Outflow{}}, drift);
  test::run(gas, 0.5, drifting({stream.v1, stream.v2}));
  EXPECT_LT(test::largest_error(gas.errors(drift, 0)), round_off);
}

}  // namespace
}  // namespace fsi::fluid
