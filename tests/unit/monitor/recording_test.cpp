/// What is recorded comes back the same.

#include "monitor/recording/recording.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "common/core/failure.hpp"
#include "monitor/json.hpp"
#include "monitor/recording/replay.hpp"
#include "tests/unit/monitor/telemetry.hpp"

namespace fsi::monitor {
namespace {

namespace fs = std::filesystem;

class Recordings : public testing::Test {
 public:
  Recordings() : folder_(fs::temp_directory_path() / ("fsi-recording-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Recordings() override { fs::remove_all(folder_); }
  std::string path() const { return (folder_ / "run.h5").string(); }
  RunEntry run() const { return {.run = "r-1", .name = "piston", .dir = "/somewhere", .pid = 0}; }

  static wire::Telemetry coupler(std::uint64_t step) {
    auto one = with_interface("beam", 5);
    one.step = step;
    one.dt_reason = "fluid: step " + std::to_string(step);
    one.host = "here";
    one.noise = "v1 ripples at step " + std::to_string(step);
    one.pid = 5;
    one.interfaces[0].closed = true;
    one.interfaces.push_back({});  // a solid without traction, without points
    one.interfaces[1].name = "rigid";
    one.interfaces[1].gap = std::numeric_limits<double>::infinity();
    return one;
  }

  /// All that the file holds, as JSON after each message.
  static std::vector<std::string> shown(Recording& recording) {
    std::vector<std::string> all;
    RunState state(recording.run());
    for (auto part = recording.next(); !part.empty(); part = recording.next()) {
      for (const Heard& one : part) {
        if (one.telemetry) state.hear(*one.telemetry, one.at);
        if (one.abort) state.hear(*one.abort);
        all.push_back(to_json(state, one.at));
      }
    }
    return all;
  }

  fs::path folder_;
};

TEST_F(Recordings, ComeBackTheSameNumberForNumber) {
  std::vector<std::string> expected;
  RunState state(run());
  Recorder recorder(path(), run(), 100);
  for (std::uint64_t step = 0; step < 40; ++step) {
    const double at = 0.5 * static_cast<double>(step);
    recorder.add(coupler(step), 100 + at);
    state.hear(coupler(step), at);
    expected.push_back(to_json(state, at));
  }
  const wire::Abort abort{
      .run = "r-1",
      .from = "fluid",
      .exit_code = 3,
      .place = {.step = 40, .t = 1.37, .grid = "ring", .point = {14, 3}, .position = {1.0 / 3, 0.1}},
      .what = "p < 0"};
  recorder.add(abort, 121);
  state.hear(abort);
  expected.push_back(to_json(state, 21));
  recorder.close();
  EXPECT_FALSE(fs::exists(path() + ".parts")) << "one file in the end";
  Recording recording(path());
  EXPECT_EQ(recording.run().run, "r-1");
  EXPECT_EQ(shown(recording), expected);
}

TEST_F(Recordings, ReplaceOthersAndNothingElse) {
  Recorder(path(), run(), 0).close();
  Recorder(path(), run(), 0).close();
  const std::string notes = path() + ".txt", folder = path() + ".folder";
  std::ofstream(notes) << "mine";
  fs::create_directory(folder);
  for (const std::string& taken : {notes, folder, std::string("/dev/null")}) {
    EXPECT_THROW(Recorder(taken, run(), 0), UserMistake) << taken;
    EXPECT_FALSE(fs::exists(taken + ".parts")) << taken;
  }
  EXPECT_EQ(fs::file_size(notes), 4U);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Recordings, KeepTheReasonWhereItsPlaceIsNoNumber) {
  const wire::Abort abort{.run = "r-1",
                          .from = "beam",
                          .exit_code = 3,
                          .place = {.step = 40, .grid = "ring", .position = {std::nan(""), 0.1}},
                          .what = "det F < 0"};
  Recorder recorder(path(), run(), 0);
  recorder.add(abort, 1);
  recorder.close();
  const std::vector<Heard> heard = Recording(path()).next();
  ASSERT_EQ(heard.size(), 1U);
  ASSERT_TRUE(heard[0].abort);
  EXPECT_EQ(heard[0].abort->reason(), abort.reason());
}

TEST_F(Recordings, OpenWhileTheyGrowWithAllButTheLastSeconds) {
  Recorder recorder(path(), run(), 0);
  for (std::uint64_t step = 0; step < 40; ++step) recorder.add(coupler(step), static_cast<double>(step));
  Recording recording(path());
  EXPECT_GE(shown(recording).size(), 30U);
}

TEST_F(Recordings, PlayBackLikeARunThatIsGoingOn) {
  auto recorder = std::make_unique<Recorder>(path(), run(), 0);
  for (std::uint64_t step = 0; step < 40; ++step) recorder->add(coupler(step), static_cast<double>(step));
  recorder.reset();
  Replay replay(path(), 1e6);
  RunState state(replay.run());
  while (!state.over()) replay.listen(state, 0.1);
  EXPECT_EQ(state.status(), "ended");
  EXPECT_EQ(state.leader()->step, 39U);
  EXPECT_NEAR(state.steps_per_s(), 1, 1e-9);
}

TEST_F(Recordings, AFileThatIsNoneIsRefusedInWords) {
  EXPECT_THROW(Replay(path(), 1), OutputFailed);
}

}  // namespace
}  // namespace fsi::monitor
