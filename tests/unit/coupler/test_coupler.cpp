/// One exchange of the coupler as a whole.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/core/failure.hpp"
#include "coupler/coupler.hpp"
#include "exchanges.hpp"
#include "messages.hpp"

namespace fsi::coupler {
namespace {

using namespace testing;

TEST(Coupler, Eq12GasAndSolidAreToldTheSameNormalVelocityAndTraction) {
  Coupler coupler(until(1), piston_hellos(n));
  auto gas = gas_state(n, 0);
  auto solid = solid_state(n, 0);
  gas.v = everywhere(n, 0.3, 0.8);
  gas.p.assign(n, 1.2);
  solid.v = everywhere(n, -0.2, 0.1);
  solid.w = everywhere(n, 0.4, 0.05);
  const auto answers = coupler.step(std::vector{gas, solid});
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].to, "fluid");
  EXPECT_EQ(answers[1].to, "solid");
  EXPECT_EQ(answers[0].v_n, answers[1].v_n);
  EXPECT_EQ(answers[0].w_n, answers[1].w_n);
  EXPECT_EQ(answers[0].n, everywhere(n, 1, 0));
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_EQ(answers[0].v[k], answers[1].v_n[k]);
    EXPECT_EQ(answers[0].v[n + k], 0.1);  // the solid keeps its own tangential velocity
  }
  const InterfaceReport report = coupler.reports().front();
  EXPECT_NEAR(report.velocity_jump, 0.5, 1e-15);
  EXPECT_NEAR(report.traction_jump, std::hypot(0.6, 0.05), 1e-15);
  EXPECT_NEAR(report.power, answers[0].v_n[0] * answers[0].w_n[0],
              1e-15);  // uniform along a side of length 1
}

TEST(Coupler, UniformMotionAtEquilibriumPressureStaysUniformToTheLastBit) {
  for (const Projection how : {Projection::full, Projection::simplified, Projection::traditional}) {
    for (const bool multirate : {false, true}) {
      CouplerOptions options = until(1);
      options.combination.projection = how;
      options.multirate = multirate;
      Coupler coupler(options, piston_hellos(n));
      for (std::uint64_t k = 0; k < 5; ++k) {
        auto gas = gas_state(n, k);
        auto solid = solid_state(n, k);
        gas.v = everywhere(n, 0.3, -0.7);
        solid.v = gas.v;
        const auto answers = coupler.step(std::vector{gas, solid});
        EXPECT_EQ(answers[0].v, everywhere(n, 0.3, -0.7));
        EXPECT_EQ(answers[0].w_n, std::vector<double>(n, 0.0));
        EXPECT_EQ(answers[0].a, k == 0 ? std::vector<double>{} : everywhere(n, 0, 0));  // not known at first
      }
    }
  }
}

TEST(Coupler, PointsOnAClampedBoundaryKeepTheirVelocityAndBearTheLoadOfAWall) {
  Coupler coupler(until(1), piston_hellos(n));
  auto gas = gas_state(n, 0);
  auto solid = solid_state(n, 0);
  gas.v = everywhere(n, 0.3, 0);
  solid.fixed = {1, 0, 0, 0};
  const auto answers = coupler.step(std::vector{gas, solid});
  EXPECT_EQ(answers[0].v_n[0], 0.0);
  EXPECT_NEAR(answers[0].w_n[0], 0.3, 1e-15);  // z_f = 1: the gas is stretched by 0.3 off the wall
  EXPECT_GT(answers[0].v_n[1], 0.0);
}

TEST(Coupler, EndsThatSlideAlongAWallStayOnIt) {
  Coupler coupler(until(1), piston_hellos(n));
  for (std::uint64_t k = 0; k < 3; ++k) {
    auto gas = gas_state(n, k);
    auto solid = solid_state(n, k);
    gas.v = everywhere(n, -0.3, 0);
    gas.x[0] += 0.02;  // the interface is not straight
    solid.fixed = {wire::Freedom::slides, 0, 0, wire::Freedom::slides};
    const auto answers = coupler.step(std::vector{gas, solid});
    for (const std::size_t end : {std::size_t{0}, n - 1}) {
      EXPECT_EQ(answers[0].x_next[n + end], solid.x[n + end]);
      EXPECT_EQ(answers[0].v[n + end], 0.0);
      EXPECT_LT(answers[0].v_n[end], 0.0);
    }
    EXPECT_NE(answers[0].x_next[n + 1], solid.x[n + 1]);  // other points follow their normal
  }
}

TEST(Coupler, WhatTheTwoSidesDifferByIsGoneWithTheNextCommand) {
  Coupler coupler(until(1), piston_hellos(n));
  auto gas = gas_state(n, 0);
  auto solid = solid_state(n, 0);
  gas.x = vertical_line(n, 0.01);
  const auto answers = coupler.step(std::vector{gas, solid});
  EXPECT_NEAR(coupler.reports().front().gap, 0.01, 1e-15);
  EXPECT_EQ(answers[0].x_next, vertical_line(n, 0));  // at rest: back to the solid's own position
}

TEST(Coupler, RobinDataUseTheNewestImpedanceOfTheGasForEveryTime) {
  CouplerOptions options = until(1);
  options.multirate = true;
  Coupler coupler(options, piston_hellos(n));
  std::vector<double> v_n;
  std::vector<double> w_n;
  for (std::uint64_t k = 0; k < 4; ++k) {
    auto gas = gas_state(n, k);
    auto solid = solid_state(n, k);
    const double z_f = 1.0 + static_cast<double>(k);
    gas.z_f.assign(n, z_f);
    gas.v = everywhere(n, 0.1 * z_f, 0);
    solid.proposed_dt = 0.03;
    const auto answers = coupler.step(std::vector{gas, solid});
    v_n.push_back(answers[1].v_n[0]);
    w_n.push_back(answers[1].w_n[0]);
    const std::size_t levels = std::min<std::size_t>(k + 1, 3);
    ASSERT_EQ(answers[1].robin_t.size(), levels);
    EXPECT_EQ(answers[1].robin_t[0], coupler.t());
    for (std::size_t level = 0; level < levels; ++level) {
      EXPECT_EQ(answers[1].robin_r[level * n], w_n[k - level] + z_f * v_n[k - level]);
    }
    EXPECT_EQ(answers[1].substeps_next, 4);
    EXPECT_EQ(answers[0].substeps_next, 1);
  }
}

TEST(Coupler, SendsNobodyWhatOnlyTheOtherSideNeeds) {
  for (const bool substeps : {false, true}) {
    CouplerOptions options = until(1);
    options.multirate = true;
    Coupler coupler(options, piston_hellos(n));
    coupler.step(std::vector{gas_state(n, 0), solid_state(n, 0)});
    auto solid = solid_state(n, 1);
    solid.proposed_dt = substeps ? 0.03 : 1;
    const auto answers = coupler.step(std::vector{gas_state(n, 1), solid});
    EXPECT_EQ(answers[0].x_next.size(), 2 * n);
    EXPECT_EQ(answers[0].v.size() + answers[0].a.size(), 4 * n);
    EXPECT_EQ(answers[0].z_f.size() + answers[0].robin_t.size() + answers[0].robin_r.size(), 0);
    EXPECT_EQ(answers[1].x_next.size() + answers[1].v.size() + answers[1].a.size(), 0);
    EXPECT_EQ(answers[1].z_f.size(), n);  // a beam takes its added mass from it
    EXPECT_EQ(answers[1].robin_t.empty(), !substeps);
    EXPECT_EQ(answers[1].robin_r.empty(), !substeps);
  }
}

TEST(Coupler, EndsExactlyAtTheEndAndSaysSoToEverybody) {
  Coupler coupler(until(0.25), piston_hellos(n));
  std::uint64_t step = 0;
  while (!coupler.finished()) {
    const auto answers = coupler.step(std::vector{gas_state(n, step), solid_state(n, step)});
    for (const wire::ProjectedInterface& answer : answers) {
      EXPECT_EQ(answer.stop, coupler.finished());
      EXPECT_EQ(answer.write_output, coupler.finished());
      EXPECT_TRUE(answer.stop_reason.empty());
    }
    ++step;
  }
  EXPECT_EQ(coupler.t(), 0.25);
  EXPECT_EQ(coupler.step_number(), 3U);
}

/// Times of the exchanges from the first that `coupler` makes to its end; of those with output.
struct Exchanged {
  std::vector<double> times, outputs;
};
Exchanged exchange_until_end(Coupler& coupler, std::uint64_t step) {
  Exchanged exchanged;
  for (; !coupler.finished() && exchanged.times.size() < 100; ++step) {
    const auto answers = coupler.step(std::vector{gas_state(n, step), solid_state(n, step)});
    exchanged.times.push_back(coupler.t());
    if (answers[0].write_output) exchanged.outputs.push_back(coupler.t());
  }
  return exchanged;
}

TEST(Coupler, ARunThatGoesOnFromBeforeItsLastStepHasTheEndAndTheOutputTimesOfNow) {
  Coupler former(until(0.25), piston_hellos(n));
  std::uint64_t step = 0;
  while (!former.next().plan.end) {
    former.step(std::vector{gas_state(n, step), solid_state(n, step)});
    ++step;
  }
  Archive saved;
  former.archive(saved);
  const auto goes_on = [&](double end, std::vector<double> outputs) {
    CouplerOptions options = until(end);
    options.time.output_times = std::move(outputs);
    Coupler coupler(options, piston_hellos(n));
    Archive archive(saved.entries());
    coupler.archive(archive);
    archive.check_all_loaded();
    return exchange_until_end(coupler, step);
  };
  EXPECT_EQ(goes_on(0.25, {}).times, std::vector<double>{0.25});
  const Exchanged longer = goes_on(0.5, {});
  EXPECT_EQ(longer.times.front(), 0.25);
  EXPECT_EQ(longer.outputs, std::vector<double>{0.5});
  EXPECT_EQ(goes_on(0.5, {0.25}).outputs, (std::vector<double>{0.25, 0.5}));
}

TEST(Coupler, StopsAndWritesACheckpointOnRequest) {
  Coupler coupler(until(1), piston_hellos(n));
  coupler.step(std::vector{gas_state(n, 0), solid_state(n, 0)});
  coupler.request_checkpoint();
  EXPECT_TRUE(coupler.step(std::vector{gas_state(n, 1), solid_state(n, 1)})[0].write_checkpoint);
  coupler.request_stop("stopped on request");
  const auto answers = coupler.step(std::vector{gas_state(n, 2), solid_state(n, 2)});
  EXPECT_FALSE(answers[0].write_checkpoint);
  EXPECT_TRUE(answers[1].stop);
  EXPECT_EQ(answers[1].stop_reason, "stopped on request");
  EXPECT_TRUE(coupler.finished());
}

TEST(Coupler, SeveralSolidsInOneGasAreIndependentOfEachOther) {
  const auto side = [](const std::string& name, double x, double normal) {
    return wire::InterfaceInfo{
        .name = name, .dimension = 2, .x = vertical_line(n, x), .n = everywhere(n, normal, 0)};
  };
  const std::vector<wire::Hello> hellos{fluid_hello({side("a", 0, 1), side("b", 1, -1)}),
                                        solid_hello("a", side("a", 0, 1)),
                                        solid_hello("b", side("b", 1, -1))};
  Coupler coupler(until(1), hellos);
  auto at_b = gas_state(n, 0, "b");
  at_b.x = vertical_line(n, 1);
  at_b.p.assign(n, 1.5);
  auto b = solid_state(n, 0, "b");
  b.x = at_b.x;
  b.proposed_dt = 0.02;
  const auto answers = coupler.step(std::vector{gas_state(n, 0, "a"), at_b, solid_state(n, 0, "a"), b});
  ASSERT_EQ(answers.size(), 4U);
  EXPECT_EQ(answers[0].v_n, std::vector<double>(n, 0.0));
  EXPECT_EQ(answers[3].to, "b");
  EXPECT_EQ(answers[3].n, everywhere(n, -1, 0));
  EXPECT_GT(answers[2].v[0], 0.0);  // the gas pushes the right solid to the right
  EXPECT_EQ(coupler.next().limited_by, "b");
  EXPECT_EQ(coupler.points(), 2 * n);
  EXPECT_EQ(coupler.profiles()[1].p_predicted, std::vector<double>(n, 1.5));
}

TEST(Coupler, ABodyWithoutMassMovesWithTheGasThroughTheModalResponse) {
  Coupler coupler(until(1), piston_hellos(n));
  for (std::uint64_t k = 0; k < 4; ++k) {
    auto gas = gas_state(n, k);
    gas.v = everywhere(n, 0.3, 0);
    auto piston = solid_state(n, k);
    piston.w.clear();
    piston.Z.clear();
    piston.modal = one_mode(0, 0, std::vector<double>(n, 1.0));
    const auto answers = coupler.step(std::vector{gas, piston});
    const double expected = k == 0 ? 0.0 : 0.3;
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(answers[1].v_n[i], expected, 1e-15);
  }
}

TEST(Coupler, WhoWatchesSeesFewPointsBothEndsAndTheExtremesOfAll) {
  constexpr std::size_t many = 1000;
  Coupler coupler(until(1), piston_hellos(many));
  auto gas = gas_state(many, 0);
  gas.p.assign(many, 1.2);
  gas.p[many / 3] = 9;
  auto solid = solid_state(many, 0);
  solid.w = everywhere(many, 0.2, 0.3);  // the normal of the interface is (1, 0): 0.3 is tangential
  solid.w[many + many / 2] = -0.7;
  coupler.step(std::vector{gas, solid});
  const wire::Telemetry::Interface shown = coupler.profiles().front();
  const std::size_t count = shown.s.size();
  EXPECT_LE(count, 256U);
  EXPECT_EQ(shown.x.size(), 2 * count);
  EXPECT_EQ(shown.p_predicted_solid.size(), count);
  EXPECT_EQ(shown.w_tangential.size(), count);
  EXPECT_NEAR(shown.w_tangential.front(), 0.3, 1e-12);
  EXPECT_NEAR(shown.shear, 0.7, 1e-12) << "a peak between the points shown counts";
  EXPECT_EQ(shown.x_start, shown.x);
  EXPECT_EQ(shown.traction_scale, 9.0);
  EXPECT_EQ(shown.s.front(), 0.0);
  EXPECT_EQ(shown.x.front(), gas.x.front());
  EXPECT_EQ(shown.x.back(), gas.x.back());
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_GE(shown.p_projected[k], shown.p_min);
    EXPECT_LE(shown.p_projected[k], shown.p_max);
    EXPECT_GE(shown.v_projected[k], shown.v_min);
    EXPECT_LE(shown.v_projected[k], shown.v_max);
  }
  EXPECT_GT(shown.p_max, 2 * shown.p_min) << "a peak between the points shown counts";
}

TEST(Coupler, NumbersThatAreNotFiniteAreNamed) {
  auto gas = gas_state(n, 0);
  gas.p[2] = std::nan("");
  std::string message = failure<Diverged>(gas, solid_state(n, 0));
  for (const char* part : {"step 0", "\"fluid\"", "\"solid\"", "point 2", "pressure"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  }
  auto solid = solid_state(n, 0);
  solid.w[n + 3] = std::numeric_limits<double>::infinity();
  message = failure<Diverged>(gas_state(n, 0), solid);
  EXPECT_NE(message.find("point 3 at (0, 1): the traction is inf"), std::string::npos) << message;
  EXPECT_NE(message.find("try a smaller time.cfl"), std::string::npos) << message;
  solid = solid_state(n, 0);
  solid.Z[1] = std::nan("");
  message = failure<Diverged>(gas_state(n, 0), solid);
  for (const char* part :
       {"the impedance matrix is nan: the solid is no longer hyperbolic", "try a smaller time.cfl"})
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  solid = solid_state(n, 0);
  solid.Z[1] = -1;
  EXPECT_NE(failure<Diverged>(gas_state(n, 0), solid).find("hyperbolic"), std::string::npos);
}

TEST(Coupler, MessagesThatDoNotFitAreNamed) {
  auto solid = solid_state(n, 0);
  solid.w.pop_back();
  EXPECT_NE(failure<PeerLost>(gas_state(n, 0), solid).find("the traction"), std::string::npos);
  EXPECT_NE(failure<PeerLost>(gas_state(n, 7), solid_state(n, 0)).find("step 0 from \"fluid\""),
            std::string::npos);
}

/// Gas at rest with the speed of sound 1, and a solid much heavier, which begins with the velocity `v`.
std::vector<wire::PredictedInterface> start_with(double v) {
  auto gas = gas_state(n, 0);
  auto solid = solid_state(n, 0);
  gas.rho.assign(n, 1.0);
  gas.gamma.assign(n, 1.4);
  gas.proposed_dt = 0.01;
  solid.proposed_dt = 0.02;
  solid.v = everywhere(n, v, 0);
  for (double& z : solid.Z) z *= 1e9;
  solid.z_p *= 1e9;
  return {gas, solid};
}

TEST(Coupler, NoSideGoesFurtherInTheFirstStepThanWavesWould) {
  for (const bool multirate : {false, true}) {
    auto options = until(1);
    options.multirate = multirate;
    for (const double v : {1.5, -7.0, 100.0, -100.0}) {
      Coupler coupler(options, piston_hellos(n));
      const auto predicted = start_with(v);
      const auto answers = coupler.step(predicted);
      const double way = std::abs(answers[0].x_next[1] - predicted[0].x[1]);
      EXPECT_LE(way, predicted[0].proposed_dt * (1 + 1e-12)) << v;
      EXPECT_GT(way, 0.9 * predicted[0].proposed_dt) << v;
    }
  }
}

TEST(Coupler, WhereNoSideIsFasterThanSoundTheFirstStepIsThatOfTheGas) {
  const auto first_step = [](double v) {
    Coupler coupler(until(1), piston_hellos(n));
    return coupler.step(start_with(v))[0].dt_next;
  };
  EXPECT_EQ(first_step(0.99), first_step(0));
  EXPECT_EQ(first_step(-0.5), first_step(0));
  EXPECT_LT(first_step(1.1), first_step(0));
}

}  // namespace
}  // namespace fsi::coupler
