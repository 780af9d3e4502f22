/// One sample out and one in, per step: only data of this run and step counts.

#include <thread>

#include "common/bus/convert.hpp"
#include "common/bus/dds.hpp"
#include "common/bus/sessions/link.hpp"
#include "common/bus/sessions/listener.hpp"
#include "common/bus/sessions/solo_session.hpp"
#include "tests/unit/bus/seats.hpp"

namespace fsi::bus::test {
namespace {

const std::vector<Expected> only_gas = {{.role = "fluid", .name = "fluid"}};

TEST(Exchange, EverySolverGetsTheAnswerToItsOwnStep) {
  const std::string run = own_run();
  constexpr std::uint64_t steps = 50;
  const auto solver = [&](wire::Hello self) {
    SolverSession session(options(run), std::move(self));
    for (std::uint64_t step = 0; step < steps; ++step) {
      session.publish(predicted(step));
      const auto& answer = session.receive("beam", step);
      ASSERT_EQ(answer.step, step);
      ASSERT_EQ(answer.v_n, std::vector<double>(3, -static_cast<double>(step)));
    }
    EXPECT_EQ(session.statistics().messages, 2 * steps);
    EXPECT_EQ(session.statistics().stale, 0U);
    EXPECT_GT(session.statistics().round_trip_p50_us, 0);
  };
  auto fluid = in_thread([&] { solver(gas()); });
  auto beam = in_thread([&] { solver(solid()); });
  CouplerSession coupler(options(run), gas_and_solid(), "one case");
  for (std::uint64_t step = 0; step < steps; ++step) {
    const auto states = coupler.gather(step);
    ASSERT_EQ(states.size(), 2U);
    EXPECT_EQ(states[0].from, "fluid");
    EXPECT_EQ(states[1].from, "beam");
    EXPECT_EQ(states[1].v, std::vector<double>(6, static_cast<double>(step)));
    coupler.scatter(std::vector{projected("fluid", step), projected("beam", step)});
  }
  EXPECT_EQ(fluid.get().reason, "");
  EXPECT_EQ(beam.get().reason, "");
}

TEST(Exchange, GasBetweenTwoSolidsKeepsTheirInterfacesApart) {
  const std::string run = own_run();
  wire::Hello between = gas();
  between.interfaces.push_back(
      {.name = "plate / 2", .dimension = 2, .x = std::vector<double>(8, 1.0), .n = {}});
  auto fluid = in_thread([&] {
    SolverSession session(options(run), between);
    for (std::uint64_t step = 0; step < 20; ++step) {
      session.publish(predicted(step));
      wire::PredictedInterface other = predicted(step, 4);
      other.interface = "plate / 2";
      session.publish(other);
      EXPECT_EQ(session.receive("plate / 2", step).v_n.size(), 4U);
      EXPECT_EQ(session.receive("beam", step).v_n.size(), 3U);
    }
  });
  CouplerSession coupler(options(run), only_gas, "one case");
  for (std::uint64_t step = 0; step < 20; ++step) {
    const auto states = coupler.gather(step);
    ASSERT_EQ(states.size(), 2U);
    EXPECT_EQ(states[1].interface, "plate / 2");
    wire::ProjectedInterface other = projected("fluid", step, 4);
    other.interface = "plate / 2";
    coupler.scatter(std::vector{projected("fluid", step), other});
  }
  EXPECT_EQ(fluid.get().reason, "");
}

TEST(Exchange, OlderStepsAndOtherRunsAreNeverAccepted) {
  const std::string run = own_run();
  auto fluid = in_thread([&] {
    SolverSession session(options(run), gas());
    session.publish(predicted(7));
    EXPECT_EQ(session.receive("beam", 7).v_n[0], -7);
    EXPECT_EQ(session.statistics().stale, 3U);
  });
  CouplerSession coupler(options(run), only_gas, "one case");
  EXPECT_EQ(coupler.gather(7)[0].step, 7U);

  const Entity participant = create_participant(run);
  Writer<amp_fsi_ProjectedInterface> ghost(participant, topic_name("projected", {"fluid", "beam"}),
                                           Delivery::lock_step);
  while (ghost.matched() == 0) std::this_thread::yield();
  wire::ProjectedInterface stale = projected("fluid", 7);
  stale.run = "an older run";
  ghost.write(borrow(stale));
  stale = projected("beam", 7);
  stale.run = run;
  ghost.write(borrow(stale));
  EXPECT_TRUE(ghost.arrived(5));
  coupler.scatter(std::vector{projected("fluid", 6)});
  coupler.scatter(std::vector{projected("fluid", 7)});
  EXPECT_EQ(fluid.get().reason, "");
}

TEST(Exchange, TwoDifferentStatesOfOneStepAreNamed) {
  const std::string run = own_run();
  auto fluid = in_thread([&] { SolverSession(options(run), gas()).receive("beam", 0); });
  auto beam = in_thread([&] {
    SolverSession session(options(run), solid());
    const Entity participant = create_participant(run);
    Writer<amp_fsi_PredictedInterface> ghost(participant, topic_name("predicted", {"beam", "beam"}),
                                             Delivery::lock_step);
    while (ghost.matched() == 0) std::this_thread::yield();
    wire::PredictedInterface forged = predicted(0);
    forged.run = run;
    forged.from = "beam";
    ghost.write(borrow(forged));
    EXPECT_TRUE(ghost.arrived(5));
    wire::PredictedInterface own = predicted(0);
    own.v.front() = 1e-300;
    session.publish(own);
    session.receive("beam", 0);
  });
  auto coupler = in_thread([&] { CouplerSession(options(run), gas_and_solid(), "one case").gather(0); });
  EXPECT_TRUE(says(coupler.get().reason, "two different states of step 0 came from beam"));
  EXPECT_EQ(fluid.get().code, ExitCode::peer_lost);
  EXPECT_EQ(beam.get().code, ExitCode::peer_lost);
}

TEST(Exchange, WhoRunsAheadIsNamed) {
  const std::string run = own_run();
  auto fluid = in_thread([&] {
    SolverSession session(options(run), gas());
    session.publish(predicted(5));
    session.receive("beam", 5);
  });
  auto coupler = in_thread([&] {
    CouplerSession session(options(run), only_gas, "one case");
    try {
      session.gather(4);
    } catch (const Failure& failure) {
      session.abort(failure);
      throw;
    }
  });
  EXPECT_TRUE(says(coupler.get().reason, "fluid sent step 5 while the coupler waited for step 4"));
  EXPECT_EQ(fluid.get().code, ExitCode::peer_lost);
}

TEST(Exchange, ArrayOfWrongLengthIsNamedAndNeverIndexed) {
  const std::string run = own_run();
  auto fluid = in_thread([&] {
    SolverSession session(options(run), gas());
    wire::PredictedInterface bad = predicted(0);
    bad.p.assign(100000, 1.0);
    session.publish(bad);
    session.receive("beam", 0);
  });
  auto coupler = in_thread([&] { CouplerSession(options(run), only_gas, "one case").gather(0); });
  EXPECT_TRUE(says(coupler.get().reason, "fluid sent 100000 values of p instead of 3 for interface 'beam'"));
  EXPECT_EQ(fluid.get().code, ExitCode::peer_lost);
}

TEST(Exchange, AbortReachesEverybodyWithItsCodeAndReason) {
  const std::string run = own_run();
  auto fluid = in_thread([&] {
    SolverSession session(options(run), gas());
    session.abort(Diverged("det F = -0.02", {.step = 412, .t = 1.37, .grid = "beam", .point = {14, 3}}));
  });
  auto beam = in_thread([&] { SolverSession(options(run), solid()).receive("beam", 0); });
  auto coupler = in_thread([&] { CouplerSession(options(run), gas_and_solid(), "one case").gather(0); });
  fluid.get();
  for (const End& end : {beam.get(), coupler.get()}) {
    EXPECT_EQ(end.code, ExitCode::diverged);
    EXPECT_EQ(end.reason, "fluid: step 412, t = 1.37, grid \"beam\", point (14, 3): det F = -0.02");
    EXPECT_EQ(end.place.point, (std::vector{14, 3}));
    EXPECT_EQ(end.origin, "fluid");
  }
}

TEST(Exchange, SolverThatLeavesWithoutAWordIsNamed) {
  const std::string run = own_run();
  auto fluid = in_thread([&] { const SolverSession session(options(run), gas()); });
  auto coupler = in_thread([&] { CouplerSession(options(run), only_gas, "one case").gather(0); });
  EXPECT_EQ(fluid.get().reason, "");
  const End end = coupler.get();
  EXPECT_EQ(end.code, ExitCode::peer_lost);
  EXPECT_TRUE(says(end.reason, "fluid") && says(end.reason, "has left the run")) << end.reason;
}

TEST(Exchange, SolverThatNeverFinishesItsStepIsNamed) {
  const std::string run = own_run();
  BusOptions impatient = options(run);
  impatient.step_timeout_s = 0.03;  // on the clock ten times as long
  auto fluid = in_thread([&] { SolverSession(options(run), gas()).receive("beam", 0); });
  auto coupler = in_thread([&] { CouplerSession(impatient, only_gas, "one case").gather(0); });
  const std::string reason = coupler.get().reason;
  EXPECT_TRUE(says(reason, "fluid") && says(reason, "lives but has not finished step 0")) << reason;
  EXPECT_EQ(fluid.get().code, ExitCode::peer_lost);
}

TEST(Exchange, RequestReachesTheCouplerAndEndsItsIdling) {
  const std::string run = own_run();
  SoloSession solo(options(run), "fluid", "fluid");
  auto outside = in_thread([&] { send_control(run, "", Request::pause, 20); });
  solo.idle(20);
  const auto requests = solo.controls();
  ASSERT_EQ(requests.size(), 1U);
  EXPECT_EQ(requests[0].command, "pause");
  EXPECT_TRUE(solo.controls().empty());
  EXPECT_EQ(outside.get().reason, "");
}

TEST(Exchange, RequestToNobodyFails) {
  EXPECT_THROW(send_control(own_run(), "", Request::stop, 0.2), PeerLost);
}

TEST(Exchange, WhoWaitsForARequestToArriveMayGiveUp) {
  struct GivenUp {};
  int asked = 0;
  const auto meanwhile = [&] {
    if (++asked == 2) throw GivenUp();
  };
  EXPECT_THROW(send_control(own_run(), "", Request::stop, 1e6, {}, meanwhile), GivenUp);
}

TEST(Exchange, ListenerHearsTheNewestTelemetryOfEveryProgram) {
  const std::string run = own_run();
  Listener listener(run);
  SoloSession one(options(run), "fluid", "fluid");
  SoloSession two(options(run), "solid", "beam");
  while (listener.programs() < 2) listener.wait(0.01);
  EXPECT_TRUE(one.telemetry_due());
  for (std::uint64_t step = 0; step < 100; ++step) {
    wire::Telemetry telemetry;
    telemetry.step = step;
    one.publish(telemetry);
    telemetry.step = 2 * step;
    two.publish(telemetry);
  }
  EXPECT_FALSE(one.telemetry_due());
  std::uint64_t newest_one = 0, newest_two = 0;
  while (newest_one < 99 || newest_two < 198) {
    for (const wire::Telemetry& heard : listener.wait(10))
      (heard.from == "fluid" ? newest_one : newest_two) = heard.step;
  }
  one.abort(Diverged("p < 0"));
  while (!listener.aborted()) listener.wait(10);
  EXPECT_EQ(listener.aborted().value_or(wire::Abort{}).reason(), "p < 0");
}

TEST(Exchange, ProgramThatWaitsKeepsSayingSoAndThatIsNoNews) {
  const std::string run = own_run();
  Listener listener(run);
  SoloSession one(options(run), "fluid", "fluid");
  while (listener.programs() < 1) listener.wait(0.01);
  wire::Telemetry telemetry;
  telemetry.state = "computing";
  telemetry.step = 7;
  one.publish(telemetry);
  std::optional<wire::Telemetry> last;
  for (int k = 0; k < 100 && (!last || last->state != "paused"); ++k) {
    one.idle(0.1);
    for (const wire::Telemetry& heard : listener.wait(0)) last = heard;
  }
  ASSERT_TRUE(last);
  EXPECT_EQ(last->state, "paused");
  EXPECT_EQ(last->step, 7U);
  EXPECT_EQ(last->pid, getpid());
  EXPECT_TRUE(one.telemetry_due()) << "what is repeated must not delay what is new";
}

}  // namespace
}  // namespace fsi::bus::test
