/// Messages that are lost although DDS promised them: one is sent again and nothing changes; where all are
/// lost, the run ends and names the message.

#include <algorithm>
#include <atomic>
#include <memory>
#include <ostream>

#include "tests/unit/bus/seats.hpp"
#include "tests/waiting.hpp"

namespace fsi::bus::test {
namespace {

constexpr std::uint64_t steps = 4;
const std::string fluid_predicted = "amp_fsi/predicted/fluid/beam",
                  fluid_projected = "amp_fsi/projected/fluid/beam",
                  beam_predicted = "amp_fsi/predicted/beam/beam",
                  beam_projected = "amp_fsi/projected/beam/beam";

/// Loses messages on some topics: from the `first` one on, `count` of them.
struct Loss {
  std::vector<std::string> topics;
  int first = 0, count = 1;

  friend std::ostream& operator<<(std::ostream& out, const Loss& loss) {
    for (const std::string& topic : loss.topics) out << topic << ' ';
    return out << "from " << loss.first << " on, " << loss.count;
  }
};

constexpr int for_ever = 1 << 30;

BusOptions losing(const std::string& run, const Loss& loss) {
  BusOptions result = options(run);
  // Who must come through may take its time.
  result.peer_timeout_s = loss.count == for_ever ? 1.2 : fsi::test::watchdog_s;
  auto sent = std::make_shared<std::atomic<int>>(0);  // of this program; every topic has one sender
  result.loses = [loss, sent](const std::string& topic) {
    if (std::ranges::find(loss.topics, topic) == loss.topics.end()) return false;
    const int number = (*sent)++;
    return number >= loss.first && number < loss.first + loss.count;
  };
  return result;
}

/// All that a solver was told.
std::vector<double> solve(const BusOptions& options, const wire::Hello& self) {
  SolverSession session(options, self);
  std::vector<double> heard;
  try {
    for (std::uint64_t step = 0; step < steps; ++step) {
      session.publish(predicted(step));
      const auto& answer = session.receive("beam", step);
      heard.insert(heard.end(), answer.v_n.begin(), answer.v_n.end());
    }
  } catch (const Failure& failure) {
    session.abort(failure);
    throw;
  }
  return heard;
}

struct Ends {
  End fluid, beam, coupler;
  std::vector<double> told_fluid, told_beam;
};

/// Gas and solid in threads, the coupler in the first one, whose pulse stands for all of this process.
Ends run_with(const Loss& loss) {
  const std::string run = own_run();
  Ends ends;
  auto fluid = in_thread([&] { ends.told_fluid = solve(losing(run, loss), gas()); });
  auto beam = in_thread([&] { ends.told_beam = solve(losing(run, loss), solid()); });
  try {
    CouplerSession coupler(losing(run, loss), gas_and_solid(), "one case");
    try {
      for (std::uint64_t step = 0; step < steps; ++step) {
        coupler.gather(step);
        coupler.scatter(std::vector{projected("fluid", step), projected("beam", step)});
      }
    } catch (const Failure& failure) {
      coupler.abort(failure);
      throw;
    }
  } catch (const Failure& failure) {
    ends.coupler = {failure.code(), failure.what()};
  }
  ends.fluid = fluid.get();
  ends.beam = beam.get();
  return ends;
}

std::vector<double> all_answers() {
  std::vector<double> result;
  for (std::uint64_t step = 0; step < steps; ++step)
    result.insert(result.end(), 3, -static_cast<double>(step));
  return result;
}

class LostOnce : public testing::TestWithParam<Loss> {};

TEST_P(LostOnce, IsSentAgainAndChangesNothing) {
  const Ends ends = run_with(GetParam());
  EXPECT_EQ(ends.coupler.reason, "");
  EXPECT_EQ(ends.fluid.reason, "");
  EXPECT_EQ(ends.beam.reason, "");
  EXPECT_EQ(ends.told_fluid, all_answers());
  EXPECT_EQ(ends.told_beam, all_answers());
}

INSTANTIATE_TEST_SUITE_P(
    Messages, LostOnce,
    testing::Values(Loss{.topics = {"amp_fsi/hello"}}, Loss{.topics = {"amp_fsi/welcome"}},
                    Loss{.topics = {"amp_fsi/welcome"}, .first = 1, .count = 1},
                    Loss{.topics = {fluid_predicted}}, Loss{.topics = {beam_predicted}, .first = 2},
                    Loss{.topics = {fluid_projected}}, Loss{.topics = {beam_projected}, .first = 1},
                    Loss{.topics = {fluid_predicted}, .first = 1, .count = 2},
                    Loss{.topics = {fluid_projected, beam_projected}, .first = 2, .count = 2},
                    Loss{.topics = {"amp_fsi/waiting", fluid_predicted}, .first = 1}));

/// Which message is lost for good, and who is to name it.
struct Silence {
  Loss loss;
  std::string message;

  friend std::ostream& operator<<(std::ostream& out, const Silence& silence) { return out << silence.loss; }
};

class LostForGood : public testing::TestWithParam<Silence> {};

TEST_P(LostForGood, EndsTheRunAndNamesTheMessage) {
  const Ends ends = run_with(GetParam().loss);
  for (const End& end : {ends.coupler, ends.fluid, ends.beam}) {
    EXPECT_EQ(end.code, ExitCode::peer_lost);
    EXPECT_TRUE(says(end.reason, "a message was lost: " + GetParam().message)) << end.reason;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Messages, LostForGood,
    testing::Values(
        Silence{.loss = {.topics = {fluid_predicted}, .count = for_ever},
                .message = "PredictedInterface of step 0 from fluid to coupler (topic '" + fluid_predicted},
        Silence{.loss = {.topics = {beam_predicted}, .first = 2, .count = for_ever},
                .message = "PredictedInterface of step 2 from beam to coupler (topic '" + beam_predicted},
        Silence{.loss = {.topics = {fluid_projected}, .first = 1, .count = for_ever},
                .message = "ProjectedInterface of step 1 from coupler to fluid (topic '" + fluid_projected},
        Silence{.loss = {.topics = {fluid_predicted, fluid_projected}, .first = 1, .count = for_ever},
                .message = "P"},
        Silence{.loss = {.topics = {beam_predicted, beam_projected, "amp_fsi/waiting"},
                         .first = 1,
                         .count = for_ever},
                .message = "ProjectedInterface of step 1 from coupler to "}));

TEST(LostAbort, ItsSenderIsNamed) {
  const std::string run = own_run();
  auto fluid = in_thread([&] {
    SolverSession session(losing(run, {.topics = {"amp_fsi/abort"}, .count = for_ever}), gas());
    session.abort(Diverged("rho < 0"));
  });
  auto coupler = in_thread(
      [&] { CouplerSession(options(run), {{.role = "fluid", .name = "fluid"}}, "one case").gather(0); });
  fluid.get();
  const End end = coupler.get();
  EXPECT_EQ(end.code, ExitCode::peer_lost);
  EXPECT_TRUE(says(end.reason, "fluid") && says(end.reason, "has left the run without saying why"))
      << end.reason;
}

}  // namespace
}  // namespace fsi::bus::test
