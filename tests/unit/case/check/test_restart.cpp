#include <gtest/gtest.h>

#include "common/case/case.hpp"
#include "common/case/read/restart.hpp"
#include "common/core/failure.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

const char* const shipped_piston = FSI_ROOT "/configs/elastic_piston.yaml";

/// What is wrong with going on with the piston, changed in some way.
std::string refusal(const std::vector<std::string>& overrides) {
  const tests::TemporaryFolder folder;
  const std::string former = folder.write("former.yaml", load_case(shipped_piston).resolved);
  try {
    check_restart(load_case(shipped_piston, overrides).resolved, former);
    return "";
  } catch (const UserMistake& mistake) {
    return mistake.what();
  }
}

TEST(RestartOfACase, MayRunLongerAndWriteOtherOutput) {
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal({"time.end=1.5", "output.times=[1, 1.5]", "output.checkpoint_every=10", "expect={}"}),
            "");
  EXPECT_EQ(load_case(shipped_piston).restart_digest,
            load_case(shipped_piston, {"time.end=1.5"}).restart_digest);
}

TEST(RestartOfACase, NamesWhatElseDiffers) {
  EXPECT_NE(refusal({"time.cfl=0.5"}).find("time.cfl: 0.5, was 0.9"), std::string::npos);
  EXPECT_NE(refusal({"output.probes=[{name: a, in: fluid, x: 1, y: 0.5}]"}).find("output: "),
            std::string::npos);
  EXPECT_NE(load_case(shipped_piston).restart_digest,
            load_case(shipped_piston, {"time.cfl=0.5"}).restart_digest);
}

/// A restart reads the resolved case that the run left.
TEST(RestartOfACase, ReadsTheSameCaseBackFromWhatTheRunLeft) {
  const tests::TemporaryFolder folder;
  for (const std::string& path : tests::config_paths()) {
    if (!path.ends_with(".yaml")) continue;
    const Case first = load_case(path);
    const Case again = load_case(folder.write("again.yaml", first.resolved));
    EXPECT_EQ(again.resolved, first.resolved) << path;
    EXPECT_EQ(again.restart_digest, first.restart_digest) << path;
  }
}

}  // namespace
}  // namespace fsi
