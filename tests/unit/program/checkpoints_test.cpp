#include "common/program/run/checkpoints.hpp"

#include <gtest/gtest.h>

#include <fstream>

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

}  // namespace
}  // namespace fsi
