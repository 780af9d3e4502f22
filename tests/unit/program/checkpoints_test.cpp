#include "common/program/run/checkpoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "common/core/log.hpp"
#include "tests/unit/io/scratch.hpp"

namespace fsi {
namespace {

class ReportOfARun : public io::InScratch {
 protected:
  void SetUp() override {
    InScratch::SetUp();
    std::ofstream(dir + "/case.yaml")
        << "time: {end: 1}\nfluid:\n  grid: {x: [0, 1], y: [0, 1], points: [5, 5]}\n"
           "  boundary: {left: outflow, right: outflow, bottom: symmetry, top: symmetry}\n"
           "  initial: {rho: 1, v: [0, 0], p: 1}\n";
    setup = {.problem = load_case(dir + "/case.yaml"), .run_dir = dir, .run = "run", .name = "fluid"};
  }

  /// The report of a run that goes on from a checkpoint of one with report `part`.
  io::Part gone_on(io::Part part) {
    const io::Standing at{.step = 7, .t = 0.5, .dt = 0.1};
    Checkpoints former(setup, part, [](Archive&) {});
    former.save(at);
    EXPECT_TRUE(former.complete(at));
    fsi::Setup later = setup;
    later.restart = io::checkpoint_folder(dir, at.step);
    io::Part report;
    EXPECT_EQ(Checkpoints(later, report, [](Archive&) {}).begin().step, at.step);
    return report;
  }

  fsi::Setup setup;  // GoogleTest keeps the bare name from its tests
};

TEST_F(ReportOfARun, CountsWhatWasLostBeforeARestart) {
  io::Part part;
  part.counters["lost_outputs"] = 3;
  EXPECT_EQ(gone_on(part).counters, part.counters);
}

TEST_F(ReportOfARun, HasNoCounterOfLossesWhereNothingWasLost) {
  EXPECT_TRUE(gone_on({}).counters.empty());
}

class RunThatGoesOn : public ReportOfARun {
 protected:
  void SetUp() override {
    ReportOfARun::SetUp();
    setup.problem.output.go_on = true;
  }
};

TEST_F(RunThatGoesOn, CountsEveryResultThatIsLost) {
  io::Part part;
  for (const std::uint64_t lost : {16U, 3U, 1U})
    write_results(setup, part, [&] { throw OutputFailed("full", lost); });
  write_results(setup, part, [] {});
  EXPECT_EQ(part.counters.at(lost_outputs), 20);
}

TEST_F(RunThatGoesOn, CountsTheCheckpointBesideTheLinesThatItDidNotBringToTheDisk) {
  io::Part part;
  Checkpoints(setup, part, [](Archive&) { throw OutputFailed("full", 5); }).save({.step = 7});
  EXPECT_EQ(part.counters.at(lost_outputs), 6);
}

TEST_F(RunThatGoesOn, TellsItsLossesWheneverTheyHaveDoubled) {
  open_log("fluid", "", LogFile::fresh);
  testing::internal::CaptureStderr();
  io::Part part;
  for (int k = 0; k < 1000; ++k) write_results(setup, part, [] { throw OutputFailed("full"); });
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::ranges::count(said, '\n'), 10) << said;  // 1, 2, 4, .. 512
  EXPECT_NE(said.find("lost: 512\n"), std::string::npos) << said;
}

TEST_F(ReportOfARun, EndsARunThatIsNotToldToGoOn) {
  io::Part part;
  EXPECT_THROW(write_results(setup, part, [] { throw OutputFailed("full"); }), OutputFailed);
  EXPECT_TRUE(part.counters.empty());
}

}  // namespace
}  // namespace fsi
