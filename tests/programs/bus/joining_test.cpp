/// How long the coupler waits for programs that have not joined: what they compute does not count.

#include "tests/programs/bus/processes.hpp"
#include "tests/unit/bus/seats.hpp"

namespace fsi::bus::test {
namespace {

/// A solver that joins and sends its first state.
void join(const BusOptions& options, const wire::Hello& self) {
  SolverSession session(options, self);
  session.publish(predicted(0));
}

/// A coupler that waits for the solid 'beam', whose process it knows, for so long.
Process coupler_of(const Process& beam, const std::string& run, double patience_s) {
  BusOptions own = options(run);
  own.hello_timeout_s = patience_s;
  own.pids = {{"beam", beam.pid()}};
  return Process([own](const auto&) {
    CouplerSession session(own, {{.role = "solid", .name = "beam"}}, "one case");
    session.gather(0);
  });
}

TEST(Joining, ProgramThatInitialisesForLongerThanTheLimitIsWaitedFor) {
  const std::string run = own_run();
  Process beam([run](const auto&) {
    compute(3);
    join(options(run), solid());
  });
  Process coupler = coupler_of(beam, run, 1);
  EXPECT_EQ(coupler.end(), 0) << coupler.hear();
  EXPECT_EQ(beam.end(), 0) << beam.hear();
}

TEST(Joining, ProgramThatDoesNothingIsMissingAfterTheLimit) {
  const Process beam([](const auto&) {
    while (true) pause();
  });
  Process coupler = coupler_of(beam, own_run(), 0.5);
  EXPECT_EQ(coupler.end(), 4);
  const std::string reason = coupler.hear();
  EXPECT_TRUE(says(reason, "(time.join_timeout) solid 'beam' did not join")) << reason;
}

TEST(Joining, ProgramThatEndsBeforeItJoinedIsNamedAtOnce) {
  const Process beam([](const auto&) {});
  Process coupler = coupler_of(beam, own_run(), 1e6);
  EXPECT_EQ(coupler.end(), 4);
  EXPECT_EQ(coupler.hear(), fmt::format("solid 'beam' (pid {}) ended before it joined the run", beam.pid()));
}

TEST(Joining, WhoHasJoinedWaitsAsLongAsTheCouplerDoes) {
  const std::string run = own_run();
  BusOptions impatient = options(run);
  impatient.hello_timeout_s = 4;  // to hear the coupler
  Process fluid([impatient](const auto&) { join(impatient, gas()); });
  Process coupler([run](const auto&) {
    CouplerSession session(options(run), gas_and_solid(), "one case");
    session.gather(0);
  });
  Process beam([run](const auto&) {
    let_pass(8);
    join(options(run), solid());
  });
  for (Process* process : {&fluid, &beam, &coupler}) EXPECT_EQ(process->end(), 0) << process->hear();
}

}  // namespace
}  // namespace fsi::bus::test
