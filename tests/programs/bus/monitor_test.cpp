/// The program `monitor` beside a living run.

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/bus/sessions/solo_session.hpp"
#include "tests/programs/bus/trio.hpp"

namespace fsi::bus::test {
namespace {

namespace fs = std::filesystem;

struct Output {
  int code = -1;
  std::string text;
};

/// Runs the monitor with a registry of its own. `on_line` hears what it says at once.
Output monitor(
    const fs::path& registry, const std::string& arguments,
    const std::function<void(const std::string&)>& on_line = [](const auto&) {}) {
  const std::string command = fmt::format("XDG_RUNTIME_DIR={} timeout {} {} {} 2>&1", registry.string(),
                                          watchdog_s, FSI_MONITOR, arguments);
  Output output;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> part{};
  while (pipe != nullptr && fgets(part.data(), part.size(), pipe) != nullptr) {
    output.text += part.data();
    on_line(part.data());
  }
  const int status = pclose(pipe);
  output.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return output;
}

class Monitor : public testing::Test {
 public:
  Monitor()
      : registry_(fs::temp_directory_path() / fmt::format("fsi-monitor-{}", getpid())), run_(own_run()) {
    fs::create_directories(registry_ / "amp-fsi");
  }
  ~Monitor() override { fs::remove_all(registry_); }

  void enter(const std::string& run, int launcher = getpid()) const {
    std::ofstream(registry_ / "amp-fsi" / (run + ".json")) << nlohmann::json{
        {"run", run}, {"case", "sod"}, {"dir", "/tmp"}, {"pid", launcher}, {"key", test_key}};
  }

  fs::path registry_;
  std::string run_;
};

/// A gas that runs alone until it is told to stop.
void run_alone(const std::string& run, const Process::Say& say) {
  SoloSession session(protected_options(run), "fluid", "fluid");
  say("begun");
  wire::Telemetry telemetry;
  telemetry.t_end = 1;
  while (session.controls().empty()) {
    telemetry.t += 1e-3;
    ++telemetry.step;
    session.publish(telemetry);
    session.idle(0.02);
  }
}

TEST_F(Monitor, FindsTheOnlyRunShowsItOnceAndCanStopIt) {
  enter(run_);
  Process fluid([&](const auto& say) { run_alone(run_, say); });
  ASSERT_EQ(fluid.hear(), "begun");

  const Output once = monitor(registry_, "--once --json");
  ASSERT_EQ(once.code, 0) << once.text;
  const auto json = nlohmann::json::parse(once.text);
  EXPECT_EQ(json.at("run"), run_);
  EXPECT_EQ(json.at("status"), "running");
  EXPECT_GT(json.at("participants").at("fluid").at("step"), 0);

  Output followed;
  std::atomic<bool> follows = false;
  std::thread follower([&] {
    followed = monitor(registry_, "sod --plain", [&](const std::string& line) {
      follows = follows || says(line, "status=running step=");
    });
  });
  EXPECT_TRUE(until([&] { return follows.load(); }));
  const Output stop = monitor(registry_, "sod --send stop");
  EXPECT_EQ(stop.code, 0) << stop.text;
  EXPECT_EQ(fluid.end(), 0);
  follower.join();
  EXPECT_EQ(followed.code, 0);
  EXPECT_TRUE(says(followed.text, "status=running step=")) << followed.text;
  EXPECT_TRUE(says(followed.text, "status=ended")) << followed.text;
}

TEST_F(Monitor, WithoutARunOrWithSeveralItSaysWhatToDo) {
  const Output none = monitor(registry_, "--once");
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(says(none.text, "no run is going on")) << none.text;
  enter("one");
  enter("two");
  const Output several = monitor(registry_, "--once < /dev/null");
  EXPECT_EQ(several.code, 2);
  EXPECT_TRUE(says(several.text, "name one") && says(several.text, "one  (sod in /tmp)")) << several.text;
  EXPECT_EQ(monitor(registry_, "three").code, 2);
}

TEST_F(Monitor, DoesNotWaitForARunWhoseLauncherIsGone) {
  Process launcher([](const auto&) {
    while (true) pause();
  });
  enter(run_, launcher.pid());
  Output followed;
  std::atomic<bool> follows = false;
  std::thread follower(
      [&] { followed = monitor(registry_, "--plain", [&](const auto&) { follows = true; }); });
  EXPECT_TRUE(until([&] { return follows.load(); }));
  launcher.send(SIGTERM);
  EXPECT_EQ(launcher.end(), 128 + SIGTERM);
  follower.join();
  EXPECT_EQ(followed.code, 0);
  EXPECT_TRUE(says(followed.text, "status=ended")) << followed.text;
}

TEST_F(Monitor, ProcessWithTheNumberOfALauncherThatIsGoneDoesNotStandForIt) {
  std::ofstream(registry_ / "amp-fsi" / (run_ + ".json"))
      << nlohmann::json{{"run", run_}, {"case", "sod"}, {"dir", "/tmp"}, {"pid", getpid()}, {"born", 1}};
  const Output none = monitor(registry_, "--once");
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(says(none.text, "no run is going on")) << none.text;
}

TEST_F(Monitor, RequestToARunThatNobodyNamedIsRefusedInAScript) {
  enter(run_);
  const Output refused = monitor(registry_, "--send stop < /dev/null");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(says(refused.text, "name the run that shall stop: " + run_)) << refused.text;
}

TEST_F(Monitor, SilentRunIsALostPeer) {
  enter(run_);
  const Output silent = monitor(registry_, "--once --wait 0.5");
  EXPECT_EQ(silent.code, 4);
  EXPECT_TRUE(says(silent.text, "said nothing")) << silent.text;
}

}  // namespace
}  // namespace fsi::bus::test
