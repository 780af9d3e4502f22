/// A solver that runs alone computes without end, is stopped, is slow or finds the machine busy: only the
/// first ends as lost.

#include <sched.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/program/run/driver.hpp"
#include "tests/programs/bus/processes.hpp"

namespace fsi {
namespace {

using bus::test::compute;
using bus::test::let_pass;
using bus::test::Process;

constexpr double limit_s = 0.5;

/// A solver that does in each step what the test says.
class Stand final : public Participant {
 public:
  explicit Stand(std::vector<std::function<void()>> steps) : steps_(std::move(steps)) {}

  wire::Hello hello() const override { return {}; }
  ProposedTimeStep compute_time_step() const override { return {.dt = 1, .reason = "one"}; }
  void fill(std::size_t /*k*/, wire::PredictedInterface& /*predicted*/) const override {}
  void apply_bcs(double /*t*/, ProjectedStates /*projected*/) override {}
  void advance(double /*t*/, double /*dt*/, int /*substeps*/, ProjectedStates /*projected*/) override {
    steps_.at(taken_++)();
  }
  void write_fields(double /*t*/, std::uint64_t /*step*/) override {}
  void write_tables(double /*t*/, double /*dt*/, ProjectedStates /*projected*/) override {}
  void write_last_state(double /*t*/, std::uint64_t /*step*/) override {}
  void archive(Archive& archive) override { archive.number("taken", taken_); }
  wire::Health health() const override { return {}; }
  void report(double /*t*/, io::Part& /*part*/) const override {}

 private:
  std::vector<std::function<void()>> steps_;
  std::size_t taken_ = 0;
};

/// A run of these steps.
void run_in(const std::string& folder, std::vector<std::function<void()>> steps, const Process::Say& say) {
  Setup setup{.problem = {}, .run_dir = folder, .run = fmt::format("standalone-{}", getpid()), .name = "gas"};
  setup.problem.time.end = static_cast<double>(steps.size());
  setup.problem.time.step_timeout = limit_s;
  io::Part part;
  part.participant = setup.name;
  Stand stand(std::move(steps));
  say("begun");
  run_alone(setup, part, stand);
}

class ALoneSolver : public testing::Test {
 public:
  ALoneSolver()
      : folder_(std::filesystem::temp_directory_path() / fmt::format("fsi-standalone-{}", getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~ALoneSolver() override { std::filesystem::remove_all(folder_); }

 protected:
  /// Takes these steps in a process of its own, which says "begun" before them.
  void take(std::vector<std::function<void()>> steps) {
    solver_ =
        std::make_unique<Process>([&](const Process::Say& say) { run_in(folder_, std::move(steps), say); });
    ASSERT_EQ(solver_->hear(), "begun");
  }

  nlohmann::json report() const {
    std::ifstream file(folder_ / "parts" / "gas.json");
    return nlohmann::json::parse(file);
  }

  std::filesystem::path folder_;
  std::unique_ptr<Process> solver_;
};

TEST_F(ALoneSolver, ThatComputesWithoutEndIsLostAndItsReportSaysInWhichStep) {
  take({[] {}, [] {}, [] { compute(1e9); }});
  EXPECT_EQ(solver_->end(), 4);
  EXPECT_EQ(report()["status"], "failed");
  EXPECT_EQ(report()["exit_code"], 4);
  EXPECT_EQ(report()["steps"], 2);
  const std::string reason = report()["reason"];
  EXPECT_NE(reason.find("no step for "), std::string::npos) << reason;
  EXPECT_NE(reason.find("step 3 does not end"), std::string::npos) << reason;
}

TEST_F(ALoneSolver, ThatIsStoppedOrWaitsGoesOn) {
  take({[] {}, [] { let_pass(1); }, [] { compute(0.3 * limit_s); }});
  let_pass(0.3);
  solver_->send(SIGSTOP);
  let_pass(1.5);
  solver_->send(SIGCONT);
  EXPECT_EQ(solver_->end(), 0) << solver_->hear();
}

/// It shares one processor with others, and its step takes longer
/// than the limit on the clock whatever they leave it.
TEST_F(ALoneSolver, OnABusyMachineIsNotLost) {
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  CPU_ZERO(&one);
  int processor = 0;
  while (!CPU_ISSET(processor, &before)) ++processor;
  CPU_SET(processor, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  const Process first([](const auto&) { compute(1e9); }), second([](const auto&) { compute(1e9); }),
      third([](const auto&) { compute(1e9); });
  take({[] {
    const fsi::test::Stopwatch watch;
    compute(0.6 * limit_s);
    while (watch.seconds() < 1.2 * limit_s) let_pass(1e-3);
  }});
  EXPECT_EQ(solver_->end(), 0) << solver_->hear();
  EXPECT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

TEST_F(ALoneSolver, MayTakeTwentyTimesAsLongAsForItsLongestStepBefore) {
  take({[] { compute(0.6 * limit_s); }, [] { compute(3 * limit_s); }});
  EXPECT_EQ(solver_->end(), 0) << solver_->hear();
}

}  // namespace
}  // namespace fsi
