#include "common/core/log.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "common/core/failure.hpp"

namespace fsi {
namespace {

class Log : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("fsi-log-" + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(folder_ / "log");
  }
  void TearDown() override {
    open_log("", "", LogFile::fresh);  // closes the file
    std::filesystem::remove_all(folder_);
  }
  std::string text() const {
    std::ifstream file(folder_ / "log" / "fluid.log");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder_;
};

TEST_F(Log, EverythingGoesToTheFileWithItsTimeAndTroubleToStandardErrorToo) {
  open_log("fluid", folder_.string(), LogFile::fresh);
  testing::internal::CaptureStderr();
  log_info("begun {}");
  log_warning("a disk is full");
  log_error("the solution diverged");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "fluid: warning: a disk is full\nfluid: error: the solution diverged\n");
  const std::string written = text();
  constexpr std::size_t length_of_time = sizeof("2026-01-31 23:59:59.999") - 1;
  EXPECT_EQ(written.find(" info begun {}\n"), length_of_time) << written;
  EXPECT_NE(written.find(" warning a disk is full\n"), std::string::npos);
  EXPECT_NE(written.find(" error the solution diverged\n"), std::string::npos);
}

TEST_F(Log, ARunThatGoesOnKeepsWhatItsLogSays) {
  open_log("fluid", folder_.string(), LogFile::fresh);
  log_info("first");
  open_log("fluid", folder_.string(), LogFile::continued);
  log_info("second");
  EXPECT_NE(text().find("first"), std::string::npos);
  EXPECT_NE(text().find("second"), std::string::npos);
  open_log("fluid", folder_.string(), LogFile::fresh);
  log_info("third");
  EXPECT_EQ(text().find("first"), std::string::npos);
}

TEST_F(Log, AFileThatCannotBeMadeIsAFailureOfOutput) {
  std::ofstream(folder_ / "file") << "no folder";
  EXPECT_THROW(open_log("fluid", (folder_ / "file").string(), LogFile::fresh), OutputFailed);
}

}  // namespace
}  // namespace fsi
