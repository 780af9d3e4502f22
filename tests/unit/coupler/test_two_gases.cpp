/// A solid between two gases: two interfaces, one solid.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"
#include "coupler/coupler.hpp"
#include "exchanges.hpp"
#include "messages.hpp"

namespace fsi::coupler {
namespace {

using namespace testing;

constexpr double thickness = 0.2;

struct Face {
  std::string gas;
  double x, outwards;
  std::string name() const { return "wall." + gas; }
};

const Face faces[] = {{"left", 0, -1}, {"right", thickness, 1}};

std::vector<wire::Hello> hellos() {
  std::vector<wire::Hello> all;
  wire::Hello wall = solid_hello("wall", {});
  wall.interfaces.clear();
  for (const Face& face : faces) {
    wire::Hello gas =
        fluid_hello({{.name = face.name(), .dimension = 2, .x = vertical_line(n, face.x), .n = {}}});
    gas.name = face.gas;
    all.push_back(gas);
    wall.interfaces.push_back({.name = face.name(),
                               .dimension = 2,
                               .x = vertical_line(n, face.x),
                               .n = everywhere(n, face.outwards, 0)});
  }
  all.push_back(wall);
  return all;
}

wire::PredictedInterface gas_at(const Face& face, std::uint64_t step, double p, double z) {
  wire::PredictedInterface gas = gas_state(n, step, face.name());
  gas.from = face.gas;
  gas.x = vertical_line(n, face.x);
  gas.p.assign(n, p);
  gas.z_f.assign(n, z);
  return gas;
}

wire::PredictedInterface wall_at(const Face& face, std::uint64_t step) {
  wire::PredictedInterface wall = solid_state(n, step, "wall");
  wall.interface = face.name();
  wall.x = vertical_line(n, face.x);
  return wall;
}

/// The wall as a body that moves along x.
wire::PredictedInterface body_at(const Face& face, std::uint64_t step, const BdfBody& body) {
  wire::PredictedInterface wall = wall_at(face, step);
  wall.w.clear();
  wall.Z.clear();
  const double S = body.dt > 0 ? body.S() : 1, g = body.dt > 0 ? body.g() : 0;
  wall.v = everywhere(n, body.now, 0);
  wall.modal = one_mode(S, g, std::vector<double>(n, face.outwards), body.now);
  return wall;
}

TEST(TwoGases, BothAnswersToItsMotionAreInTheEquationOfABody) {
  const double z_left = 1.5, z_right = 0.4, push = 0.01;
  for (const double mass : {0.0, 1e-3, 1.0, 1e3}) {
    Coupler coupler(until(1), hellos());
    BdfBody body{.mass = mass};
    for (std::uint64_t step = 0; step < 4; ++step) {
      const auto answers = coupler.step(
          std::vector{gas_at(faces[0], step, 1 + push, z_left), gas_at(faces[1], step, 1, z_right),
                      body_at(faces[0], step, body), body_at(faces[1], step, body)});
      ASSERT_EQ(answers.size(), 4U);
      double q_dot = 0;
      if (step > 0) q_dot = (body.g() + body.dt * push) / (body.S() + body.dt * (z_left + z_right));
      for (const wire::ProjectedInterface& answer : answers) {
        const double outwards = answer.interface == faces[0].name() ? -1 : 1;
        for (const double v_n : answer.v_n) EXPECT_NEAR(v_n, outwards * q_dot, 1e-15) << mass << " " << step;
      }
      EXPECT_EQ(answers[1].q_dot, answers[3].q_dot);
      EXPECT_NEAR(answers[0].w_n[0], -push + z_left * q_dot,
                  1e-15);  // the gas to the left follows a wall that flees
      EXPECT_NEAR(answers[2].w_n[0], -z_right * q_dot, 1e-15);  // that to the right is pressed
      body.take(q_dot, coupler.next().plan.dt);
    }
  }
}

TEST(TwoGases, EachSideOfADeformableSolidIsProjectedWithItsOwnGas) {
  Coupler coupler(until(1), hellos());
  const auto both = coupler.step(std::vector{gas_at(faces[0], 0, 1.3, 2), gas_at(faces[1], 0, 0.9, 0.5),
                                             wall_at(faces[0], 0), wall_at(faces[1], 0)});
  EXPECT_EQ(both[0].to, "left");
  EXPECT_EQ(both[1].to, "wall");
  EXPECT_EQ(both[2].to, "right");
  EXPECT_EQ(both[3].to, "wall");
  // paper eq. (28) with z_p = 2: v_n = w_n of the difference of the tractions
  EXPECT_NEAR(both[0].v_n[0], -0.3 / (2 + 2), 1e-15);
  EXPECT_NEAR(both[2].v_n[0], 0.1 / (2 + 0.5), 1e-15);
  EXPECT_EQ(both[1].interface, "wall.left");
  EXPECT_EQ(both[3].interface, "wall.right");
}

TEST(TwoGases, TheStepIsThatOfTheFasterGasAndOnlyTheSolidTakesSubsteps) {
  CouplerOptions options = until(1);
  options.multirate = true;
  Coupler coupler(options, hellos());
  std::vector states{gas_at(faces[0], 0, 1, 1), gas_at(faces[1], 0, 1, 1), wall_at(faces[0], 0),
                     wall_at(faces[1], 0)};
  states[1].proposed_dt = 0.05;
  states[2].proposed_dt = states[3].proposed_dt = 0.01;
  const auto answers = coupler.step(states);
  EXPECT_EQ(coupler.next().limited_by, "right");
  EXPECT_NEAR(coupler.next().plan.dt, 0.05, 1e-12);
  EXPECT_EQ(answers[0].substeps_next, 1);
  EXPECT_EQ(answers[2].substeps_next, 1);
  EXPECT_EQ(answers[1].substeps_next, 5);
  EXPECT_EQ(answers[3].substeps_next, 5);
}

TEST(TwoGases, ABodyThatHasOtherModesAtItsOtherInterfaceIsRefused) {
  Coupler coupler(until(1), hellos());
  try {
    coupler.step(std::vector{gas_at(faces[0], 0, 1, 1), gas_at(faces[1], 0, 1, 1), body_at(faces[0], 0, {}),
                             wall_at(faces[1], 0)});
    FAIL();
  } catch (const PeerLost& lost) {
    EXPECT_NE(std::string(lost.what()).find("wall.right"), std::string::npos) << lost.what();
  }
}

TEST(TwoGases, AnInterfaceThatBothGasesClaimIsRefused) {
  std::vector<wire::Hello> all = hellos();
  all[1].interfaces[0].name = faces[0].name();
  EXPECT_THROW(Coupler(until(1), all), PeerLost);
}

}  // namespace
}  // namespace fsi::coupler
