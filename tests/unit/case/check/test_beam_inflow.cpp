/// The inflow of the beam's case: a smooth ramp from the gas at rest to the state behind a shock.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/case/case.hpp"

namespace fsi {
namespace {

constexpr double gas_gamma = 1.4, mach = 1.1;

/// rho, v1, v2, p on the left side of the channel at t.
std::array<double, 4> inflow(const Case& problem, double t) {
  const BoundarySpec& left = problem.fluids.front().boundary[static_cast<std::size_t>(Side::left)];
  EXPECT_EQ(left.kind, BoundaryKind::imposed);
  const GasExpressions& state = left.state.value();
  const double x = -1, y = 0.7;
  return {state.rho(x, y, t), state.v1(x, y, t), state.v2(x, y, t), state.p(x, y, t)};
}

Case beam() {
  return load_case(FSI_ROOT "/configs/beam.yaml");
}

TEST(Eq51BeamInflow, GoesFromTheGasAtRestToTheStateThePaperPrints) {
  const Case problem = beam();
  const GasExpressions& initial = problem.fluids.front().initial.value();
  const std::array<double, 4> rest = inflow(problem, 0), behind = inflow(problem, 1),
                              later = inflow(problem, 5);
  EXPECT_EQ(rest[0], initial.rho(0, 0, 0));
  EXPECT_EQ(rest[1], initial.v1(0, 0, 0));
  EXPECT_EQ(rest[3], initial.p(0, 0, 0));
  EXPECT_EQ(behind, later);
  const std::array<double, 4> printed{1.1691, 0.1591, 0, 0.8893};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(behind[k], printed[k], 0.5e-4) << k;  // four digits
}

TEST(Eq51BeamInflow, EndsBehindAShockOfMach1Point1) {
  const Case problem = beam();
  const auto [rho_0, v_0, w_0, p_0] = inflow(problem, 0);
  const auto [rho, v, w, p] = inflow(problem, 1);
  const double speed = mach * std::sqrt(gas_gamma * p_0 / rho_0);  // of the shock into the gas at rest
  // Mass, momentum and energy through the shock, in its frame.
  const double flow = rho_0 * speed;
  const auto enthalpy = [](double density, double pressure) {
    return gas_gamma / (gas_gamma - 1) * pressure / density;
  };
  EXPECT_NEAR(rho * (speed - v), flow, 1e-14);
  EXPECT_NEAR(p + flow * (speed - v), p_0 + flow * speed, 1e-14);
  EXPECT_NEAR(enthalpy(rho, p) + 0.5 * (speed - v) * (speed - v), enthalpy(rho_0, p_0) + 0.5 * speed * speed,
              1e-14);
  EXPECT_EQ(w, 0);
  EXPECT_EQ(v_0, 0);
  EXPECT_EQ(w_0, 0);
}

TEST(Eq52Ramp, StartsAndEndsLevelAndIsOddAboutItsMiddle) {
  const Case problem = beam();
  const double top = inflow(problem, 1)[1];
  const auto R = [&](double t) { return inflow(problem, t)[1] / top; };
  EXPECT_EQ(R(0), 0);
  EXPECT_EQ(R(1), 1);
  const double h = 1e-4;  // R'' = +-6 at the ends: R(h) = 3 h^2
  EXPECT_LT(std::abs(R(h) - R(0)) / h, 4 * h);
  EXPECT_LT(std::abs(R(1) - R(1 - h)) / h, 4 * h);
  EXPECT_EQ(R(1 + h), 1);
  for (const double t : {0.1, 0.25, 0.4, 0.5}) EXPECT_NEAR(R(0.5 + t) + R(0.5 - t), 1, 1e-14) << t;
  EXPECT_NEAR((R(0.5 + h) - R(0.5 - h)) / (2 * h), 1.5, 1e-7);  // the cubic with these ends has this slope
  // All four quantities follow the same ramp.
  const std::array<double, 4> rest = inflow(problem, 0), now = inflow(problem, 0.3),
                              behind = inflow(problem, 1);
  for (const std::size_t k : {0U, 3U})
    EXPECT_NEAR((now[k] - rest[k]) / (behind[k] - rest[k]), R(0.3), 1e-14) << k;
}

}  // namespace
}  // namespace fsi
