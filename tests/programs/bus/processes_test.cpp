/// Three processes at the bus: they exchange, and when one is
/// killed, stopped or watched the others know what to do.

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <memory>
#include <random>

#include "common/bus/configuration.hpp"
#include "common/bus/sessions/listener.hpp"
#include "tests/programs/bus/trio.hpp"

namespace fsi::bus::test {
namespace {

class Exchanging : public testing::TestWithParam<std::size_t> {};

TEST_P(Exchanging, ThousandStepsArriveCompleteAndInOrder) {
  Trio run(protected_options(own_run()), 1000, GetParam());
  for (Process* process : {&run.fluid, &run.beam, &run.coupler})
    EXPECT_EQ(process->end(), 0) << process->hear();
}
INSTANTIATE_TEST_SUITE_P(Points, Exchanging, testing::Values(100, 1000, 10000));

/// Each program in turn is killed; the two others must name it.
class Killing : public testing::TestWithParam<const char*> {};

/// They see its death, and do not wait until it has been silent for too long.
TEST_P(Killing, NamesTheVictimAndEndsTheOthersWithCode4) {
  Trio run(protected_options(own_run()));
  run.wait_until_begun();
  const std::string victim_name = GetParam();
  Process& victim = victim_name == "fluid" ? run.fluid : victim_name == "beam" ? run.beam : run.coupler;
  victim.send(SIGKILL);
  for (Process* process : {&run.fluid, &run.beam, &run.coupler}) {
    if (process == &victim) continue;
    EXPECT_EQ(process->end(), 4);
    const std::string reason = process->hear();
    EXPECT_TRUE(says(reason, victim_name)) << reason;
    EXPECT_FALSE(says(reason, "time.peer_timeout")) << reason;
    EXPECT_TRUE(says(reason, fmt::format("pid {}", victim.pid()))) << reason;
  }
}
INSTANTIATE_TEST_SUITE_P(Programs, Killing, testing::Values("fluid", "beam", "coupler"));

TEST(Stopping, ShortStopOnlyDelaysTheRun) {
  BusOptions impatient = protected_options(own_run());
  impatient.step_timeout_s = 0.5;  // who is stopped computes nothing
  impatient.peer_timeout_s = fsi::test::watchdog_s;
  Trio run(impatient);
  run.wait_until_begun();
  run.beam.send(SIGSTOP);
  let_pass(1.5);  // five leases
  run.beam.send(SIGCONT);
  run.end_after(1000);
}

TEST(Stopping, LongStopIsASilentPeer) {
  BusOptions impatient = protected_options(own_run());
  impatient.peer_timeout_s = 1;
  Trio run(impatient);
  run.wait_until_begun();
  run.beam.send(SIGSTOP);
  for (Process* process : {&run.fluid, &run.coupler}) {
    EXPECT_EQ(process->end(), 4);
    const std::string reason = process->hear();
    EXPECT_TRUE(says(reason, "solid 'beam'") && says(reason, "silent for 1 s")) << reason;
  }
}

/// Its other threads live on and renew the lease: only what its first thread does tells.
TEST(Hanging, SolverThatSleepsWithoutEndIsNamed) {
  BusOptions impatient = protected_options(own_run());
  impatient.peer_timeout_s = 1;
  Process fluid([=](const auto& say) { solve(impatient, gas(), endless, 3, say); });
  Process beam([=](const auto&) {
    SolverSession session(impatient, solid());
    session.publish(predicted(0, 3));
    session.receive("beam", 0);
    while (true) pause();
  });
  const Shared shared;
  Process coupler([&](const auto& say) { couple(impatient, shared, endless, 3, say); });
  EXPECT_EQ(fluid.hear(), "begun");
  EXPECT_EQ(coupler.hear(), "begun");
  for (Process* process : {&fluid, &coupler}) {
    EXPECT_EQ(process->end(), 4);
    const std::string reason = process->hear();
    EXPECT_TRUE(says(reason, "solid 'beam'") && says(reason, "hangs")) << reason;
  }
}

/// It neither sleeps nor ends its step, and its other threads renew the lease.
TEST(Hanging, SolverThatComputesWithoutEndIsNamed) {
  BusOptions impatient = protected_options(own_run());
  impatient.step_timeout_s = 0.5;
  Process fluid([=](const auto& say) { solve(impatient, gas(), endless, 3, say); });
  Process beam([=](const auto&) {
    SolverSession session(impatient, solid());
    session.publish(predicted(0, 3));
    session.receive("beam", 0);
    compute(1e9);
  });
  const Shared shared;
  Process coupler([&](const auto& say) { couple(impatient, shared, endless, 3, say); });
  for (Process* process : {&fluid, &coupler}) {
    EXPECT_EQ(process->hear(), "begun");
    EXPECT_EQ(process->end(), 4);
    const std::string reason = process->hear();
    EXPECT_TRUE(says(reason, "solid 'beam'") && says(reason, "has not finished step 1")) << reason;
  }
}

TEST(Hanging, CouplerThatComputesWithoutEndIsNamed) {
  BusOptions impatient = protected_options(own_run());
  impatient.step_timeout_s = 0.5;
  Process fluid([=](const auto& say) { solve(impatient, gas(), endless, 3, say); });
  Process coupler([=](const auto&) {
    CouplerSession session(impatient, {{.role = "fluid", .name = "fluid"}}, "one case");
    session.gather(0);
    compute(1e9);
  });
  EXPECT_EQ(fluid.end(), 4);
  const std::string reason = fluid.hear();
  EXPECT_TRUE(says(reason, "coupler") && says(reason, "computes without end")) << reason;
}

TEST(Hanging, StepMayTakeTwentyTimesAsLongAsTheLongestBefore) {
  BusOptions impatient = protected_options(own_run());
  impatient.step_timeout_s = 0.4;
  Process fluid([=](const auto&) {
    SolverSession session(impatient, gas());
    for (std::uint64_t step = 0; step < 2; ++step) {
      session.publish(predicted(step, 3));
      session.receive("beam", step);
      compute(step == 0 ? 0.3 : 1.2);
    }
    session.publish(predicted(2, 3));
    session.receive("beam", 2);
  });
  Process coupler([=](const auto&) {
    CouplerSession session(impatient, {{.role = "fluid", .name = "fluid"}}, "one case");
    for (std::uint64_t step = 0; step < 3; ++step) {
      session.gather(step);
      session.scatter(std::vector{projected("fluid", step)});
    }
  });
  EXPECT_EQ(coupler.end(), 0) << coupler.hear();
  EXPECT_EQ(fluid.end(), 0) << fluid.hear();
}

TEST(Watching, FrozenMonitorDoesNotHoldUpTheRun) {
  const std::string run_id = own_run();
  Process monitor([=](const auto& say) {
    Listener listener(run_id, test_key);
    while (listener.wait(1).empty()) {
    }
    say("listening");
    while (true) listener.wait(1);
  });
  Trio run(protected_options(run_id), endless, 1000);
  ASSERT_EQ(monitor.hear(), "listening");
  monitor.send(SIGSTOP);
  run.end_after(2000);
}

TEST(SideBySide, RunsInOneDomainDoNotSeeEachOther) {
  const std::string one = own_run();
  std::string other;
  for (int k = 0; domain_of(other) != domain_of(one) || other.empty(); ++k)
    other = fmt::format("{}/{}", one, k);
  Trio first(protected_options(one), 500), second(protected_options(other), 500);
  Process lonely(
      [=](const auto&) { EXPECT_THROW(send_control(one + ".", test_key, Request::stop, 0.3), PeerLost); });
  for (Process* process :
       {&first.fluid, &first.beam, &first.coupler, &second.fluid, &second.beam, &second.coupler}) {
    EXPECT_EQ(process->end(), 0) << process->hear();
  }
  EXPECT_EQ(lonely.end(), 0);
}

TEST(Interrupting, WaitEndsWithTheSignalsOwnCodeAndTheOthersLearnIt) {
  BusOptions interrupted = protected_options(own_run());
  interrupted.throw_if_interrupted = [watch = fsi::test::Stopwatch()] {
    if (watch.seconds() > 1) throw Failure(ExitCode::terminated, "ended on request (SIGTERM)");
  };
  Process fluid(
      [=](const auto&) { SolverSession(protected_options(interrupted.run), gas()).receive("beam", 0); });
  Process coupler([=](const auto&) {
    CouplerSession session(interrupted, {{.role = "fluid", .name = "fluid"}}, "one case");
    try {
      session.gather(0);
    } catch (const Failure& failure) {
      session.abort(failure);
      throw;
    }
  });
  EXPECT_EQ(coupler.end(), 143);
  EXPECT_EQ(fluid.end(), 143);
  EXPECT_EQ(fluid.hear(), "coupler: ended on request (SIGTERM)");
}

/// Sends damaged packets that begin like RTPS to every port of a domain, until it is killed.
void send_damaged_packets(std::uint32_t domain, const Process::Say& say) {
  constexpr std::uint32_t first_port = 7400, ports_per_domain = 250, used_ports = 80;
  const int out = socket(AF_INET, SOCK_DGRAM, 0);
  std::mt19937 random(7);
  std::array<unsigned char, 512> packet{};
  for (std::uint32_t k = 0;; ++k) {
    for (unsigned char& byte : packet) byte = static_cast<unsigned char>(random());
    const std::array<unsigned char, 8> header = {'R', 'T', 'P', 'S', 2, 1, 1, 16};
    std::ranges::copy(header, packet.begin());
    constexpr std::array<unsigned char, 6> kinds = {0x06, 0x07, 0x08,
                                                    0x09, 0x15, 0x16};  // ACKNACK ... DATA_FRAG
    packet[20] = kinds.at(random() % kinds.size());
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(static_cast<std::uint16_t>(first_port + ports_per_domain * domain + k % used_ports));
    sendto(out, packet.data(), 24 + random() % 400, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
    if (k == used_ports) say("sending");
    if (k % 100 == 0) let_pass(1e-3);
  }
}

TEST(Damaged, PacketsFromStrangersNeitherEndNorFalsifyTheRun) {
  const std::string run_id = own_run();
  Process stranger([=](const auto& say) { send_damaged_packets(domain_of(run_id), say); });
  ASSERT_EQ(stranger.hear(), "sending");
  Trio run(protected_options(run_id), 2000, 1000);
  for (Process* process : {&run.fluid, &run.beam, &run.coupler})
    EXPECT_EQ(process->end(), 0) << process->hear();
}

/// Programs that join a run one after the other, until one finds no place; at most so many.
struct Crowd {
  std::vector<std::unique_ptr<Process>> programs;
  std::string word = "here";  ///< of the last one

  Crowd(std::size_t most, const std::string& settings) {
    const std::string run = own_run();
    while (word == "here" && programs.size() < most) {
      programs.push_back(std::make_unique<Process>([=](const auto& say) {
        setenv(more_settings, settings.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): one thread so far
        const Listener listener(run);
        say("here");
        pause();
      }));
      word = programs.back()->hear();
    }
  }
};

TEST(Crowding, FullDomainIsSaidInWords) {
  const Crowd crowd(30,
                    "<CycloneDDS><Domain><Discovery><MaxAutoParticipantIndex>19</MaxAutoParticipantIndex>"
                    "</Discovery></Domain></CycloneDDS>");
  EXPECT_GT(crowd.programs.size(), 10U);  // others may use ports of this domain, but not half of them
  EXPECT_TRUE(says(crowd.word, "is full")) << crowd.word;
  EXPECT_TRUE(says(crowd.word, "--hosts")) << crowd.word;
  EXPECT_EQ(crowd.programs.back()->end(), 4);
}

TEST(Crowding, ThereIsRoomForMoreThanThirtyTwoPrograms) {
  const Crowd crowd(36, "");
  EXPECT_EQ(crowd.word, "here");
}

}  // namespace
}  // namespace fsi::bus::test
