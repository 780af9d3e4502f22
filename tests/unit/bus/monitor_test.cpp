/// What the monitor makes of telemetry, and which runs it finds.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "monitor/registry.hpp"
#include "monitor/state.hpp"
#include "monitor/table.hpp"

namespace fsi::monitor {
namespace {

namespace fs = std::filesystem;

wire::Telemetry telemetry(const std::string& role, const std::string& name, std::uint64_t step, double t) {
  wire::Telemetry result;
  result.role = role;
  result.from = name;
  result.state = "computing";
  result.step = step;
  result.t = t;
  result.t_end = 4;
  result.dt = 0.01;
  result.compute_s = 3;
  result.wait_s = 1;
  return result;
}

RunEntry entry(const std::string& run, const std::string& name = "piston") {
  return {.run = run, .name = name, .dir = "", .pid = getpid()};
}

TEST(RunState, PaceAndRemainingTimeComeFromTheCoupler) {
  RunState state(entry("r"));
  EXPECT_EQ(state.status(), "waiting");
  for (std::uint64_t k = 0; k <= 10; ++k) {
    const double now = 0.1 * static_cast<double>(k);
    state.hear(telemetry("fluid", "fluid", 1000, 3.9), now);
    state.hear(telemetry("coupler", "coupler", 5 * k, now), now);
  }
  EXPECT_EQ(state.status(), "running");
  EXPECT_NEAR(state.steps_per_s(), 50, 1e-9);
  EXPECT_NEAR(state.progress(), 0.25, 1e-12);
  EXPECT_NEAR(state.remaining_s().value_or(0), 3, 1e-9);
}

TEST(RunState, RunIsOverWhenItsProgramsAreGoneOrOneAborts) {
  RunState state(entry("r"));
  state.count_programs(0, 0);
  state.count_programs(0, 100);
  EXPECT_FALSE(state.over()) << "a run that has not begun is not over";
  state.hear(telemetry("fluid", "fluid", 1, 1), 100);
  state.count_programs(1, 100);
  state.count_programs(0, 101);
  EXPECT_FALSE(state.over());
  state.count_programs(0, 102);
  EXPECT_EQ(state.status(), "ended");

  wire::Abort abort;
  abort.from = "fluid";
  RunState other(entry("r"));
  other.hear(abort);
  EXPECT_EQ(other.status(), "aborted");
}

TEST(RunState, JsonHoldsEverythingAndStaysValidWithInfiniteNumbersAndOddNames) {
  RunState state(entry("r"));
  auto coupler = telemetry("coupler", "coupler", 7, 1);
  coupler.dt = std::numeric_limits<double>::infinity();
  coupler.dt_reason = "odd \xff \" byte";
  coupler.interfaces.push_back(
      {"beam", 1, 2, 3, std::numeric_limits<double>::quiet_NaN(), {0, 1}, {5, 6}, {}, {}, {}});
  state.hear(coupler, 1);
  state.hear(telemetry("solid", "beam", 7, 1), 2);
  const auto json = nlohmann::json::parse(to_json(state, 4));
  EXPECT_EQ(json.at("step"), 7);
  EXPECT_TRUE(json.at("dt").is_null());
  EXPECT_EQ(json.at("interfaces").at("beam").at("gap"), 3);
  EXPECT_TRUE(json.at("interfaces").at("beam").at("power").is_null());
  EXPECT_EQ(json.at("participants").at("beam").at("computing_share"), 0.75);
  EXPECT_EQ(json.at("participants").at("beam").at("silent_s"), 2);
}

TEST(Table, FitsTheTerminalWhateverTheRunSays) {
  RunState state(entry("a run with a very long name " + std::string(200, 'x')));
  for (int k = 0; k < 40; ++k) {
    auto one = telemetry("solid", "solid \x1b[31m" + std::to_string(k) + std::string(100, 'y'), 1, 1);
    one.interfaces.resize(30);
    one.dt_reason = std::string(300, 'z');
    state.hear(one, 0);
  }
  for (const Extent extent : {Extent{.columns = 80, .rows = 24}, Extent{.columns = 20, .rows = 5}}) {
    const auto lines = table(state, 0, extent);
    EXPECT_LE(std::ssize(lines), extent.rows);
    for (const std::string& line : lines) {
      EXPECT_LE(std::ssize(line), extent.columns);
      EXPECT_EQ(line.find('\x1b'), std::string::npos) << "names from outside must not steer the terminal";
    }
  }
}

TEST(Table, DurationsReadLikeTime) {
  EXPECT_EQ(duration_text(12.3), "12 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(duration_text(7800), "2 h 10 min");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "-");
}

class Registry : public testing::Test {
 public:
  Registry() : folder_(fs::temp_directory_path() / ("fsi-registry-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Registry() override { fs::remove_all(folder_); }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file) << text;
  }

  fs::path folder_;
};

TEST_F(Registry, ListsLivingRunsAndPassesOverDeadAndUnreadableOnes) {
  const std::string me = std::to_string(getpid());
  write("b.json", R"({"run": "b", "dir": "/somewhere", "case": "piston", "pid": )" + me + "}");
  write("a.json", R"({"run": "a", "pid": )" + me + "}");
  write("dead.json", R"({"run": "dead", "pid": 2147483646})");
  write("torn.json", R"({"run": "to)");
  write("odd.json", R"({"run": 3, "pid": "x"})");
  write("note.txt", "hello");
  const auto runs = running_runs({folder_, folder_ / "absent"});
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].run, "a");
  EXPECT_EQ(runs[1].dir, "/somewhere");
}

TEST_F(Registry, RunIsMeantByIdentityFolderCaseOrBeginning) {
  std::vector<RunEntry> runs = {entry("piston-1"), entry("piston-12"), entry("beam-1", "beam")};
  runs[2].dir = folder_.string();
  EXPECT_EQ(matching(runs, "").size(), 3U);
  EXPECT_EQ(matching(runs, "piston-1").size(), 1U);
  EXPECT_EQ(matching(runs, "piston").size(), 2U);
  EXPECT_EQ(matching(runs, (folder_ / ".").string()).at(0).run, "beam-1");
  EXPECT_EQ(matching(runs, "be").at(0).run, "beam-1");
  EXPECT_TRUE(matching(runs, "disk").empty());
}

}  // namespace
}  // namespace fsi::monitor
