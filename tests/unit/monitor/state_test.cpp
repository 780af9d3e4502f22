/// What the monitor makes of telemetry, and which runs it finds.

#include "monitor/state.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "monitor/json.hpp"
#include "monitor/registry.hpp"
#include "tests/unit/monitor/telemetry.hpp"

namespace fsi::monitor {
namespace {

namespace fs = std::filesystem;

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

  RunState busy(entry("r"));
  busy.hear(telemetry("fluid", "fluid", 1, 1), 100);
  for (const Process process : {Process::lives, Process::stopped}) {
    busy.see_process("fluid", process);
    busy.count_programs(0, 101);
    busy.count_programs(0, 200);
    EXPECT_FALSE(busy.over()) << "a program that lives may be silent for a while";
  }
  busy.see_process("fluid", Process::gone);
  busy.count_programs(0, 201);
  busy.count_programs(0, 202);
  EXPECT_EQ(busy.status(), "ended");

  wire::Abort abort;
  abort.from = "fluid";
  RunState other(entry("r"));
  other.hear(abort);
  EXPECT_EQ(other.status(), "aborted");
}

/// Anybody on the bus may send telemetry under 20,000 names: no answer may grow with them.
TEST(RunState, ForgedNamesDoNotFillTheMemoryNorHideTheRun) {
  RunState state(entry("r"));
  state.hear(telemetry("coupler", "coupler", 1, 0.1), 0);
  for (int k = 0; k < 20'000; ++k) state.hear(telemetry("fluid", "forged" + std::to_string(k), 1, 1), 0);
  state.hear(telemetry("fluid", std::string(100'000, 'x'), 1, 1), 0);
  state.hear(telemetry("coupler", "coupler", 2, 0.2), 1);
  EXPECT_LE(state.programs().size(), 256U);
  EXPECT_LT(to_json(state, 1).size(), 300'000U);
  EXPECT_EQ(state.leader()->step, 2U);
}

TEST(RunState, JsonHoldsEverythingAndStaysValidWithInfiniteNumbersAndOddNames) {
  RunState state(entry("r"));
  auto coupler = telemetry("coupler", "coupler", 7, 1);
  coupler.dt = std::numeric_limits<double>::infinity();
  coupler.dt_reason = "odd \xff \" byte";
  auto& beam = coupler.interfaces.emplace_back();
  beam.name = "beam";
  beam.gap = 3;
  beam.power = std::numeric_limits<double>::quiet_NaN();
  beam.s = {0, 1};
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

TEST(RunState, ProgramIsAliveWaitingPausedStoppedSilentOrLost) {
  RunState state(entry("r"));
  auto gas = telemetry("fluid", "fluid", 1, 1);
  state.hear(gas, 0);
  EXPECT_EQ(state.standing("fluid", 1), "alive");
  EXPECT_EQ(state.standing("fluid", 10), "silent");
  state.see_process("fluid", Process::stopped);
  EXPECT_EQ(state.standing("fluid", 1), "stopped");
  state.see_process("fluid", Process::gone);
  EXPECT_EQ(state.standing("fluid", 1), "lost");
  state.see_process("fluid", Process::lives);
  for (const char* said : {"waiting", "paused", "done"}) {
    gas.state = said;
    state.hear(gas, 2);
    EXPECT_EQ(state.standing("fluid", 2), said);
  }
  gas.state = "paused";
  state.hear(gas, 3);
  EXPECT_EQ(state.status(), "paused");
}

TEST(RunState, RatesAreThoseOfTheLastSeconds) {
  RunState state(entry("r"));
  auto gas = telemetry("fluid", "fluid", 0, 0);
  for (int k = 0; k <= 300; ++k) {
    const double now = 0.1 * k;
    gas.messages = static_cast<std::uint64_t>(k < 150 ? 1000 * k : 150000 + 2 * (k - 150));
    gas.bytes = 10 * gas.messages;
    gas.compute_s = 0.25 * now;
    gas.wait_s = 0.75 * now;
    state.hear(gas, now);
  }
  EXPECT_NEAR(state.rates("fluid").messages_per_s, 20, 0.5);
  EXPECT_NEAR(state.rates("fluid").bytes_per_s, 200, 5);
  EXPECT_NEAR(state.rates("fluid").computing.value_or(0), 0.25, 1e-9);
  EXPECT_LE(state.timeline().at("fluid").size(), 600U);
  EXPECT_NEAR(state.timeline().at("fluid").back().value, 0.25, 1e-9);
}

TEST(RunState, WhatIsNotFiniteIsNamed) {
  RunState state(entry("r"));
  auto coupler = with_interface("beam", 8);
  state.hear(coupler, 0);
  EXPECT_TRUE(state.non_finite().empty());
  coupler.interfaces[0].v_predicted_gas[3] = std::numeric_limits<double>::quiet_NaN();
  state.hear(coupler, 1);
  ASSERT_EQ(state.non_finite().size(), 1U);
  EXPECT_EQ(state.non_finite()[0], "v_n of the gas at beam");
}

TEST(Prometheus, EveryLineIsACommentOrANumberWithLabels) {
  RunState state(entry("a \"quoted\" run"));
  state.hear(with_interface("beam", 8), 0);
  state.hear(telemetry("fluid", "fluid", 3, 1), 0);
  std::istringstream page(to_prometheus(state, 0));
  const std::regex number(
      R"(amp_fsi_[a-z0-9_]+\{run="a \\"quoted\\" run"(,[a-z]+="[^"]*")?\} (NaN|[+-]Inf|[-+.e0-9]+))");
  int numbers = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("# ")) continue;
    EXPECT_TRUE(std::regex_match(line, number)) << line;
    ++numbers;
  }
  EXPECT_GT(numbers, 20);
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
  const auto runs = running_runs(folder_);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].run, "a");
  EXPECT_EQ(runs[1].dir, "/somewhere");
  EXPECT_TRUE(running_runs(folder_ / "absent").empty());
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
