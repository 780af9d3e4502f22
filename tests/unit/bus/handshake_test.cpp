/// How programs find each other at the beginning of a run, and what they say when they do not.

#include <algorithm>

#include "common/bus/configuration.hpp"
#include "common/bus/convert.hpp"
#include "common/bus/dds.hpp"
#include "common/bus/sessions/link.hpp"
#include "tests/unit/bus/seats.hpp"
#include "tests/waiting.hpp"

namespace fsi::bus::test {
namespace {

using fsi::test::let_pass;

TEST(Handshake, CouplerHearsThoseWhoCameBeforeAndAfterIt) {
  const std::string run = own_run();
  auto early = in_thread([&] { const SolverSession session(options(run), gas(5)); });
  let_pass(0.3);
  auto late = in_thread([&] {
    let_pass(0.6);
    const SolverSession session(options(run), solid(7));
  });
  const CouplerSession coupler(options(run), gas_and_solid(), "one case");
  EXPECT_EQ(early.get().reason, "");
  EXPECT_EQ(late.get().reason, "");
  ASSERT_EQ(coupler.hellos().size(), 2U);
  EXPECT_EQ(coupler.hellos()[0].name, "fluid");
  EXPECT_EQ(coupler.hellos()[1].interfaces[0].x, std::vector<double>(14, 0.5));
  EXPECT_EQ(coupler.hellos()[1].pid, getpid());
}

TEST(Handshake, SolverOfAnotherCaseIsTurnedAwayByName) {
  const std::string run = own_run();
  auto fluid = in_thread([&] { const SolverSession session(options(run), gas()); });
  auto beam = in_thread([&] {
    wire::Hello hello = solid();
    hello.config_digest = "another case";
    const SolverSession session(options(run), hello);
  });
  auto coupler = in_thread([&] { const CouplerSession session(options(run), gas_and_solid(), "one case"); });
  for (const End& end : {coupler.get(), fluid.get(), beam.get()}) {
    EXPECT_EQ(end.code, ExitCode::peer_lost);
    EXPECT_TRUE(says(end.reason, "solid 'beam' read another case")) << end.reason;
  }
}

TEST(Handshake, SolverThatWouldGetOtherNumbersIsTurnedAwayByName) {
  const std::string run = own_run();
  const auto built = [&](const std::string& what) {
    BusOptions result = options(run);
    result.build = what;
    return result;
  };
  auto fluid = in_thread([&] { const SolverSession session(built("built for avx2"), gas()); });
  auto coupler = in_thread([&] {
    const CouplerSession session(built("built for sse2"), {{.role = "fluid", .name = "fluid"}}, "one case");
  });
  for (const End& end : {coupler.get(), fluid.get()}) {
    EXPECT_EQ(end.code, ExitCode::user_mistake);
    EXPECT_TRUE(says(end.reason, "is built for avx2, the coupler on")) << end.reason;
  }
}

TEST(Handshake, SolverOfAnotherProtocolIsTurnedAwayByName) {
  const std::string run = own_run();
  auto fluid = in_thread([&] {
    wire::Hello hello = gas();
    hello.protocol = wire::protocol_version + 1;
    const SolverSession session(options(run), hello);
  });
  auto coupler = in_thread(
      [&] { const CouplerSession session(options(run), {{.role = "fluid", .name = "fluid"}}, "one case"); });
  const End end = coupler.get();
  EXPECT_EQ(end.code, ExitCode::peer_lost);
  EXPECT_TRUE(says(end.reason, "protocol")) << end.reason;
  EXPECT_EQ(fluid.get().code, ExitCode::peer_lost);
}

TEST(Handshake, WhoeverIsMissingIsNamedToEverybody) {
  const std::string run = own_run();
  BusOptions impatient = options(run);
  impatient.hello_timeout_s =
      1.2 * impatient.peer_timeout_s;  // who waits for others is not taken for hanging
  auto fluid = in_thread([&] { const SolverSession session(options(run), gas()); });
  auto stranger = in_thread([&] { const SolverSession session(options(run), hello("solid", "plate")); });
  auto coupler = in_thread([&] { const CouplerSession session(impatient, gas_and_solid(), "one case"); });
  const End end = coupler.get();
  EXPECT_EQ(end.code, ExitCode::peer_lost);
  EXPECT_TRUE(says(end.reason, "solid 'beam' did not join")) << end.reason;
  EXPECT_TRUE(says(end.reason, "not expected: solid 'plate'")) << end.reason;
  EXPECT_TRUE(says(fluid.get().reason, "solid 'beam' did not join"));
  EXPECT_EQ(stranger.get().code, ExitCode::peer_lost);
}

/// However many introduce themselves: the coupler remembers a few names, each once.
TEST(Handshake, CrowdOfStrangersIsNotRemembered) {
  const std::string run = own_run();
  BusOptions impatient = options(run);
  impatient.hello_timeout_s = 2;
  const auto domain = join_domain(run, 10);
  auto coupler = in_thread([&] { const CouplerSession session(impatient, gas_and_solid(), "one case"); });
  const Entity participant = create_participant(run);
  Writer<amp_fsi_Hello> crowd(participant, hello_topic, Delivery::lasting);
  ASSERT_TRUE(fsi::test::until([&] { return crowd.matched() > 0; }));
  for (int k = 0; k < 200; ++k) {
    wire::Hello stranger = hello("solid", fmt::format("stranger {}", k / 2));
    stranger.run = run;
    crowd.write(borrow(stranger).sample);
    EXPECT_TRUE(crowd.arrived(5));
  }
  const std::string reason = coupler.get().reason;
  const auto names = [&](int k) { return says(reason, fmt::format("'stranger {}'", k)); };
  int named = 0;
  for (int k = 0; k < 100; ++k) named += names(k) ? 1 : 0;
  EXPECT_GT(named, 0) << reason;
  EXPECT_LE(named, 20) << reason;
  EXPECT_EQ(std::count(reason.begin(), reason.end(), '\''), 2 * (named + 1)) << "each once: " << reason;
}

TEST(Handshake, SolverWithoutACouplerGivesUpAndSaysSo) {
  BusOptions impatient = options(own_run());
  impatient.hello_timeout_s = 0;
  auto fluid = in_thread([&] { const SolverSession session(impatient, gas()); });
  const End end = fluid.get();
  EXPECT_EQ(end.code, ExitCode::peer_lost);
  EXPECT_TRUE(says(end.reason, "coupler is missing")) << end.reason;
}

TEST(Handshake, ProgramOfAnotherVersionOfTheTypesIsToldApartInWords) {
  const std::string run = own_run();
  const auto domain = join_domain(run, 10);
  const Entity participant = create_participant(run);
  const Writer<amp_fsi_Control> wrong_type(participant, "amp_fsi/hello", Delivery::lasting);
  auto coupler = in_thread([&] { const CouplerSession session(options(run), gas_and_solid(), "one case"); });
  const End end = coupler.get();
  EXPECT_EQ(end.code, ExitCode::peer_lost);
  EXPECT_TRUE(says(end.reason, "message type")) << end.reason;
}

TEST(Handshake, InterfaceOfImpossibleDimensionIsTurnedAway) {
  const std::string run = own_run();
  const auto domain = join_domain(run, 10);
  const Entity participant = create_participant(run);
  Writer<amp_fsi_Hello> stranger(participant, "amp_fsi/hello", Delivery::lasting);
  wire::Hello bad = gas();
  bad.run = run;
  bad.interfaces[0].dimension = 2000000000;
  stranger.write(borrow(bad).sample);
  auto coupler = in_thread([&] { const CouplerSession session(options(run), gas_and_solid(), "one case"); });
  const End end = coupler.get();
  EXPECT_EQ(end.code, ExitCode::peer_lost);
  EXPECT_TRUE(says(end.reason, "dimension = 2000000000")) << end.reason;
}

TEST(Handshake, TwoProgramsOfOneNameAreRefused) {
  const std::string run = own_run();
  const auto domain = join_domain(run, 10);
  const Entity participant = create_participant(run);
  Writer<amp_fsi_Hello> twins(participant, "amp_fsi/hello", Delivery::lasting);
  wire::Hello twin = gas();
  twin.run = run;
  for (const int pid : {1, 2}) {
    twin.pid = pid;
    twins.write(borrow(twin).sample);
  }
  auto coupler = in_thread([&] { const CouplerSession session(options(run), gas_and_solid(), "one case"); });
  const End end = coupler.get();
  EXPECT_EQ(end.code, ExitCode::user_mistake);
  EXPECT_TRUE(says(end.reason, "two programs call themselves fluid")) << end.reason;
}

TEST(Handshake, WaitingEndsByTheCallersOwnException) {
  BusOptions interrupted = options(own_run());
  interrupted.throw_if_interrupted = [] { throw Failure(ExitCode::terminated, "ended on request"); };
  auto fluid = in_thread([&] { const SolverSession session(interrupted, gas()); });
  EXPECT_EQ(fluid.get().code, ExitCode::terminated);
}

TEST(Configuration, OfSeveralMachinesTakesTheInterfaceOfItsOwnAddressAndAsksAllOthers) {
  const std::string here = configuration_xml("r", 10, ""),
                    several = configuration_xml("r", 10, "10.0.0.2,10.0.0.1,10.0.0.3");
  EXPECT_TRUE(says(here, R"(<NetworkInterface name="lo"/>)") &&
              says(here, R"(<Peers><Peer Address="127.0.0.1"/></Peers>)"))
      << here;
  EXPECT_TRUE(says(several, R"(<NetworkInterface address="10.0.0.2"/>)")) << several;
  EXPECT_TRUE(says(
      several,
      R"(<Peers><Peer Address="10.0.0.2"/><Peer Address="10.0.0.1"/><Peer Address="10.0.0.3"/></Peers>)"))
      << several;
  EXPECT_FALSE(says(several, "lo\"") || says(several, "127.0.0.1")) << several;
}

TEST(Configuration, IsNotThatOfOtherProgramsOfTheMachine) {
  const std::string alone = configuration_xml("r", 10, "");
  setenv("CYCLONEDDS_URI", "file:///nothing.xml", 1);
  EXPECT_EQ(configuration_xml("r", 10, ""), alone);
  setenv(more_settings, "<CycloneDDS/>", 1);
  EXPECT_EQ(configuration_xml("r", 10, ""), alone + ",<CycloneDDS/>");
  unsetenv("CYCLONEDDS_URI");
  unsetenv(more_settings);
}

TEST(Configuration, WithAnAddressThatTheMachineDoesNotHaveSaysSo) {
  try {
    join_domain("r", 10, "203.0.113.1");  // of no machine: kept for documents
    ADD_FAILURE() << "joined";
  } catch (const PeerLost& lost) {
    EXPECT_TRUE(says(lost.what(), "needs an interface that has the address 203.0.113.1")) << lost.what();
    EXPECT_FALSE(says(lost.what(), "full")) << lost.what();
  }
}

}  // namespace
}  // namespace fsi::bus::test
